//! A curve of a figure: its points, decimated for drawing, and its dashes.

use crate::panels::Panel;
use crate::record::Record;

/// Fraction of a panel's smallest range below which a signal counts as constant.
const MIN_RELATIVE_RANGE: f64 = 1e-6;
/// Total vertical travel, over the panel height, above which dashes are unreadable.
const MAX_TRAVEL_IN_HEIGHTS: f64 = 60.0;

/// A curve in the unit of its panel.
pub struct Curve {
    /// Position among the panel's curves, which selects colour and dashes.
    pub number: usize,
    pub label: &'static str,
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// The curves of a panel: those that vary, or `all`.
    pub fn of(panel: &Panel, record: &Record, all: bool) -> Vec<Self> {
        let curve = |(number, (name, label)): (usize, &(&str, &'static str))| {
            let column = record.column(name)?;
            let first = record.values(column).next()?;
            let zero = if panel.deviation { first } else { 0.0 };
            let value = |value: f64| (value - zero) * panel.factor;
            let points = record.values(0).zip(record.values(column).map(value)).collect();
            let curve = Self { number, label, points };
            let [min, max] = curve.range();
            (all || max - min > MIN_RELATIVE_RANGE * panel.min_half_range).then_some(curve)
        };
        panel.curves.iter().enumerate().filter_map(curve).collect()
    }

    /// Least and largest value.
    pub fn range(&self) -> [f64; 2] {
        let values = self.points.iter().map(|point| point.1);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
    }

    /// Keeps at most four points per pixel column, which leaves the picture unchanged: the first, the
    /// last and both extremes.
    pub fn decimate(&mut self, columns: usize) {
        let (points, count) = (&self.points, self.points.len());
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
        if count <= 4 * columns {
            return;
        }
        let per_second = columns as f64 / (last.0 - first.0);
        let column = |point: &(f64, f64)| ((point.0 - first.0) * per_second) as usize;
        let mut kept = Vec::with_capacity(4 * columns);
        for group in points.chunk_by(|a, b| column(a) == column(b)) {
            let by_value = |a: &usize, b: &usize| group[*a].1.total_cmp(&group[*b].1);
            let end = group.len() - 1;
            let least = (0..=end).min_by(by_value).unwrap_or(0);
            let largest = (0..=end).max_by(by_value).unwrap_or(0);
            let mut places = [0, least, largest, end];
            places.sort_unstable();
            for (i, place) in places.into_iter().enumerate() {
                if i == 0 || place != places[i - 1] {
                    kept.push(group[place]);
                }
            }
        }
        self.points = kept;
    }

    /// Lengths of dash and gap, pixels; `None` for a solid line. The first curve and one that fills the
    /// panel are solid.
    pub fn dashes(&self, height: f64) -> Option<(u32, u32)> {
        let way: f64 = self.points.windows(2).map(|pair| (pair[1].1 - pair[0].1).abs()).sum();
        if way > MAX_TRAVEL_IN_HEIGHTS * height { None } else { dashes(self.number) }
    }
}

/// Dashes of a curve in a legend.
pub fn dashes(number: usize) -> Option<(u32, u32)> {
    [None, Some((9, 4)), Some((3, 3))].get(number).copied().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels::PANELS;

    #[test]
    fn a_million_points_become_few_and_keep_their_peaks() {
        let mut points: Vec<_> = (0..1_000_000).map(|n| (f64::from(n), 0.0)).collect();
        points[123_456].1 = 7.0;
        points[987_654].1 = -3.0;
        let mut curve = Curve { number: 0, label: "", points };
        curve.decimate(600);
        assert!(curve.points.len() <= 2400, "{}", curve.points.len());
        assert_eq!(curve.range(), [-3.0, 7.0]);
        assert!(curve.points.contains(&(123_456.0, 7.0)));
        assert_eq!((curve.points[0].0, curve.points[curve.points.len() - 1].0), (0.0, 999_999.0));
        assert!(curve.points.is_sorted_by(|a, b| a.0 < b.0));
        let before = curve.points.clone();
        curve.decimate(600);
        assert_eq!(curve.points, before, "few points stay as they are");
    }

    #[test]
    fn only_what_moves_is_drawn() {
        let names = ["time", "w_gust", "u_gust", "q"].map(String::from).to_vec();
        let rows = vec![vec![0.0, 0.0, 3.0, 0.0], vec![1.0, 5.0, 3.0, 1e-17]];
        let record = Record { names, rows };
        let gusts = Curve::of(&PANELS[2], &record, false);
        assert_eq!(gusts.iter().map(|curve| curve.label).collect::<Vec<_>>(), ["upwards"]);
        assert!(Curve::of(&PANELS[6], &record, false).is_empty(), "rounding noise");
        assert_eq!(Curve::of(&PANELS[6], &record, true).len(), 1);
    }
}
