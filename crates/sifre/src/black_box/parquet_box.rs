//! Recordings as Parquet: a required column per channel, and the channels' description as metadata of the file.
//!
//! The first column is `time_ns` (INT64), the others are DOUBLE, plain and uncompressed: floating-point noise gains
//! little from compression, and every reader understands it. Rows are collected to row groups of at most
//! [`ROW_GROUP_BYTES`] in memory.

use super::{BlackBox, BlackBoxError, Channel, Header};
use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::{DataType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::io::Write;
use std::sync::Arc;

/// The key of the channels' description among the file's metadata.
pub(super) const KEY: &str = "sifre_recording";

/// What is collected before it is written, bytes.
const ROW_GROUP_BYTES: usize = 8 << 20;

/// Streams a recording as Parquet. The file is complete, and readable, once it is finished: what a full disk or a kill leaves of it
/// can't be read. Where that matters, record CSV or JSON lines.
#[derive(Debug)]
pub struct ParquetBox<W: Write + Send> {
    file: File<W>,
}

#[derive(Debug)]
enum File<W: Write + Send> {
    Blank(W),
    Open(Box<Open<W>>),
    Complete(W),
    /// After an error on the way from one to the next.
    Lost,
}

/// A file whose columns are known.
#[derive(Debug)]
struct Open<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    times: Vec<i64>,
    columns: Vec<Vec<f64>>,
    rows_per_group: usize,
}

impl<W: Write + Send> ParquetBox<W> {
    /// Writes to a file, a pipe or memory.
    pub fn new(to: W) -> Self {
        Self {
            file: File::Blank(to),
        }
    }

    /// What it wrote to, with the complete file in it.
    ///
    /// # Errors
    /// If the rest can't be written, or an error came before.
    pub fn into_inner(self) -> Result<W, BlackBoxError> {
        match self.file {
            File::Blank(to) | File::Complete(to) => Ok(to),
            File::Open(open) => open.complete(),
            File::Lost => Err(NOT_BEGUN),
        }
    }
}

const NOT_BEGUN: BlackBoxError = BlackBoxError::NoHeader {
    expected: "the beginning of the recording",
};

impl<W: Write + Send> Open<W> {
    /// Writes what is left and the file's end.
    fn complete(mut self) -> Result<W, BlackBoxError> {
        self.write_group()?;
        let mut to = self.writer.into_inner()?;
        to.flush()?;
        Ok(to)
    }

    /// Writes the rows collected so far as a row group.
    fn write_group(&mut self) -> Result<(), BlackBoxError> {
        if self.times.is_empty() {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        write_column::<Int64Type, W>(&mut group, &self.times)?;
        for column in &self.columns {
            write_column::<DoubleType, W>(&mut group, column)?;
        }
        group.close()?;
        self.times.clear();
        self.columns.iter_mut().for_each(Vec::clear);
        Ok(())
    }
}

fn write_column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
) -> Result<(), BlackBoxError> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, None, None)?;
        column.close()?;
    }
    Ok(())
}

/// A column that every row has a value in.
fn required(name: &str, physical: Physical) -> Result<Arc<Type>, BlackBoxError> {
    let column = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED);
    Ok(Arc::new(column.build()?))
}

impl<W: Write + Send + 'static> BlackBox for ParquetBox<W> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        let File::Blank(to) = std::mem::replace(&mut self.file, File::Lost) else {
            return Err(BlackBoxError::NoHeader {
                expected: "a file that is not begun yet",
            });
        };
        let mut fields = vec![required("time_ns", Physical::INT64)?];
        for channel in channels {
            fields.push(required(&channel.name, Physical::DOUBLE)?);
        }
        let schema = Type::group_type_builder("recording")
            .with_fields(fields)
            .build()?;
        let properties = WriterProperties::builder()
            .set_compression(Compression::UNCOMPRESSED)
            .set_dictionary_enabled(false)
            .set_key_value_metadata(Some(vec![KeyValue::new(KEY.to_owned(), Header::text(channels)?)]))
            .build();
        let row_bytes = (channels.len() + 1) * size_of::<f64>();
        self.file = File::Open(Box::new(Open {
            writer: SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties))?,
            times: Vec::new(),
            columns: vec![Vec::new(); channels.len()],
            rows_per_group: (ROW_GROUP_BYTES / row_bytes).max(1),
        }));
        Ok(())
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        let File::Open(open) = &mut self.file else {
            return Err(NOT_BEGUN);
        };
        // The engine's clock ends at 2⁵⁰ ns, far below the largest i64.
        open.times.push(time_ns.cast_signed());
        for (column, &value) in open.columns.iter_mut().zip(row) {
            column.push(value);
        }
        if open.times.len() >= open.rows_per_group {
            open.write_group()?;
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        match std::mem::replace(&mut self.file, File::Lost) {
            File::Open(open) => self.file = File::Complete(open.complete()?),
            other => self.file = other,
        }
        Ok(())
    }
}
