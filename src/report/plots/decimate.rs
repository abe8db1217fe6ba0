//! Fewer points for the same picture: extremes and corners stay.

/// Points of a path in the plane, at most `most`, such that the picture changes least.
///
/// Ramer–Douglas–Peucker in coordinates scaled to the plot, with the tolerance halved and doubled
/// until the count fits. Points that are no numbers are left out.
pub(super) fn path(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = finite(points).collect();
    // Long records first keep the extremes of stretches; corners are sought among those.
    let points = extremes(&points, 16 * most);
    if points.len() <= most {
        return points;
    }
    let unit = to_unit_square(&points);
    let (mut finest, mut coarsest) = (0.0, 1.0);
    let mut best = simplify(&unit, coarsest);
    for _ in 0..14 {
        let tolerance = if finest == 0.0 {
            coarsest / 8.0
        } else {
            0.5 * (finest + coarsest)
        };
        let kept = simplify(&unit, tolerance);
        if kept.iter().filter(|kept| **kept).count() <= most {
            (coarsest, best) = (tolerance, kept);
        } else {
            finest = tolerance;
        }
    }
    let chosen = points.into_iter().zip(best);
    chosen
        .filter(|(_, kept)| *kept)
        .map(|(point, _)| point)
        .collect()
}

/// Points of a curve over a rising abscissa, at most `most`: of every stretch the first point and
/// both extremes of the ordinate.
pub(super) fn extremes(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = finite(points).collect();
    if points.len() <= most {
        return points;
    }
    let stretch = points.len().div_ceil((most / 4).max(1)).max(4);
    let mut kept = Vec::with_capacity(most);
    for points in points.chunks(stretch) {
        let mut picked: Vec<usize> = outermost(points).collect();
        picked.sort_unstable();
        picked.dedup();
        kept.extend(picked.into_iter().map(|index| points[index]));
    }
    kept
}

/// At most `most` points, evenly picked.
pub(super) fn every(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = finite(points).collect();
    let step = points.len().div_ceil(most.max(1)).max(1);
    points.into_iter().step_by(step).collect()
}

fn finite(points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    let points = points.iter().copied();
    points.filter(|(x, y)| x.is_finite() && y.is_finite())
}

fn to_unit_square(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let range = |coordinate: fn(&(f64, f64)) -> f64| {
        let values = points.iter().map(coordinate);
        let (lower, upper) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (v.min(a), v.max(b))
        });
        (lower, if upper > lower { upper - lower } else { 1.0 })
    };
    let (left, width) = range(|point| point.0);
    let (bottom, height) = range(|point| point.1);
    let scaled = points.iter();
    scaled
        .map(|(x, y)| ((x - left) / width, (y - bottom) / height))
        .collect()
}

/// Which points a path needs to stay within `tolerance` of itself.
fn simplify(points: &[(f64, f64)], tolerance: f64) -> Vec<bool> {
    let mut kept = vec![false; points.len()];
    let mut ends = vec![0, points.len() - 1];
    ends.extend(outermost(points));
    ends.sort_unstable();
    for end in &ends {
        kept[*end] = true;
    }
    let mut stretches: Vec<_> = ends.windows(2).map(|pair| (pair[0], pair[1])).collect();
    while let Some((from, to)) = stretches.pop() {
        let farthest = (from + 1..to)
            .map(|index| (distance(points[index], points[from], points[to]), index))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((far, index)) = farthest
            && far > tolerance
        {
            kept[index] = true;
            stretches.extend([(from, index), (index, to)]);
        }
    }
    kept
}

/// Where a path reaches farthest to each of the four sides.
fn outermost(points: &[(f64, f64)]) -> impl Iterator<Item = usize> {
    let across = |a: &usize, b: &usize| points[*a].0.total_cmp(&points[*b].0);
    let along = |a: &usize, b: &usize| points[*a].1.total_cmp(&points[*b].1);
    let indices = || 0..points.len();
    [
        indices().min_by(across),
        indices().max_by(across),
        indices().min_by(along),
        indices().max_by(along),
    ]
    .into_iter()
    .flatten()
}

/// Distance of a point from a stretch of line.
fn distance(point: (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (px, py) = (point.0 - from.0, point.1 - from.1);
    let length = dx * dx + dy * dy;
    let along = if length > 0.0 {
        ((px * dx + py * dy) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (px - along * dx).hypot(py - along * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spiral(count: usize) -> Vec<(f64, f64)> {
        let points = (0..count).map(|i| i as f64 * 0.01);
        points.map(|t| (t * t.cos(), t * t.sin())).collect()
    }

    #[test]
    fn paths_fit_and_stay_close() {
        let full = spiral(60_000);
        let kept = path(&full, 1500);
        assert!(kept.len() <= 1500 && kept.len() > 500, "{}", kept.len());
        let reach = |points: &[(f64, f64)]| points.iter().fold(0.0, |m: f64, p| m.max(p.0));
        assert_eq!(reach(&kept), reach(&full));
    }

    #[test]
    fn extremes_survive_a_single_spike() {
        let mut points: Vec<_> = (0..100_000).map(|i| (f64::from(i), 0.0)).collect();
        points[54_321].1 = 7.0;
        points[77_777].1 = f64::NAN;
        let kept = extremes(&points, 1500);
        assert!(kept.len() <= 1500);
        assert!(kept.contains(&(54_321.0, 7.0)));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}
