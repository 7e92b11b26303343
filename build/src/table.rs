//! Text tables.

/// Formats rows with aligned columns: the first to the left, the others to the right. The first row is
/// the header.
pub fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max()
    };
    let widths: Vec<_> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for (number, row) in rows.iter().enumerate() {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let space = " ".repeat(widths[column] - cell.chars().count());
            match column {
                0 => line.extend(["  ", cell, &space]),
                _ => line.extend(["   ", &space, cell]),
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
        if number == 0 {
            let rules: Vec<_> = widths.iter().map(|width| "-".repeat(*width)).collect();
            text.extend(["  ", &rules.join("   "), "\n"]);
        }
    }
    text
}

/// In the displayed units, smaller values are rounding errors.
pub const NOISE: f64 = 1e-9;

/// A number with five significant digits.
pub fn number(value: f64) -> String {
    if value.abs() < NOISE {
        return "0".to_string();
    }
    let exponent = libm::log10(value.abs()).floor();
    if (-4.0..6.0).contains(&exponent) {
        let digits = (4.0 - exponent).clamp(0.0, 8.0);
        format!("{value:.*}", digits as usize)
    } else {
        format!("{value:.4e}")
    }
}

/// Shorthand for rows.
pub fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_string).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_five_digits() {
        for (value, text) in [
            (0.0, "0"),
            (7702.081, "7702.1"),
            (-0.032123456, "-0.032123"),
            (1.5e-6, "1.5000e-6"),
            (-1e-12, "0"),
            (2.5e9, "2.5000e9"),
            (25900.0, "25900"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn columns_are_aligned() {
        let text = table(&[row(["a", "value"]), row(["long", "1"])]);
        assert_eq!(text, "  a      value\n  ----   -----\n  long       1\n");
    }
}
