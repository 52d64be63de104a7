//! Tests on recorded flights, which are not part of the repository (see `data/README.md`).

mod files;
mod frames;
mod identification;
mod replay;
