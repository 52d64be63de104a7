//! A file replaced atomically, and an output that is rejected because it is an input under another name.
//!
//!     cargo run --release -p output --example replace_a_file

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::temp_dir().join(format!("output-example-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let (input, link) = (folder.join("measurements.csv"), folder.join("result.csv"));
    output::replace(&input, "load_n,reading_v\n0,0.1\n")?;
    std::fs::hard_link(&input, &link)?;

    let refused = output::keep_apart(&[input], &[link]);
    let why = refused.map_or_else(|clash| clash.to_string(), |()| "not refused".to_owned());
    output::print(&format!("{}\n", output::message(&why)))?;
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}
