//! Files of one item: SVG and PNG, CSV, settings, table.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::drawing::{Body, Drawing};
use crate::plot::raster::{self, RasterError};

/// Why the files of an item could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A file could not be written.
    #[error("cannot write {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// A table is ragged.
    #[error("cannot write {file}: {source}")]
    Csv {
        /// The file's name.
        file: String,
        /// What went wrong.
        source: csv::Error,
    },
    /// The picture could not be rasterised.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// The settings could not be written as TOML.
    #[error("cannot write the settings: {0}")]
    Settings(#[from] toml::ser::Error),
}

/// Writes all files of a drawing into `folder` and returns their names.
///
/// # Errors
/// The first file that cannot be made or written.
pub fn write(folder: &Path, id: &str, drawing: &Drawing) -> Result<Vec<String>, OutputError> {
    let mut files = Vec::new();
    let mut save = |name: String, content: &[u8]| -> Result<(), OutputError> {
        save_file(&folder.join(&name), content)?;
        files.push(name);
        Ok(())
    };
    match &drawing.body {
        Body::Picture(svg) => {
            save(format!("{id}.svg"), svg.document().as_bytes())?;
            save(format!("{id}.png"), &raster::png(svg)?)?;
            if let Some(table) = &drawing.beneath {
                save(format!("{id}.html"), table.to_html().as_bytes())?;
            }
        }
        Body::Animation(animation) => {
            save(animation_name(id), animation.page.as_bytes())?;
            if let Some(still) = &animation.still {
                save(format!("{id}.png"), still)?;
            }
        }
        Body::Table(table) => save(format!("{id}.html"), table.to_html().as_bytes())?,
    }
    for (name, table) in &drawing.data {
        let file = csv_name(id, name);
        let content = table.to_csv().map_err(|source| OutputError::Csv {
            file: file.clone(),
            source,
        })?;
        save(file, &content)?;
    }
    if let Some(settings) = &drawing.settings {
        save(format!("{id}.toml"), toml::to_string_pretty(settings)?.as_bytes())?;
    }
    for (k, scenario) in drawing.scenarios.iter().enumerate() {
        let is_first = k == 0 && drawing.settings.is_none();
        let name = if is_first { id } else { scenario.name };
        save(format!("{name}.toml"), scenario.text.as_bytes())?;
    }
    for (name, text) in &drawing.files {
        save(name.clone(), text.as_bytes())?;
    }
    Ok(files)
}

/// File name of an animation: `A.1-animation.html`.
pub fn animation_name(id: &str) -> String {
    format!("{id}-animation.html")
}

/// File name of a table of data: `6.4.csv`, or `6.4-inputs.csv` for a further one.
pub fn csv_name(id: &str, name: &str) -> String {
    if name.is_empty() {
        format!("{id}.csv")
    } else {
        format!("{id}-{name}.csv")
    }
}

/// Writes a file by way of a neighbour, so that an interrupted run leaves the old or the new one, never half.
///
/// # Errors
/// The file cannot be written.
pub fn save_file(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let written = fs::write(&partial, content).and_then(|()| fs::rename(&partial, path));
    written.map_err(|source| OutputError::Write {
        path: path.to_owned(),
        source,
    })
}
