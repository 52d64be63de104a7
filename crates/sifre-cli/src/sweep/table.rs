//! The table of a sweep: a row per run, as CSV or Parquet.

use super::Row;
use crate::disk;
use crate::exit::Failure;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;
use toml::Value;

/// Why the form of a table isn't known.
fn ending(path: &Path) -> Option<&str> {
    path.extension().and_then(|ending| ending.to_str())
}

/// Refuses a table that can't be written before anything is flown.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    match ending(path) {
        Some("csv" | "parquet") => Ok(()),
        _ => Err(Failure::Usage(format!(
            "--out must end in .csv or .parquet, got {}",
            path.display()
        ))),
    }
}

/// A column of the table.
struct Column {
    name: String,
    values: Values,
}

enum Values {
    Whole(Vec<i64>),
    /// NaN where it is missing.
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

/// Writes the table.
pub(crate) fn write(path: &Path, keys: &[String], rows: &[Row]) -> Result<(), Failure> {
    let columns = columns(keys, rows);
    let refuse = |error: String| Failure::Write {
        path: path.to_owned(),
        source: std::io::Error::other(error),
    };
    let content = match ending(path) {
        Some("csv") => csv(&columns, rows.len()).map_err(|error| refuse(error.to_string()))?,
        _ => parquet(&columns).map_err(|error| refuse(error.to_string()))?,
    };
    disk::replace(path, content)
}

/// Number, inputs, end, exit code, time, metrics.
fn columns(keys: &[String], rows: &[Row]) -> Vec<Column> {
    let column = |name: &str, values: Values| Column {
        name: name.to_owned(),
        values,
    };
    let whole = |of: fn(&Row) -> i64| Values::Whole(rows.iter().map(of).collect());
    let mut all = vec![column("run", whole(|row| row.run.cast_signed()))];
    for (k, key) in keys.iter().enumerate() {
        all.push(column(key, inputs(rows, k)));
    }
    all.push(column(
        "end",
        Values::Texts(rows.iter().map(|row| row.end.clone()).collect()),
    ));
    all.push(column("exit_code", whole(|row| row.exit_code.into())));
    let times = rows.iter().map(|row| row.time_s.unwrap_or(f64::NAN));
    all.push(column("time_s", Values::Numbers(times.collect())));
    for name in metrics(rows) {
        let one = |row: &Row| {
            row.metrics
                .iter()
                .find(|(other, _)| *other == name)
                .and_then(|(_, value)| *value)
        };
        let values = rows.iter().map(|row| one(row).unwrap_or(f64::NAN));
        all.push(column(&name, Values::Numbers(values.collect())));
    }
    all
}

/// The metrics of all runs: those of a step exist only where the set point jumps, so that runs may differ in them.
fn metrics(rows: &[Row]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut known = HashSet::new();
    for (name, _) in rows.iter().flat_map(|row| &row.metrics) {
        if known.insert(name) {
            names.push(name.clone());
        }
    }
    names
}

/// The values of a key: numbers if all are, texts otherwise.
fn inputs(rows: &[Row], k: usize) -> Values {
    let number = |row: &Row| match row.inputs.get(k)? {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    };
    let numbers: Option<Vec<f64>> = rows.iter().map(number).collect();
    let text = |row: &Row| match row.inputs.get(k) {
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
        None => String::new(),
    };
    numbers.map_or_else(|| Values::Texts(rows.iter().map(text).collect()), Values::Numbers)
}

fn csv(columns: &[Column], rows: usize) -> Result<Vec<u8>, csv::Error> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(columns.iter().map(|column| &column.name))?;
    for k in 0..rows {
        let field = |column: &Column| match &column.values {
            Values::Whole(values) => values[k].to_string(),
            Values::Numbers(values) if values[k].is_nan() => String::new(),
            Values::Numbers(values) => format!("{:?}", values[k]),
            Values::Texts(values) => values[k].clone(),
        };
        table.write_record(columns.iter().map(field))?;
    }
    table.into_inner().map_err(|error| error.into_error().into())
}

fn parquet(columns: &[Column]) -> Result<Vec<u8>, ParquetError> {
    let field = |column: &Column| {
        let physical = match column.values {
            Values::Whole(_) => Physical::INT64,
            Values::Numbers(_) => Physical::DOUBLE,
            Values::Texts(_) => Physical::BYTE_ARRAY,
        };
        let text = matches!(column.values, Values::Texts(_)).then_some(LogicalType::String);
        Type::primitive_type_builder(&column.name, physical)
            .with_repetition(Repetition::REQUIRED)
            .with_logical_type(text)
            .build()
            .map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("sweep").with_fields(fields).build()?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), properties)?;
    let mut group = writer.next_row_group()?;
    for column in columns {
        match &column.values {
            Values::Whole(values) => put::<Int64Type>(&mut group, values)?,
            Values::Numbers(values) => put::<DoubleType>(&mut group, values)?,
            Values::Texts(values) => {
                let texts: Vec<ByteArray> = values.iter().map(|text| text.as_str().into()).collect();
                put::<ByteArrayType>(&mut group, &texts)?;
            }
        }
    }
    group.close()?;
    writer.into_inner()
}

fn put<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[T::T],
) -> Result<(), ParquetError> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, None, None)?;
        column.close()?;
    }
    Ok(())
}
