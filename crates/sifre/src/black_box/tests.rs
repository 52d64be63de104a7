use super::*;
use proptest::prelude::*;
use std::sync::{Arc, Mutex};

fn channels(width: usize) -> Vec<Channel> {
    (0..width)
        .map(|i| Channel::new(format!("a,\"{i}\".x"), Role::Output, "m/s", Frame::Camera))
        .collect()
}

/// Writes rows to a black box as the engine does.
fn write(to: &mut dyn BlackBox, width: usize, rows: &[(u64, Vec<f64>)]) {
    to.begin(&channels(width)).unwrap();
    for (time_ns, row) in rows {
        to.record(*time_ns, row).unwrap();
    }
    to.finish().unwrap();
}

/// The same channels, instants and bits.
fn same(recording: &Recording, width: usize, rows: &[(u64, Vec<f64>)]) -> bool {
    let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    recording.channels() == channels(width)
        && recording.len() == rows.len()
        && recording
            .rows()
            .zip(rows)
            .all(|(read, (time_ns, row))| read.time_ns == *time_ns && bits(read.values) == bits(row))
}

fn rows() -> impl Strategy<Value = (usize, Vec<(u64, Vec<f64>)>)> {
    let number = any::<u64>().prop_map(|bits| {
        let number = f64::from_bits(bits);
        // CSV has one NaN.
        if number.is_nan() { f64::NAN } else { number }
    });
    (1..4_usize).prop_flat_map(move |width| {
        let row = prop::collection::vec(number.clone(), width);
        let rows = prop::collection::vec((0..1_u64 << 50, row), 0..8);
        (Just(width), rows)
    })
}

proptest! {
    #[test]
    fn prop_every_form_reads_back_bit_for_bit((width, rows) in rows()) {
        let mut memory = MemoryBox::default();
        write(&mut memory, width, &rows);
        prop_assert!(same(&memory.recording, width, &rows));

        let mut csv = CsvBox::new(Vec::new());
        write(&mut csv, width, &rows);
        let text = csv.into_inner().unwrap();
        prop_assert!(same(&Recording::from_csv(&text[..]).unwrap(), width, &rows));

        let mut json = JsonLinesBox::new(Vec::new());
        write(&mut json, width, &rows);
        let text = json.into_inner().unwrap();
        prop_assert!(same(&Recording::from_json_lines(&text[..]).unwrap(), width, &rows));
    }

    #[cfg(feature = "parquet")]
    #[test]
    fn prop_parquet_reads_back_bit_for_bit((width, rows) in rows()) {
        let mut parquet = ParquetBox::new(Vec::new());
        write(&mut parquet, width, &rows);
        let file = bytes(parquet);
        prop_assert!(same(&Recording::from_parquet(file).unwrap(), width, &rows));
    }
}

#[cfg(feature = "parquet")]
fn bytes(parquet: ParquetBox<Vec<u8>>) -> bytes::Bytes {
    parquet.into_inner().unwrap().into()
}

/// More rows than a row group holds: 8 MiB of a time and a number each.
#[cfg(feature = "parquet")]
#[test]
fn exact_parquet_is_written_in_row_groups() {
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    let rows = 600_000_u32;
    let mut parquet = ParquetBox::new(Vec::new());
    parquet.begin(&channels(1)).unwrap();
    for k in 0..rows {
        parquet.record(u64::from(k), &[f64::from(k) / 3.0]).unwrap();
    }
    let file = bytes(parquet);
    let groups = SerializedFileReader::new(file.clone()).unwrap().num_row_groups();
    assert_eq!(groups, 2, "524288 rows and the rest");
    let recording = Recording::from_parquet(file).unwrap();
    assert_eq!(recording.len(), rows as usize);
    let expected =
        |(k, row): (u32, Row<'_>)| row.time_ns == u64::from(k) && row.values == [f64::from(k) / 3.0];
    assert!((0..rows).zip(recording.rows()).all(expected));
}

#[test]
fn exact_csv_is_what_the_documentation_shows() {
    let mut csv = CsvBox::new(Vec::new());
    let channel = Channel::new("alpha.position.x", Role::State, "m", Frame::World);
    csv.begin(&[channel]).unwrap();
    csv.record(1_500_000_000, &[0.5]).unwrap();
    let text = String::from_utf8(csv.into_inner().unwrap()).unwrap();
    let expected = "# {\"sifre_recording\":1,\"channels\":[{\"name\":\"alpha.position.x\",\"role\":\"state\",\"unit\":\"m\",\"frame\":\"world\"}]}\n\
                    time_s,alpha.position.x\n1.500000000,0.5\n";
    assert_eq!(text, expected);
}

#[test]
fn exact_wrong_files_are_errors_that_say_where() {
    let header = Header::text(&channels(1)).unwrap();
    let wrong = |rest: &str| Recording::from_csv(format!("# {header}\ntime_s,x\n{rest}").as_bytes());
    assert!(matches!(
        Recording::from_csv(&b"time_s,x\n"[..]),
        Err(BlackBoxError::NoHeader { .. })
    ));
    assert!(matches!(
        wrong("0.000000000,1\n0.001000000\n"),
        Err(BlackBoxError::RowLength {
            row: 2,
            expected: 1,
            found: 0
        })
    ));
    assert!(matches!(
        wrong("0.000000000,one\n"),
        Err(BlackBoxError::NotANumber { row: 1, .. })
    ));
    assert!(matches!(
        wrong("0.1,1\n"),
        Err(BlackBoxError::NotANumber { row: 1, .. })
    ));
    let newer = header.replace("\"sifre_recording\":1", "\"sifre_recording\":2");
    assert!(matches!(
        Recording::from_json_lines(newer.as_bytes()),
        Err(BlackBoxError::Version {
            expected: 1,
            found: 2
        })
    ));
    let cut = format!("{header}\n{{\"time_ns\":0,\"val");
    assert!(matches!(
        Recording::from_json_lines(cut.as_bytes()),
        Err(BlackBoxError::Json { line: 2, .. })
    ));
    assert!(matches!(
        Recording::from_json_lines(&b""[..]),
        Err(BlackBoxError::NoHeader { .. })
    ));
}

/// Reads what is whole.
type Recover = fn(&[u8]) -> Result<Recovered, BlackBoxError>;

proptest! {
    /// However much of the file is lost: the rows before the cut come back bit for bit, and no other.
    #[test]
    fn prop_what_is_whole_is_recovered((width, rows) in rows(), cut in 0.0..1.0_f64) {
        let mut csv = CsvBox::new(Vec::new());
        write(&mut csv, width, &rows);
        let mut json = JsonLinesBox::new(Vec::new());
        write(&mut json, width, &rows);
        let recover: [(Vec<u8>, usize, Recover); 2] = [
            (csv.into_inner().unwrap(), 2, |text| Recording::recover_csv(text)),
            (json.into_inner().unwrap(), 1, |text| Recording::recover_json_lines(text)),
        ];
        for (text, heading, recover) in recover {
            let ends: Vec<usize> = (0..text.len()).filter(|&i| text[i] == b'\n').map(|i| i + 1).collect();
            let (from, to) = (ends[heading - 1], text.len());
            let at = from + ((to - from) as f64 * cut) as usize;
            let whole = ends.iter().filter(|&&end| end <= at).count() - heading;
            let recovered = recover(&text[..at]).unwrap();
            // JSON needs no end of line to be known as whole.
            let closed = text[..at].last() == Some(&b'}');
            let expected = whole + usize::from(closed && heading == 1);
            prop_assert!(same(&recovered.recording, width, &rows[..expected]));
            let is_cut = at != ends[whole + heading - 1] && !(closed && heading == 1);
            prop_assert_eq!(recovered.damage.is_some(), is_cut);
        }
    }
}

/// A row group whose pages are wrong does not take the ones before it along.
#[cfg(feature = "parquet")]
#[test]
fn exact_parquet_is_recovered_by_row_groups() {
    let mut parquet = ParquetBox::new(Vec::new());
    parquet.begin(&channels(1)).unwrap();
    for k in 0..600_000_u32 {
        parquet.record(u64::from(k), &[f64::from(k)]).unwrap();
    }
    let mut file = parquet.into_inner().unwrap();
    // 524288 rows of 16 bytes are in the first group; the second one's header of its first page follows.
    let second = 524_288 * 16;
    let end = second + 20_000;
    file[second..end].fill(0xff);
    let recovered = Recording::recover_parquet(::bytes::Bytes::from(file.clone())).unwrap();
    assert_eq!(recovered.recording.len(), 524_288);
    assert!(
        matches!(
            recovered.damage,
            Some(BlackBoxError::Damaged(ParquetDamage::Encoding { column: 1 }))
        ),
        "{:?}",
        recovered.damage
    );

    file.truncate(second);
    let error = Recording::recover_parquet(::bytes::Bytes::from(file)).unwrap_err();
    assert!(matches!(error, BlackBoxError::Unfinished(_)));
}

/// A disk that is full after so many bytes, and what is on it.
#[derive(Clone)]
struct Full(usize, Arc<Mutex<Vec<u8>>>);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let fits = bytes.len().min(self.0);
        if fits == 0 && !bytes.is_empty() {
            return Err(std::io::ErrorKind::StorageFull.into());
        }
        self.0 -= fits;
        self.1.lock().unwrap().extend(&bytes[..fits]);
        Ok(fits)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// It is an error, and CSV and JSON lines have filled it with what they would have begun with on a larger one, of which all whole
/// rows can be read (see above).
#[test]
fn exact_a_full_disk_is_an_error() {
    const BYTES: usize = 20_000;
    let fill = |to: &mut dyn BlackBox| -> Result<(), BlackBoxError> {
        to.begin(&channels(1))?;
        for k in 0..10_000 {
            to.record(k, &[0.1])?;
        }
        to.finish()
    };
    let disk = |bytes| Full(bytes, Arc::default());
    let written = |disk: Full| disk.1.lock().unwrap().clone();
    let (small, large) = (disk(BYTES), disk(usize::MAX));
    assert!(matches!(
        fill(&mut CsvBox::new(small.clone())),
        Err(BlackBoxError::Csv(_) | BlackBoxError::Io(_))
    ));
    fill(&mut CsvBox::new(large.clone())).unwrap();
    assert!(written(small) == written(large)[..BYTES]);

    let (small, large) = (disk(BYTES), disk(usize::MAX));
    assert!(matches!(
        fill(&mut JsonLinesBox::new(small.clone())),
        Err(BlackBoxError::Io(_))
    ));
    fill(&mut JsonLinesBox::new(large.clone())).unwrap();
    assert!(written(small) == written(large)[..BYTES]);

    #[cfg(feature = "parquet")]
    assert!(matches!(
        fill(&mut ParquetBox::new(disk(BYTES))),
        Err(BlackBoxError::Parquet(_))
    ));
}

#[cfg(feature = "parquet")]
proptest! {
    /// Whatever bytes are changed, a Parquet file gives no more than it has bytes for: an error before it asks for memory, or rows that fit.
    #[test]
    fn prop_a_damaged_parquet_file_holds_no_more_than_its_length(
        (width, rows) in rows(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut parquet = ParquetBox::new(Vec::new());
        write(&mut parquet, width, &rows);
        let mut file = parquet.into_inner().unwrap();
        for (place, byte) in changes {
            let place = place.index(file.len());
            file[place] = byte;
        }
        let length = file.len();
        if let Ok(recovered) = Recording::recover_parquet(::bytes::Bytes::from(file)) {
            let recording = recovered.recording;
            prop_assert!(recording.len() * (recording.channels().len() + 1) * size_of::<f64>() <= length);
        }
    }
}

#[test]
fn exact_an_instant_beyond_the_clock_is_refused() {
    let mut recording = Recording::new(channels(1));
    recording.push(1 << 50, &[0.0]).unwrap();
    let error = recording.push((1 << 50) + 1, &[0.0]).unwrap_err();
    assert!(matches!(error, BlackBoxError::Time { row: 2, .. }), "{error}");
}
