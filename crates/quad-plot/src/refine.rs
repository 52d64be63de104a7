//! A coarse grid made fine for smooth contours, by monotone cubics along rows, then along columns.
//!
//! The cubics are Fritsch and Butland's (SIAM J. Sci. Stat. Comput. 5, 1984): their slope is the weighted harmonic mean of the neighbouring
//! differences, zero at a turning point, so nothing is drawn that lies outside the values of the neighbouring nodes.

use super::contour::Grid;

/// The grid with `parts` pieces in place of each interval. A value next to one that is not finite stands alone.
pub(super) fn refined(grid: &Grid, parts: usize) -> Grid {
    let columns = grid.x.len();
    let fine_x = subdivided(&grid.x, parts);
    let rows = grid.values.chunks(columns.max(1));
    let rows: Vec<Vec<f64>> = rows.map(|row| along(&grid.x, row, &fine_x, parts)).collect();
    let fine_y = subdivided(&grid.y, parts);
    let mut values = vec![f64::NAN; fine_x.len() * fine_y.len()];
    for i in 0..fine_x.len() {
        let column: Vec<f64> = rows.iter().map(|row| row[i]).collect();
        for (j, value) in along(&grid.y, &column, &fine_y, parts).into_iter().enumerate() {
            values[j * fine_x.len() + i] = value;
        }
    }
    Grid {
        x: fine_x,
        y: fine_y,
        values,
    }
}

/// The nodes with `parts - 1` more between any two.
fn subdivided(nodes: &[f64], parts: usize) -> Vec<f64> {
    let between = |pair: &[f64]| {
        let (a, b) = (pair[0], pair[1]);
        (0..parts).map(move |k| a + (b - a) * k as f64 / parts as f64)
    };
    let last = nodes.last().copied();
    nodes.windows(2).flat_map(between).chain(last).collect()
}

/// Values at the subdivided nodes.
fn along(nodes: &[f64], values: &[f64], fine: &[f64], parts: usize) -> Vec<f64> {
    let value = |k: usize| values.get(k).copied().unwrap_or(f64::NAN);
    let slope: Vec<f64> = (0..nodes.len()).map(|k| slope_at(nodes, values, k)).collect();
    let at = |(index, x): (usize, &f64)| {
        let k = index / parts;
        if index % parts == 0 {
            return value(k);
        }
        let width = nodes[k + 1] - nodes[k];
        let s = (x - nodes[k]) / width;
        let (a, b) = (value(k), value(k + 1));
        let (from, to) = (slope[k] * width, slope[k + 1] * width);
        let cubic = s * s * (3.0 - 2.0 * s);
        a + (b - a) * cubic + s * (1.0 - s) * ((1.0 - s) * from - s * to)
    };
    fine.iter().enumerate().map(at).collect()
}

/// The slope at a node: between its neighbours, or towards the only one.
fn slope_at(nodes: &[f64], values: &[f64], k: usize) -> f64 {
    let difference = |k: usize| -> Option<(f64, f64)> {
        let width = nodes.get(k + 1)? - nodes.get(k)?;
        let slope = (values.get(k + 1)? - values.get(k)?) / width;
        slope.is_finite().then_some((width, slope))
    };
    match (k.checked_sub(1).and_then(difference), difference(k)) {
        (Some((left, before)), Some((right, after))) => {
            if before * after <= 0.0 {
                return 0.0;
            }
            let (w, v) = (2.0 * right + left, right + 2.0 * left);
            (w + v) / (w / before + v / after)
        }
        (Some((_, slope)), None) | (None, Some((_, slope))) => slope,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_a_plane_stays_one() {
        let axis = vec![0.0, 1.0, 3.0];
        let field = |x: f64, y: f64| 2.0 * x - y;
        let values = axis.iter().flat_map(|&y| axis.iter().map(move |&x| field(x, y)));
        let fine = refined(
            &Grid {
                values: values.collect(),
                x: axis.clone(),
                y: axis,
            },
            4,
        );
        assert_eq!((fine.x.len(), fine.values.len()), (9, 81));
        for (j, y) in fine.y.iter().enumerate() {
            for (i, x) in fine.x.iter().enumerate() {
                assert!((fine.values[j * 9 + i] - field(*x, *y)).abs() < 1e-12);
            }
        }
    }

    proptest! {
        #[test]
        fn prop_nothing_lies_outside_the_neighbouring_values(values in prop::collection::vec(-1.0..1.0_f64, 2..9)) {
            const PARTS: usize = 5;
            let nodes: Vec<f64> = (0..values.len()).map(|k| (k * k + k) as f64).collect();
            let fine = along(&nodes, &values, &subdivided(&nodes, PARTS), PARTS);
            for (index, value) in fine.iter().enumerate() {
                let k = index / PARTS;
                let (a, b) = (values[k], values[(k + 1).min(values.len() - 1)]);
                prop_assert!((a.min(b) - 1e-12..=a.max(b) + 1e-12).contains(value));
            }
        }
    }
}
