//! Recordings read back from Parquet.
//!
//! What a [`ParquetBox`](super::ParquetBox) writes is plain, uncompressed and required, so a row of n channels has 8 (n + 1) bytes in the file. Pages are taken
//! from the library and their bytes read here, and no length that a file states is believed before the file is found to be long enough:
//! a damaged file can ask for no more memory than it has bytes.

use super::parquet_box::KEY;
use super::{BlackBoxError, Header, Recording, Recovered};
use parquet::basic::{Encoding, Type as Physical};
use parquet::column::page::Page;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData};
use parquet::file::reader::{ChunkReader, FileReader, RowGroupReader, SerializedFileReader};
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
        let bytes = from.len();
        let reader = caught(|| SerializedFileReader::new(from).map_err(BlackBoxError::Unfinished))?;
        let mut recording = Self::new(channels(reader.metadata())?);
        check_sizes(reader.metadata(), recording.channels().len() + 1, bytes)?;
        let read = (0..reader.num_row_groups()).try_for_each(|group| {
            let columns = caught(|| read_group(reader.get_row_group(group)?.as_ref()))?;
            push(&mut recording, &columns)
        });
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
            if !is_inside(chunk, bytes) {
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

/// Whether the bytes of a column are bytes of the file.
fn is_inside(chunk: &ColumnChunkMetaData, bytes: u64) -> bool {
    let start = chunk.dictionary_page_offset().unwrap_or(chunk.data_page_offset());
    let places = [
        start,
        chunk.data_page_offset(),
        chunk.compressed_size(),
        chunk.num_values(),
    ];
    places.iter().all(|place| *place >= 0)
        && i128::from(start) + i128::from(chunk.compressed_size()) <= i128::from(bytes)
}

/// The bits of a row group's columns.
fn read_group(group: &dyn RowGroupReader) -> Result<Vec<Vec<u64>>, BlackBoxError> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    (0..group.num_columns())
        .map(|column| read_column(group, column, rows))
        .collect()
}

/// The bits of a column's values.
fn read_column(group: &dyn RowGroupReader, column: usize, rows: usize) -> Result<Vec<u64>, BlackBoxError> {
    let mut pages = group.get_column_page_reader(column)?;
    let column = column + 1;
    let mut values = Vec::with_capacity(rows);
    while values.len() < rows
        && let Some(page) = pages.get_next_page()?
    {
        let is_plain = match &page {
            Page::DataPage { encoding, .. } => *encoding == Encoding::PLAIN,
            Page::DataPageV2 {
                encoding,
                def_levels_byte_len,
                rep_levels_byte_len,
                ..
            } => *encoding == Encoding::PLAIN && (*def_levels_byte_len, *rep_levels_byte_len) == (0, 0),
            Page::DictionaryPage { .. } => false,
        };
        let (numbers, rest) = page.buffer().as_chunks::<WIDTH>();
        if !is_plain || !rest.is_empty() || page.num_values() as usize != numbers.len() {
            return Err(ParquetDamage::Encoding { column }.into());
        }
        if numbers.len() > rows - values.len() {
            let found = values.len() + numbers.len();
            return Err(ParquetDamage::Values {
                column,
                expected: rows,
                found,
            }
            .into());
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
