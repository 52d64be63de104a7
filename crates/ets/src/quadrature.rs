//! Gauss-Legendre rules: `∫ f ≈ Σ w_i f(x_i)` on [−1, 1], exact for polynomials up to degree 2n − 1.
//!
//! Abscissae and weights of half a rule each, every pair standing for ±x. Computed to 40 digits by Newton's method on the Legendre
//! polynomial; equal to the tables of Abramowitz, Stegun, 25.4. The tests hold them to the moments of the interval.

use quad_math::{Real, constant};

/// Half a Gauss-Legendre rule: abscissa and weight.
pub(crate) type HalfRule = [(f64, f64)];

/// The rule of 20 points.
pub(crate) const RULE_20: [(f64, f64); 10] = [
    (0.993_128_599_185_094_9, 0.017_614_007_139_152_118),
    (0.963_971_927_277_913_8, 0.040_601_429_800_386_94),
    (0.912_234_428_251_326, 0.062_672_048_334_109_07),
    (0.839_116_971_822_218_8, 0.083_276_741_576_704_75),
    (0.746_331_906_460_150_8, 0.101_930_119_817_240_44),
    (0.636_053_680_726_515, 0.118_194_531_961_518_41),
    (0.510_867_001_950_827_1, 0.131_688_638_449_176_64),
    (0.373_706_088_715_419_55, 0.142_096_109_318_382_04),
    (0.227_785_851_141_645_07, 0.149_172_986_472_603_74),
    (0.076_526_521_133_497_34, 0.152_753_387_130_725_84),
];

/// The rule of 32 points.
pub(crate) const RULE_32: [(f64, f64); 16] = [
    (0.997_263_861_849_481_6, 0.007_018_610_009_470_096),
    (0.985_611_511_545_268_4, 0.016_274_394_730_905_67),
    (0.964_762_255_587_506_4, 0.025_392_065_309_262_06),
    (0.934_906_075_937_739_7, 0.034_273_862_913_021_43),
    (0.896_321_155_766_052_1, 0.042_835_898_022_226_68),
    (0.849_367_613_732_57, 0.050_998_059_262_376_175),
    (0.794_483_795_967_942_4, 0.058_684_093_478_535_544),
    (0.732_182_118_740_289_7, 0.065_822_222_776_361_85),
    (0.663_044_266_930_215_2, 0.072_345_794_108_848_5),
    (0.587_715_757_240_762_3, 0.078_193_895_787_070_31),
    (0.506_899_908_932_229_4, 0.083_311_924_226_946_75),
    (0.421_351_276_130_635_33, 0.087_652_093_004_403_81),
    (0.331_868_602_282_127_67, 0.091_173_878_695_763_89),
    (0.239_287_362_252_137_06, 0.093_844_399_080_804_57),
    (0.144_471_961_582_796_5, 0.095_638_720_079_274_86),
    (0.048_307_665_687_738_32, 0.096_540_088_514_727_8),
];

/// An interval.
#[derive(Clone, Copy)]
pub(crate) struct Interval<R> {
    /// Lower end.
    pub(crate) low: R,
    /// Upper end.
    pub(crate) high: R,
}

/// `∫ f` over an interval by a rule.
#[inline(always)]
pub(crate) fn integrate<R: Real>(rule: &HalfRule, over: Interval<R>, f: impl Fn(R) -> R) -> R {
    let half = (over.high - over.low) * constant(0.5);
    let middle = (over.high + over.low) * constant(0.5);
    let sum = rule.iter().fold(R::zero(), |sum, &(node, weight)| {
        let step = half * constant(node);
        sum + (f(middle - step) + f(middle + step)) * constant(weight)
    });
    sum * half
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `∫ x^k dx` on [0, 2] is `2^(k+1)/(k+1)` up to the degree that the rule promises, and no longer beyond it.
    #[test]
    fn exact_moments() {
        for (rule, degree) in [(&RULE_20[..], 39), (&RULE_32[..], 63)] {
            let moment = |k: i32| integrate(rule, Interval { low: 0.0, high: 2.0 }, |x: f64| x.powi(k));
            let error = |k: i32| moment(k) / (2.0_f64.powi(k + 1) / f64::from(k + 1)) - 1.0;
            for k in 0..=degree {
                // Positive terms: the sum's relative error is a few roundings and those of the powers.
                assert!(error(k).abs() < 2e-14, "{k}: {}", error(k));
            }
            // Far past the degree the rule misses.
            assert!(error(8 * degree).abs() > 1e-9, "{}", error(8 * degree));
        }
    }
}
