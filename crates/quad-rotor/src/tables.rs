//! Published wind-tunnel tables of propellers, as CSV text with units in the column names.

/// APC Slow Flyer 10x4.7, static: speed, C_T, C_P.
///
/// Source: UIUC Propeller Data Site; Brandt and Selig, AIAA 2011-1255.
pub const APC_SF_10X4_7_STATIC_CSV: &str = include_str!("../data/propellers/apc_sf_10x4.7_static.csv");

/// APC Slow Flyer 10x4.7 in axial flow: run, speed, advance ratio J, C_T, C_P.
///
/// Source: UIUC Propeller Data Site; Brandt and Selig, AIAA 2011-1255.
pub const APC_SF_10X4_7_ADVANCE_CSV: &str = include_str!("../data/propellers/apc_sf_10x4.7_advance.csv");
