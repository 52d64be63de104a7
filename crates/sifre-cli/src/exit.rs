//! How the program ends.

use scenario::{End, MetricError, ScenarioError};
use std::path::PathBuf;
use std::process::ExitCode;

/// How the program ends, as its exit code tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Exit {
    /// All was done.
    Done,
    /// A flight ended early, or a check failed.
    Early,
    /// Nothing was flown.
    BadInput,
    /// An output could not be written.
    NotWritten,
    /// Ctrl-C.
    Interrupted,
}

impl Exit {
    /// The exit code.
    pub(crate) const fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Early => 1,
            Self::BadInput => 2,
            Self::NotWritten => 3,
            // What shells say of a program that SIGINT ended: 128 + 2.
            Self::Interrupted => 130,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

impl From<End> for Exit {
    fn from(end: End) -> Self {
        match end {
            End::Done => Self::Done,
            End::Early => Self::Early,
            End::Interrupted => Self::Interrupted,
            End::RecordingFailed => Self::NotWritten,
        }
    }
}

/// Why the program ends before its work.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// A file that can't be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file that can't be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// An output that is an input, or two outputs that are one file.
    #[error(transparent)]
    Clash(#[from] output::Clash),
    /// A file that exists.
    #[error("{}: already exists; choose another name or pass --force", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A scenario that can't be flown.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A metric that the flight doesn't have.
    #[error("--metric: {0}")]
    Metric(#[from] MetricError),
    /// An invalid argument.
    #[error("{0}")]
    Usage(String),
    /// A flight that had to finish and did not.
    #[error("{0}")]
    Flight(String),
    /// A recording that can't be started or finished.
    #[error("{}: {source}", path.display())]
    Recording {
        /// The file.
        path: PathBuf,
        /// Why.
        source: sifre::BlackBoxError,
    },
}

impl Failure {
    /// The exit code for it.
    pub(crate) const fn exit(&self) -> Exit {
        match self {
            Self::Write { .. } => Exit::NotWritten,
            Self::Flight(_) => Exit::Early,
            Self::Recording { source, .. } => match source {
                sifre::BlackBoxError::NothingSelected { .. } => Exit::BadInput,
                _ => Exit::NotWritten,
            },
            _ => Exit::BadInput,
        }
    }
}

impl From<sifre::SimulationError> for Failure {
    fn from(error: sifre::SimulationError) -> Self {
        Self::Scenario(error.into())
    }
}
