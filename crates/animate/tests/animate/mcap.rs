//! MCAP files read back.
