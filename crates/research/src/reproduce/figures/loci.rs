//! Figs 6 to 8: loci of poles and zeros.

use super::axes::{Axes, LEFT, Plot, TEXT, range, text};
use super::marker::{self, Look};
use crate::reproduce::roots::Name;
use crate::reproduce::sweep::{Branch, Parameter, Sweep};
use ahv_tool::figure::{Area, Drawing, Drawn};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub const SIZE: (u32, u32) = (1000, 1410);
const LEGEND: i32 = 74;
const REAL_ROW: i32 = 230;
const COMPLEX_ROW: i32 = 430;
/// Sloshing frequencies above this part of the lowest one at the start are enlarged.
const STILL_HIGH: f64 = 0.9;

/// One sweep.
pub struct Loci<'a>(pub &'a Sweep);

impl Parameter {
    fn axis(self) -> &'static str {
        match self {
            Self::Fuel => "fuel, %",
            Self::Damping => "slosh damping ratio",
            Self::Frequency => "slosh freq., rad/s",
        }
    }

    fn shown(self, value: f64) -> f64 {
        if self == Self::Fuel { 100.0 * value } else { value }
    }

    fn way(self) -> String {
        let (from, to, _) = self.range();
        let number = |value: &f64| format!("{}", self.shown(*value));
        let marks: Vec<_> = self.marks().iter().map(number).collect();
        let (unit, what) = match self {
            Self::Fuel => (" %", "fuel"),
            Self::Damping => ("", "damping ratio"),
            Self::Frequency => (" rad/s", "slosh frequency"),
        };
        let (from, to) = (number(&from), number(&to));
        format!("{what}:  open {from}{unit},  dots {}{unit},  filled {to}{unit}", marks.join(", "))
    }
}

impl Drawing for Loci<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>, scale: u32) -> Drawn<B>
    where
        B::ErrorType: 'static,
    {
        let sweep = self.0;
        let inner = area.margin(6 * scale, 4 * scale, 4 * scale, 4 * scale);
        let unit = scale as i32;
        let cuts =
            [LEGEND, LEGEND + REAL_ROW, LEGEND + 2 * REAL_ROW, LEGEND + 2 * REAL_ROW + COMPLEX_ROW]
                .map(|y| y * unit);
        let rows = inner.split_by_breakpoints([0; 0], cuts);
        legend(&rows[0], sweep, scale)?;

        let pole = |name| sweep.pole(name);
        let zero = |name| sweep.zero(name);
        let real = [
            ("(a) short-period pole, stable", pole(Name::StableShortPeriod)),
            ("(b) short-period pole, unstable", pole(Name::UnstableShortPeriod)),
            ("(c) real zero, left half-plane", zero(Name::LeftZero)),
            ("(d) real zero, right half-plane", zero(Name::RightZero)),
        ];
        let cells = rows[1..3].iter().flat_map(|row| row.split_evenly((1, 2)));
        for (cell, (title, branch)) in cells.zip(real) {
            if let Some(branch) = branch {
                real_panel(&cell, title, branch, sweep, scale)?;
            }
        }
        let low = |branch: &&Branch| matches!(branch.name, Name::Slosh(_) | Name::Flexible(0));
        let high = |branch: &&Branch| matches!(branch.name, Name::Flexible(1 | 2));
        let titles = [
            ["(e) poles: slosh, 1st aeroelastic", "(f) zeros, same region"],
            ["(g) poles: 2nd, 3rd aeroelastic", "(h) zeros, same region"],
        ];
        for (row, titles) in rows[3..].iter().zip(titles) {
            let pick = |branches: &'static str| -> Vec<&Branch> {
                let all = if branches == "poles" { &sweep.poles } else { &sweep.zeros };
                let wanted = titles[0].starts_with("(e)");
                all.iter().filter(|b| if wanted { low(b) } else { high(b) }).collect()
            };
            let both = [pick("poles"), pick("zeros")];
            // The same range for both, for comparison.
            let values = || both.iter().flatten().flat_map(|branch| &branch.values);
            let mut x = range(values().map(|value| value.re), 0.1);
            let enlarged = sweep.parameter == Parameter::Fuel && titles[0].starts_with("(e)");
            if enlarged {
                // Room on the right, where no branch goes.
                x[1] = x[0] + (x[1] - x[0]) * 100.0 / f64::from(INSET);
            }
            let y = range(values().map(|value| value.im), 1.0);
            for ((cell, title), branches) in row.split_evenly((1, 2)).iter().zip(titles).zip(&both)
            {
                let axes = Axes { title, names: ["Re s, rad/s", "Im s, rad/s"], x, y };
                let plot = axes.draw(cell, scale)?;
                for branch in branches {
                    draw_branch(&plot, branch.name, &places(branch), sweep)?;
                }
                if enlarged {
                    enlarge(&plot, branches, &both.concat(), sweep)?;
                }
            }
        }
        Ok(())
    }
}

/// Where the enlarged part of a panel begins, per cent of its width.
const INSET: i32 = 43;

/// A real root over the parameter, which is upwards, so that the branch does not overlap itself.
fn real_panel<B: DrawingBackend>(
    area: &Area<B>,
    title: &str,
    branch: &Branch,
    sweep: &Sweep,
    scale: u32,
) -> Drawn<B>
where
    B::ErrorType: 'static,
{
    let parameter = sweep.parameter;
    let points: Vec<_> = branch
        .values
        .iter()
        .zip(&sweep.steps)
        .map(|(value, step)| (value.re, parameter.shown(*step)))
        .collect();
    // At least 2 % of the value, so that small changes look small.
    let least = 0.02 * branch.first().norm();
    let x = range(points.iter().map(|(re, _)| *re), least);
    let y = range(points.iter().map(|(_, step)| *step), 0.0);
    let axes = Axes { title, names: ["Re s, rad/s", parameter.axis()], x, y };
    let plot = axes.draw(area, scale)?;
    draw_branch(&plot, branch.name, &points, sweep)
}

fn places(branch: &Branch) -> Vec<(f64, f64)> {
    branch.values.iter().map(|v| (v.re, v.im)).collect()
}

/// Enlarges the part in which the sloshing frequencies are close together, in the free part of the panel.
fn enlarge<B: DrawingBackend>(
    plot: &Plot<B>,
    branches: &[&Branch],
    both: &[&Branch],
    sweep: &Sweep,
) -> Drawn<B>
where
    B::ErrorType: 'static,
{
    let slosh = |branch: &&&Branch| matches!(branch.name, Name::Slosh(_));
    let starts = both.iter().filter(slosh).map(|branch| branch.first().im);
    let lowest = STILL_HIGH * starts.fold(f64::INFINITY, f64::min);
    let high = |branch: &Branch| -> Vec<_> {
        places(branch).into_iter().take_while(|(_, im)| *im > lowest).collect()
    };
    let values: Vec<_> = both.iter().filter(slosh).flat_map(|branch| high(branch)).collect();
    let scale = plot.scale;
    let (width, height) = plot.size();
    let corner = plot
        .area
        .clone()
        .shrink((width * INSET / 100, height * 3 / 100), (width * 56 / 100, height * 68 / 100));
    corner.fill(&WHITE)?;
    let axes = Axes {
        title: "slosh, enlarged",
        names: ["Re s, rad/s", ""],
        x: range(values.iter().map(|(re, _)| *re), 0.1),
        y: range(values.iter().map(|(_, im)| *im), 0.1),
    };
    let inset = axes.draw(&corner, scale)?;
    for branch in branches.iter().filter(slosh) {
        let look = Look::of(branch.name);
        let pixels = draw_path(&inset, look, &high(branch), sweep)?;
        if let Some(first) = pixels.first() {
            marker::draw(&inset.area, look, *first, false, scale)?;
        }
    }
    Ok(())
}

fn draw_branch<B: DrawingBackend>(
    plot: &Plot<B>,
    name: Name,
    points: &[(f64, f64)],
    sweep: &Sweep,
) -> Drawn<B> {
    let look = Look::of(name);
    let pixels = draw_path(plot, look, points, sweep)?;
    if let [first, .., last] = pixels.as_slice() {
        marker::draw(&plot.area, look, *first, false, plot.scale)?;
        marker::draw(&plot.area, look, *last, true, plot.scale)?;
    }
    Ok(())
}

/// Line, dots and arrow; its pixels.
fn draw_path<B: DrawingBackend>(
    plot: &Plot<B>,
    look: Look,
    points: &[(f64, f64)],
    sweep: &Sweep,
) -> Result<Vec<(i32, i32)>, DrawingAreaErrorKind<B::ErrorType>> {
    let scale = plot.scale;
    plot.line(points, look.colour.stroke_width(2 * scale))?;
    let pixels: Vec<_> = points.iter().map(|point| plot.place(*point)).collect();
    for mark in sweep.parameter.marks() {
        if let Some(at) = pixels.get(sweep.step_at(*mark)) {
            let dot = Circle::new(*at, 3 * scale, look.colour.filled());
            plot.area.draw(&dot)?;
        }
    }
    marker::arrow(&plot.area, look.colour, &pixels, scale)?;
    Ok(pixels)
}

fn legend<B: DrawingBackend>(area: &Area<B>, sweep: &Sweep, scale: u32) -> Drawn<B> {
    let style = text(scale).pos(Pos::new(HPos::Left, VPos::Center));
    let unit = scale as i32;
    let mut x = LEFT as i32 * unit;
    let named = sweep.poles.iter().map(|branch| branch.name);
    let mut names: Vec<Name> =
        named.filter(|name| matches!(name, Name::Flexible(_) | Name::Slosh(_))).collect();
    names.sort_by_key(|name| match name {
        Name::Slosh(i) => (1, *i),
        Name::Flexible(i) => (0, *i),
        _ => (2, 0),
    });
    for name in names {
        let look = Look::of(name);
        marker::draw(area, look, (x, 16 * unit), false, scale)?;
        marker::draw(area, look, (x + 15 * unit, 16 * unit), true, scale)?;
        x += 28 * unit;
        let words = name.to_string();
        area.draw_text(&words, &style, (x, 16 * unit))?;
        x += area.estimate_text_size(&words, &style)?.0 as i32 + 26 * unit;
    }
    let line = (16 + TEXT as i32 * 3 / 2 + 2) * unit;
    area.draw_text(&sweep.parameter.way(), &style, ((LEFT as i32 - 6) * unit, line))
}
