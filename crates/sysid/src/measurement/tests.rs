//! Every kind of bad file has its error with the right line; no bytes whatever make the reader panic or pass a NaN on.

use super::*;
use proptest::prelude::*;
use std::io;

const COLUMNS: [Column; 3] = [
    Column::new("t_s", "s", 0.0, 1e6),
    Column::new("u", "duty", 0.0, 1.0),
    Column::new("rate", "rad/s", -40.0, 40.0),
];

fn timed() -> Layout<'static> {
    Layout::timed(&COLUMNS, 0.15)
}

fn refusal(text: impl AsRef<[u8]>) -> String {
    read(text.as_ref(), &timed()).expect_err("bad file").to_string()
}

/// A valid file of `rows` rows at 10 Hz, with a comment, an empty line and a column that nobody asked for.
fn valid(rows: usize) -> String {
    let mut text = String::from("# a comment\n\nrate,note,\"t_s\",u\n");
    for k in 0..rows {
        let t = k as f64 * 0.1;
        text += &format!("{:.4},x y,{t:.1},{:.3}\n", (3.0 * t).sin(), 0.5 + 0.4 * t.sin());
    }
    text
}

#[test]
fn exact_columns_in_any_order_comments_and_line_ends() {
    let text = valid(3).replace('\n', "\r\n");
    let table = read(text.as_bytes(), &timed()).unwrap();
    assert_eq!(table.rows(), 3);
    assert_eq!(table.column(0), [0.0, 0.1, 0.2]);
    assert_eq!(table.column(2), [0.0, 0.2955, 0.5646]);
    assert!(table.remarks.is_empty(), "{:?}", table.remarks);
    let marked = format!("\u{feff}{}", valid(3));
    assert_eq!(read(marked.as_bytes(), &timed()).unwrap(), table);
}

#[test]
fn exact_file_without_names() {
    let layout = timed().unnamed();
    let table = read("0,0.5,1\n0.1,0.6, 2e0\n".as_bytes(), &layout).unwrap();
    assert_eq!(table.column(2), [1.0, 2.0]);
    let error = read("0,0.5\n".as_bytes(), &layout).unwrap_err().to_string();
    assert_eq!(error, "line 1 has 2 cells, expected 3");
}

#[test]
fn exact_errors_name_the_line_and_what_is_wrong() {
    let cases = [
        (
            "",
            "the file is empty: it needs a header line with the names of its columns",
        ),
        (
            "# only\n\n",
            "the file is empty: it needs a header line with the names of its columns",
        ),
        ("t_s,u,rate\n", "the file has a header but no rows"),
        (
            "t_s,U,rate\n0,0,0\n",
            "line 1: column \"u\" missing; wanted: \"t_s\", \"u\", \"rate\"; found: \"t_s\", \"U\", \"rate\"",
        ),
        (
            "t_s,u,rate,u\n0,0,0,0\n",
            "line 1: column \"u\" appears 2 times in the header; found: \"t_s\", \"u\", \"rate\", \"u\"",
        ),
        ("t_s,u,rate\n0,0,0\n\n0.1,0\n", "line 4 has 2 cells, expected 3"),
        ("t_s,u,rate\n0,0,\n", "line 2, column \"rate\": the cell is empty"),
        (
            "t_s,u,rate\n0,0,1.2.3\n",
            "line 2, column \"rate\": \"1.2.3\" is not a number",
        ),
        (
            "t_s,u,rate\n0,0,nan\n",
            "line 2, column \"rate\": must be finite, got NaN",
        ),
        (
            "t_s,u,rate\n0,-inf,0\n",
            "line 2, column \"u\": must be finite, got -inf",
        ),
        (
            "t_s,u,rate\n0,0,1e999\n",
            "line 2, column \"rate\": must be finite, got inf",
        ),
        (
            "t_s,u,rate\n0,0,0\n0.1,0,120\n",
            "line 3, column \"rate\": must lie in -40 to 40 rad/s, got 120 rad/s; is it in another unit?",
        ),
        (
            "t_s,u,rate\n0,0,0\n0.2,0,0\n0.1,0,0\n",
            "line 4: time must increase from row to row, got 0.1 s after 0.2 s",
        ),
        (
            "t_s,u,rate\n0,0,0\n0,0,0\n",
            "line 3: time must increase from row to row, got 0 s after 0 s",
        ),
    ];
    for (text, message) in cases {
        assert_eq!(refusal(text), message, "{text:?}");
    }
}

#[test]
fn exact_files_of_another_kind_are_recognised() {
    for (bytes, kind) in [
        (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], FileKind::Binary),
        (b"\xff\xfet\0_\0s\0\n\0", FileKind::Binary),
        (b"<!DOCTYPE html>\n<html>", FileKind::Markup),
        (b"{\"t_s\": [0, 1]}", FileKind::Json),
        (b"[airframe]\nmass_kg = 1\n", FileKind::KeysAndValues),
        (b"name = \"Crazyflie\"\n", FileKind::KeysAndValues),
        (b"hub_m = [0.1, 0.2, 0.3]\n", FileKind::KeysAndValues),
        (b"battery_voltage_end: 3.89\n", FileKind::KeysAndValues),
        (b"t_s;u;rate\n0;0;0\n", FileKind::OtherSeparator),
        (b"t_s\tu\trate\n0\t0\t0\n", FileKind::OtherSeparator),
    ] {
        match read(bytes, &timed()) {
            Err(ReadError::OtherKind { kind: found, .. }) => assert_eq!(found, kind),
            other => panic!("{kind}: {other:?}"),
        }
    }
}

#[test]
fn exact_gaps_saturation_and_constants_are_remarked() {
    let mut text = String::from("t_s,u,rate\n");
    for k in 0..60 {
        let t = 0.1 * f64::from(k) + if k >= 30 { 1.0 } else { 0.0 };
        // Rises to the limit at row 20 and stays there for 25 rows; the file's row k is line k + 2.
        let rate = if k < 20 {
            f64::from(k)
        } else if k < 45 {
            34.9
        } else {
            1.0
        };
        text += &format!("{t:.1},0.5,{rate}\n");
    }
    let remarks = read(text.as_bytes(), &timed()).unwrap().remarks;
    assert_eq!(remarks.len(), 3, "{remarks:?}");
    assert!(
        matches!(remarks[0], Remark::Gaps { gaps: 1, line: 32, longest_s } if (longest_s - 1.1).abs() < 1e-9)
    );
    assert!(matches!(
        remarks[1],
        Remark::Constant {
            column: "u",
            value: 0.5,
            ..
        }
    ));
    assert!(matches!(
        remarks[2],
        Remark::Saturated {
            column: "rate",
            value: 34.9,
            rows: 25,
            line: 46,
            ..
        }
    ));
}

/// A reader that makes a file of any size out of nothing, and counts what was asked of it.
struct Endless {
    line: &'static [u8],
    sent: usize,
    limit: usize,
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = buffer.len().min(self.limit - self.sent);
        for (k, byte) in buffer[..count].iter_mut().enumerate() {
            *byte = self.line[(self.sent + k) % self.line.len()];
        }
        self.sent += count;
        Ok(count)
    }
}

#[test]
fn exact_a_gigabyte_without_a_line_end_is_refused_after_one_line() {
    let mut input = Endless {
        line: b"0123456789",
        sent: 0,
        limit: 1 << 30,
    };
    let error = read(&mut input, &timed()).unwrap_err();
    assert!(matches!(error, ReadError::LineTooLong { line: 1, .. }), "{error}");
    // The line and one buffer beyond it at most.
    assert!(input.sent < 100_000, "{} bytes read", input.sent);
}

#[test]
fn exact_only_a_measured_column_is_called_saturated() {
    // A duty of two values holds both for long, and so does a sensor at the end of its range.
    let mut text = "duty,thrust_n\n".to_owned();
    for k in 0..200 {
        let high = k / 50 % 2 == 1;
        text += if high { "0.08,4\n" } else { "0.07,3\n" };
    }
    let saturated = |columns: &[Column]| -> Vec<&'static str> {
        let remarks = read(text.as_bytes(), &Layout::table(columns)).unwrap().remarks;
        remarks
            .iter()
            .filter_map(|r| match r {
                Remark::Saturated { column, .. } => Some(*column),
                _ => None,
            })
            .collect()
    };
    let thrust = Column::new("thrust_n", "N", 0.0, 9.0);
    let commanded = [Column::commanded("duty", "1", 0.0, 1.0), thrust];
    let measured = [Column::new("duty", "1", 0.0, 1.0), thrust];
    // Both ends of each.
    assert_eq!(saturated(&commanded), ["thrust_n"; 2]);
    assert_eq!(saturated(&measured), ["duty", "duty", "thrust_n", "thrust_n"]);
}

#[test]
fn exact_a_gigabyte_of_rows_stops_at_the_limit_and_streams_without_holding_it() {
    let columns = [Column::new("x", "m", 0.0, 9.0)];
    let layout = Layout {
        row_limit: 1000,
        ..Layout::table(&columns).unnamed()
    };
    let endless = |limit| Endless {
        line: b"1\n2\n",
        sent: 0,
        limit,
    };
    let mut input = endless(1 << 30);
    assert!(matches!(
        read(&mut input, &layout),
        Err(ReadError::TooManyRows { limit: 1000 })
    ));
    assert!(input.sent < 20_000, "{} bytes read", input.sent);
    // Streaming has no limit: a million rows here, and a gigabyte is the same loop for longer.
    let mut sum = 0.0;
    let rows = scan(endless(2 << 20), &layout, |row| {
        sum += row.values[0];
        ControlFlow::Continue(())
    })
    .unwrap()
    .rows;
    assert_eq!((rows, sum), (1 << 20, 1.5 * f64::from(1 << 20)));
}

#[test]
fn exact_a_reader_that_fails_is_reported_with_its_line() {
    struct Broken(bool);
    impl Read for Broken {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            if std::mem::replace(&mut self.0, true) {
                return Err(io::Error::other("cable pulled"));
            }
            let text = b"t_s,u,rate\n0,0,0\n";
            buffer[..text.len()].copy_from_slice(text);
            Ok(text.len())
        }
    }
    let error = read(Broken(false), &timed()).unwrap_err().to_string();
    assert_eq!(error, "line 3: the file could not be read: cable pulled");
}

/// Whatever was read is finite, inside the ranges, and rises in time.
fn sound(bytes: &[u8]) -> Result<(), TestCaseError> {
    for layout in [timed(), timed().unnamed()] {
        let Ok(table) = read(bytes, &layout) else { continue };
        for (index, column) in COLUMNS.iter().enumerate() {
            let possible = |x: &f64| (column.minimum..=column.maximum).contains(x);
            prop_assert!(table.column(index).iter().all(possible));
        }
        prop_assert!(table.column(0).windows(2).all(|pair| pair[0] < pair[1]));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn prop_random_bytes_never_panic_nor_pass_bad_numbers(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        sound(&bytes)?;
    }

    #[test]
    fn prop_random_text_of_numbers_never_panics_nor_passes_bad_numbers(
        text in "(t_s|u|rate|[0-9.,+eE#\"\r\n -]|nan|inf|-?[0-9]{1,3}\\.[0-9]){0,120}"
    ) {
        sound(text.as_bytes())?;
        sound(format!("t_s,u,rate\n{text}").as_bytes())?;
    }

    #[test]
    fn prop_mutated_valid_files_never_panic_nor_pass_bad_numbers(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3_u8), 1..8)
    ) {
        let mut bytes = valid(30).into_bytes();
        for (index, byte, kind) in edits {
            let place = index.index(bytes.len());
            match kind {
                0 => bytes[place] = byte,
                1 => bytes.insert(place, byte),
                _ => { bytes.remove(place); }
            }
        }
        sound(&bytes)?;
    }
}
