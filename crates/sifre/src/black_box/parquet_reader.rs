//! Recordings read back from Parquet.
//!
//! What a [`ParquetBox`](super::ParquetBox) writes is plain, uncompressed and required, so a row of n channels has 8 (n + 1) bytes in the file. The library
//! decodes the description at the file's end; pages are read here. No length that a file states is believed before the file is found
//! to be long enough: a damaged file can ask for no more memory and time than it has bytes.

use super::parquet_box::KEY;
use super::thrift::Thrift;
use super::{BlackBoxError, Header, Recording, Recovered};
use parquet::basic::Type as Physical;
use parquet::errors::ParquetError;
use parquet::file::metadata::{
    ColumnChunkMetaData, ParquetMetaData, ParquetMetaDataReader, RowGroupMetaData,
};
use parquet::file::reader::ChunkReader;
use std::panic::{self, AssertUnwindSafe};

/// Bytes of a time and of a number.
const WIDTH: usize = size_of::<f64>();

/// What parts of a Parquet file contradict each other.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParquetDamage {
    /// More rows than fit into the file.
    #[error("it states {rows} rows of {columns} columns, which its {bytes} bytes can't hold")]
    TooManyRows {
        /// Rows stated.
        rows: i128,
        /// Columns stated.
        columns: usize,
        /// Length of the file.
        bytes: u64,
    },
    /// A row group with other columns than the file, or of other types.
    #[error("row group {group}, column {column}: it is not a column of 8-byte times or numbers")]
    Column {
        /// The row group, from 1.
        group: usize,
        /// The column, from 1.
        column: usize,
    },
    /// A column with another number of values than there are rows.
    #[error("column {column} has {found} values, its row group has {expected} rows")]
    Values {
        /// The column, from 1.
        column: usize,
        /// Rows of its group.
        expected: usize,
        /// Values that were found.
        found: usize,
    },
    /// A column whose bytes are not in the file.
    #[error("row group {group}, column {column}: it is stated to be outside the file")]
    Outside {
        /// The row group, from 1.
        group: usize,
        /// The column, from 1.
        column: usize,
    },
    /// A page that black boxes don't write.
    #[error(
        "column {column} has pages that are encoded, compressed or optional; black boxes write plain, required ones"
    )]
    Encoding {
        /// The column, from 1.
        column: usize,
    },
    /// Lists with more elements than there are bytes.
    #[error("the description at its end has more elements than bytes")]
    Structure,
    /// The library came upon something that it had taken for impossible.
    #[error("its parts contradict each other")]
    Contradiction,
}

impl Recording {
    /// Reads what a [`ParquetBox`](super::ParquetBox) wrote: a [`std::fs::File`], or the bytes of one.
    ///
    /// # Errors
    /// If it can't be read, or is not what a [`ParquetBox`](super::ParquetBox) writes.
    pub fn from_parquet<C: ChunkReader + 'static>(from: C) -> Result<Self, BlackBoxError> {
        Self::recover_parquet(from)?.whole()
    }

    /// Reads the row groups that are whole of what a [`ParquetBox`](super::ParquetBox) wrote.
    ///
    /// # Errors
    /// If the file's end, which describes it, is missing or wrong.
    pub fn recover_parquet<C: ChunkReader + 'static>(from: C) -> Result<Recovered, BlackBoxError> {
        check_structure(&from)?;
        let metadata = caught(|| {
            let read = ParquetMetaDataReader::new().parse_and_finish(&from);
            read.map_err(BlackBoxError::Unfinished)
        })?;
        let mut recording = Self::new(channels(&metadata)?);
        check_sizes(&metadata, recording.channels().len() + 1, from.len())?;
        let mut groups = metadata.row_groups().iter();
        let read = groups.try_for_each(|group| push(&mut recording, &read_group(&from, group)?));
        Ok(Recovered::of(recording, read))
    }
}

/// What a call of the library gives; [`ParquetDamage::Contradiction`] if it panics, as it does where a file contradicts itself.
fn caught<T>(call: impl FnOnce() -> Result<T, BlackBoxError>) -> Result<T, BlackBoxError> {
    panic::catch_unwind(AssertUnwindSafe(call)).unwrap_or(Err(ParquetDamage::Contradiction.into()))
}

/// The channels that a file describes.
fn channels(metadata: &ParquetMetaData) -> Result<Vec<super::Channel>, BlackBoxError> {
    let file = metadata.file_metadata();
    let header = file
        .key_value_metadata()
        .and_then(|entries| entries.iter().find(|entry| entry.key == KEY))
        .and_then(|entry| entry.value.as_deref())
        .ok_or(BlackBoxError::NoHeader {
            expected: "the description of the channels among the file's metadata",
        })?;
    let channels = Header::channels(header)?;
    let found = file.schema_descr().num_columns();
    if found != channels.len() + 1 {
        return Err(BlackBoxError::RowLength {
            row: 1,
            expected: channels.len(),
            found: found.saturating_sub(1),
        });
    }
    Ok(channels)
}

/// Refuses a file that is shorter than what it states to have in it.
fn check_sizes(metadata: &ParquetMetaData, columns: usize, bytes: u64) -> Result<(), ParquetDamage> {
    let rows: i128 = metadata
        .row_groups()
        .iter()
        .map(|group| i128::from(group.num_rows().max(0)))
        .sum();
    if rows * columns as i128 * WIDTH as i128 > i128::from(bytes) {
        return Err(ParquetDamage::TooManyRows { rows, columns, bytes });
    }
    for (group, row_group) in (1..).zip(metadata.row_groups()) {
        for (column, chunk) in (1..).zip(row_group.columns()) {
            if !is_inside(chunk, row_group.num_rows(), bytes) {
                return Err(ParquetDamage::Outside { group, column });
            }
        }
        let physical = |column: usize| match column {
            0 => Physical::INT64,
            _ => Physical::DOUBLE,
        };
        let has = |column: &usize| {
            row_group
                .columns()
                .get(*column)
                .is_some_and(|c| c.column_type() == physical(*column))
        };
        if let Some(wrong) = (0..columns).find(|column| !has(column)) {
            return Err(ParquetDamage::Column {
                group,
                column: wrong + 1,
            });
        }
    }
    Ok(())
}

/// Whether the bytes of a column are bytes of the file, and no more than its rows and the heads of their pages take.
fn is_inside(chunk: &ColumnChunkMetaData, rows: i64, bytes: u64) -> bool {
    const HEADS: i128 = 1 << 16;
    let (start, length) = (
        i128::from(chunk.data_page_offset()),
        i128::from(chunk.compressed_size()),
    );
    let most = 2 * i128::from(rows) * WIDTH as i128 + HEADS;
    start >= 0 && (0..=most).contains(&length) && start + length <= i128::from(bytes)
}

/// The bits of a row group's columns.
fn read_group(from: &impl ChunkReader, group: &RowGroupMetaData) -> Result<Vec<Vec<u64>>, BlackBoxError> {
    let rows = usize::try_from(group.num_rows()).unwrap_or(0);
    (1..)
        .zip(group.columns())
        .map(|(column, chunk)| read_column(from, chunk, column, rows))
        .collect()
}

/// The bits of a column's values.
fn read_column(
    from: &impl ChunkReader,
    chunk: &ColumnChunkMetaData,
    column: usize,
    rows: usize,
) -> Result<Vec<u64>, BlackBoxError> {
    // Both were found to be within the file.
    let (start, length) = (
        chunk.data_page_offset().cast_unsigned(),
        chunk.compressed_size() as usize,
    );
    let bytes = from.get_bytes(start, length)?;
    let mut left: &[u8] = &bytes;
    let mut values = Vec::with_capacity(rows);
    while values.len() < rows && !left.is_empty() {
        let refused = ParquetDamage::Encoding { column };
        let header = PageHeader::read(&mut left).ok_or(refused.clone())?;
        let (page, rest) = left.split_at_checked(header.bytes).ok_or(refused.clone())?;
        left = rest;
        let (numbers, odd) = page.as_chunks::<WIDTH>();
        if !odd.is_empty() || header.values != numbers.len() {
            return Err(refused.into());
        }
        values.extend(numbers.iter().map(|bytes| u64::from_le_bytes(*bytes)));
    }
    if values.len() != rows {
        let found = values.len();
        return Err(ParquetDamage::Values {
            column,
            expected: rows,
            found,
        }
        .into());
    }
    Ok(values)
}

/// What precedes a page of plain values.
struct PageHeader {
    bytes: usize,
    values: usize,
}

impl PageHeader {
    /// Reads it off the front of a column; `None` if it is another kind of page, encoded or compressed.
    fn read(from: &mut &[u8]) -> Option<Self> {
        // Fields 1 to 5 of `PageHeader`; 1 and 2 of its `DataPageHeader`.
        const DATA_PAGE: i64 = 0;
        const PLAIN: i64 = 0;
        let mut thrift = Thrift::new(from);
        let [mut kind, mut plain, mut stored, mut count, mut encoding] = [None; 5];
        thrift.fields(0, &mut |number, at| {
            let to = match number {
                1 => &mut kind,
                2 => &mut plain,
                3 => &mut stored,
                5 => {
                    at.fields(1, &mut |number, at| {
                        let to = match number {
                            1 => &mut count,
                            2 => &mut encoding,
                            _ => return Some(false),
                        };
                        *to = Some(at.integer()?);
                        Some(true)
                    })?;
                    return Some(true);
                }
                _ => return Some(false),
            };
            *to = Some(at.integer()?);
            Some(true)
        })?;
        *from = &from[from.len() - thrift.left()..];
        ((kind, encoding) == (Some(DATA_PAGE), Some(PLAIN)) && plain == stored).then_some(Self {
            bytes: usize::try_from(stored?).ok()?,
            values: usize::try_from(count?).ok()?,
        })
    }
}

/// The structure at the end of a file, which the library is to decode, walked over before: length and `PAR1` are the last bytes.
fn check_structure(from: &impl ChunkReader) -> Result<(), BlackBoxError> {
    const TAIL: u64 = 8;
    let unfinished = |what: &str| BlackBoxError::Unfinished(ParquetError::General(what.to_owned()));
    let bytes = from.len();
    let Some(end) = bytes.checked_sub(TAIL) else {
        return Err(unfinished("it is shorter than its end"));
    };
    let tail = from.get_bytes(end, TAIL as usize)?;
    let &[a, b, c, d, b'P', b'A', b'R', b'1'] = tail.as_ref() else {
        return Err(unfinished("it does not end in PAR1"));
    };
    let length = u32::from_le_bytes([a, b, c, d]);
    let Some(start) = end.checked_sub(u64::from(length)) else {
        return Err(unfinished("its end is longer than the file"));
    };
    let structure = from.get_bytes(start, length as usize)?;
    Thrift::new(&structure)
        .structure(0)
        .ok_or(ParquetDamage::Structure.into())
}

/// Adds the rows of a row group.
fn push(recording: &mut Recording, columns: &[Vec<u64>]) -> Result<(), BlackBoxError> {
    let [times, values @ ..] = columns else {
        return Ok(());
    };
    let mut row = vec![0.0; values.len()];
    for (k, &time_ns) in times.iter().enumerate() {
        for (to, column) in row.iter_mut().zip(values) {
            *to = f64::from_bits(column[k]);
        }
        recording.push(time_ns, &row)?;
    }
    Ok(())
}
