//! Thinning of long series before they are drawn: what a reader sees stays, the SVG stays small.

/// A series longer than this many points per pixel of width is first reduced to its extremes per pixel.
const DENSE_POINTS_PER_PIXEL: f64 = 4.0;
/// Largest distance of a dropped point from the drawn line, px: below what any screen or printer resolves.
const TOLERANCE_PX: f64 = 0.08;

/// How many px one unit of data covers on each axis, after the logarithm where an axis has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// px per unit of x.
    pub x: f64,
    /// px per unit of y.
    pub y: f64,
}

/// Drops points that no reader could see, and splits the series where a coordinate is not finite.
///
/// A dense series with rising x keeps, in each column of pixels, its first, lowest, highest and last point; then
/// every series keeps the points that a polyline needs to stay within a tenth of a pixel (Ramer, Douglas, Peucker).
pub fn decimate(points: &[(f64, f64)], resolution: Resolution) -> Vec<Vec<(f64, f64)>> {
    let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
    let runs = points.split(|p| !finite(p)).filter(|run| !run.is_empty());
    runs.map(|run| simplify(&extremes_per_column(run, resolution), resolution))
        .collect()
}

fn extremes_per_column(run: &[(f64, f64)], resolution: Resolution) -> Vec<(f64, f64)> {
    let rising = run.windows(2).all(|pair| pair[0].0 <= pair[1].0);
    let width = (run[run.len() - 1].0 - run[0].0) * resolution.x;
    if !rising || (run.len() as f64) < DENSE_POINTS_PER_PIXEL * width {
        return run.to_vec();
    }
    let column = |p: &(f64, f64)| ((p.0 - run[0].0) * resolution.x).floor();
    let mut kept = Vec::new();
    for chunk in run.chunk_by(|a, b| column(a) == column(b)) {
        let by_height = |a: &usize, b: &usize| chunk[*a].1.total_cmp(&chunk[*b].1);
        let lowest = (0..chunk.len()).min_by(by_height).unwrap_or(0);
        let highest = (0..chunk.len()).max_by(by_height).unwrap_or(0);
        let mut indices = [0, lowest, highest, chunk.len() - 1];
        indices.sort_unstable();
        for (i, index) in indices.iter().enumerate() {
            if i == 0 || indices[i - 1] != *index {
                kept.push(chunk[*index]);
            }
        }
    }
    kept
}

fn simplify(points: &[(f64, f64)], resolution: Resolution) -> Vec<(f64, f64)> {
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[points.len() - 1] = true;
    let mut pending = vec![(0, points.len() - 1)];
    while let Some((first, last)) = pending.pop() {
        let offsets =
            (first + 1..last).map(|i| (i, offset(points[i], points[first], points[last], resolution)));
        if let Some((farthest, distance)) = offsets.max_by(|a, b| a.1.total_cmp(&b.1))
            && distance > TOLERANCE_PX
        {
            keep[farthest] = true;
            pending.push((first, farthest));
            pending.push((farthest, last));
        }
    }
    points
        .iter()
        .zip(keep)
        .filter(|(_, keep)| *keep)
        .map(|(point, _)| *point)
        .collect()
}

/// Distance of `p` from the segment from `a` to `b`, px.
fn offset(p: (f64, f64), a: (f64, f64), b: (f64, f64), resolution: Resolution) -> f64 {
    let scale = |q: (f64, f64)| ((q.0 - a.0) * resolution.x, (q.1 - a.1) * resolution.y);
    let (p, b) = (scale(p), scale(b));
    let length_squared = b.0 * b.0 + b.1 * b.1;
    let along = if length_squared > 0.0 {
        ((p.0 * b.0 + p.1 * b.1) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p.0 - along * b.0).hypot(p.1 - along * b.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RESOLUTION: Resolution = Resolution { x: 100.0, y: 100.0 };

    fn wave(count: usize) -> Vec<(f64, f64)> {
        (0..count)
            .map(|i| i as f64 / (count - 1) as f64 * 6.0)
            .map(|x| (x, x.sin()))
            .collect()
    }

    #[test]
    fn prop_a_smooth_curve_shrinks_and_stays_within_the_tolerance() {
        let full = wave(20_000);
        let runs = decimate(&full, RESOLUTION);
        let [kept] = runs.as_slice() else {
            panic!("one run")
        };
        assert!(kept.len() < 400, "{}", kept.len());
        assert_eq!((kept[0], kept[kept.len() - 1]), (full[0], full[full.len() - 1]));
        for p in &full {
            let nearest = kept
                .windows(2)
                .map(|s| offset(*p, s[0], s[1], RESOLUTION))
                .fold(f64::INFINITY, f64::min);
            // The extremes per column stay within one pixel of the curve they replace; most are far closer.
            assert!(nearest < 1.0);
        }
    }

    #[test]
    fn prop_a_spike_survives() {
        let mut full = wave(20_000);
        full[7_003].1 = 9.0;
        let highest = decimate(&full, RESOLUTION)
            .concat()
            .iter()
            .map(|p| p.1)
            .fold(f64::MIN, f64::max);
        assert_eq!(highest, 9.0);
    }

    #[test]
    fn prop_a_closed_curve_is_kept() {
        let circle: Vec<_> = (0..=5_000)
            .map(|i| f64::from(i) / 5_000.0 * std::f64::consts::TAU)
            .collect();
        let circle: Vec<_> = circle.iter().map(|a| (a.cos(), a.sin())).collect();
        let kept = decimate(&circle, RESOLUTION).concat();
        assert!(kept.len() > 30 && kept.len() < 300, "{}", kept.len());
        let lowest = kept.iter().map(|p| p.1).fold(f64::MAX, f64::min);
        assert!((lowest + 1.0).abs() * RESOLUTION.y < TOLERANCE_PX);
    }

    #[test]
    fn exact_gaps_split_the_series() {
        let points = [
            (0.0, 0.0),
            (1.0, 1.0),
            (f64::NAN, 0.0),
            (2.0, f64::INFINITY),
            (3.0, 0.0),
        ];
        assert_eq!(
            decimate(&points, RESOLUTION),
            [vec![(0.0, 0.0), (1.0, 1.0)], vec![(3.0, 0.0)]]
        );
    }
}
