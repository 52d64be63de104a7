//! Table F.1: the Routh array of the horizontal loops of levels 1 and 2, symbolic and numeric.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_ndi::roots::spectral_abscissa;
use quad_ndi::routh::{RouthArray, Stability};
use quad_ndi::stability::{SecondOrder, TABLE_F1, TwoLoops, frequency_ratio_limit};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-F.1",
    title: "Routh-Hurwitz array of the horizontal response, levels 1 and 2",
    description: "The array of *s*^{4} + 2*ζ*_{a}*ω*_{a} *s*^{3} + *ω*_{a}^{2} *s*^{2} + 2*ζ*_{p}*ω*_{p}*ω*_{a}^{2} *s* + \
                  *ω*_{p}^{2}*ω*_{a}^{2}, in symbols and at the settings of appendix F (*ζ*_{p} = *ζ*_{a} = 1, \
                  *τ*_{s,p} = 2 s, *ω*_{a} = 10 *ω*_{p}).",
    kind: Kind::Table,
    origin: Origin::Derived,
    claims: &[AGREES, NUMERIC],
    make: Make::Draw(draw),
};

const AGREES: Claim =
    Claim::holds("the array agrees with eigenvalues everywhere on the grid of frequency ratio and damping");
const NUMERIC: Claim = Claim::holds("the symbolic entries evaluate to the numeric array");

/// Real parts nearer to zero than this, rad/s, are the boundary itself, where rounding decides.
const BOUNDARY: f64 = 1e-7;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let position = SecondOrder::settling_in(2.0, 1.0)?;
    let attitude = SecondOrder::new(10.0 * position.natural_frequency_rad_s(), 1.0)?;
    let loops = TwoLoops { position, attitude };
    let array = RouthArray::new(&loops.horizontal().characteristic())?;
    let mut shown = DisplayTable::new(["Row", "Column", "Expression", "Value"]);
    let mut data = DataTable::new(["power_of_s", "column", "value"]);
    let mut off = 0.0_f64;
    for entry in &TABLE_F1 {
        let value = (entry.value)(&loops);
        let row = &array.rows()[array.degree() - entry.power];
        let numeric = row.entries.get(entry.column).copied().unwrap_or(0.0);
        off = off.max((value - numeric).abs() / value.abs().max(1.0));
        shown.push([
            format!("*s*^{{{}}}", entry.power),
            (entry.column + 1).to_string(),
            entry.expression.to_owned(),
            format!("{value:.3}"),
        ]);
        data.push([
            (entry.power as f64).into(),
            (entry.column as f64).into(),
            value.into(),
        ]);
    }
    let (points, disagreements) = compare_on_grid(position)?;
    let limit = frequency_ratio_limit(1.0, 1.0)?;
    Ok(Drawing::table(shown)
        .data(data)
        .check(AGREES, disagreements == 0, format!("{disagreements} disagreements in {points} points"))
        // Rounding of the recursion on numbers up to ω_p² ω_a² = 7000.
        .check(NUMERIC, off < 1e-12, format!("largest relative difference {off:.1e}"))
        .note(format!("the array is stable for *ω*_{{a}}/*ω*_{{p}} > *ζ*_{{p}}/*ζ*_{{a}} + *ζ*_{{a}}/*ζ*_{{p}} = {limit:.3} at these dampings")))
}

/// Points compared and disagreements between the array's verdict and the eigenvalues'.
fn compare_on_grid(position: SecondOrder) -> Result<(usize, usize), ItemError> {
    let (mut points, mut disagreements) = (0, 0);
    for i in 0..77 {
        for j in 0..37 {
            let ratio = 1.0 + 0.25 * f64::from(i);
            let damping = 0.2 + 0.05 * f64::from(j);
            let attitude = SecondOrder::new(ratio * position.natural_frequency_rad_s(), damping)?;
            let coefficients = TwoLoops { position, attitude }.horizontal().characteristic();
            let abscissa = spectral_abscissa(&coefficients)?;
            if abscissa.abs() < BOUNDARY {
                continue;
            }
            points += 1;
            let stable = matches!(RouthArray::new(&coefficients)?.stability(), Stability::Asymptotic);
            disagreements += usize::from(stable != (abscissa < 0.0));
        }
    }
    Ok((points, disagreements))
}
