//! A load cell's line from ten readings, with the interval of its sensitivity.

use sysid::load_cell::{LoadCellError, Sample, calibrate};

fn main() -> Result<(), LoadCellError> {
    // 1 V at no load and 0.5 V/N; a millivolt of noise to either side by turns.
    let samples: Vec<Sample> = (0..10)
        .map(|k| (f64::from(k / 2), if k % 2 == 0 { 1e-3 } else { -1e-3 }))
        .map(|(load, noise)| Sample {
            load,
            reading_v: 1.0 + 0.5 * load + noise,
        })
        .collect();
    let sensitivity = calibrate(&samples, 16.0)?.sensitivity();
    assert!(sensitivity.interval().contains(0.5));
    println!("{:.4} ± {:.4} V/N", sensitivity.value, sensitivity.half_width());
    Ok(())
}
