//! A pair of axes, and drawing between them in pixels.

use ahv_tool::figure::{Area, Drawn, FONT, FRAME, GRID, decimals, label};
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Heights and widths at scale one.
const HEAD: u32 = 34;
pub const LEFT: u32 = 84;
const BOTTOM: u32 = 58;
const RIGHT: u32 = 16;
/// Size of all text; the page shows figures at no less than three quarters of their size.
pub const TEXT: u32 = 20;
const LABELS: usize = 6;
/// Length at scale one below which an axis has few labels.
const SHORT: u32 = 200;
const FEW_LABELS: usize = 4;

/// Title, names and ranges.
pub struct Axes<'a> {
    pub title: &'a str,
    pub names: [&'a str; 2],
    pub x: [f64; 2],
    pub y: [f64; 2],
}

/// Scale of the axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    Linear,
    /// Both axes; the plot then takes decimal logarithms.
    Logarithmic,
}

/// The space between the axes.
pub struct Plot<B: DrawingBackend> {
    pub area: Area<B>,
    pub scale: u32,
    x: [f64; 2],
    y: [f64; 2],
}

/// Range of values with a margin, never smaller than `least`.
pub fn range(values: impl Iterator<Item = f64> + Clone, least: f64) -> [f64; 2] {
    let min = values.clone().fold(f64::INFINITY, f64::min);
    let max = values.fold(f64::NEG_INFINITY, f64::max);
    let (min, max) = if min <= max { (min, max) } else { (0.0, 0.0) };
    let half = f64::max(0.58 * (max - min), 0.5 * least);
    let middle = 0.5 * (min + max);
    [middle - half, middle + half]
}

pub fn text(scale: u32) -> TextStyle<'static> {
    (FONT, TEXT * scale).into_font().color(&BLACK)
}

impl Axes<'_> {
    /// Draws frame, grid, names and title.
    pub fn draw<B: DrawingBackend>(
        &self,
        area: &Area<B>,
        scale: u32,
    ) -> Result<Plot<B>, DrawingAreaErrorKind<B::ErrorType>>
    where
        B::ErrorType: 'static,
    {
        self.draw_scaled(area, scale, Scale::Linear)
    }

    /// The same on linear or logarithmic axes.
    pub fn draw_scaled<B: DrawingBackend>(
        &self,
        area: &Area<B>,
        scale: u32,
        kind: Scale,
    ) -> Result<Plot<B>, DrawingAreaErrorKind<B::ErrorType>>
    where
        B::ErrorType: 'static,
    {
        let (head, body) = area.split_vertically(HEAD * scale);
        let left = text(scale).pos(Pos::new(HPos::Left, VPos::Center));
        let middle = (HEAD * scale / 2) as i32 + 2 * scale as i32;
        head.draw_text(self.title, &left, ((LEFT * scale) as i32, middle))?;
        let [[x0, x1], [y0, y1]] = [self.x, self.y];
        let (width, height) = body.dim_in_pixel();
        let labels = |pixels: u32, used: u32| match pixels < (SHORT + used) * scale {
            true => FEW_LABELS,
            false => LABELS,
        };
        let (x_labels, y_labels) = (labels(width, LEFT + RIGHT), labels(height, BOTTOM));
        let mut chart = ChartBuilder::on(&body);
        chart
            .margin_right(RIGHT * scale)
            .set_label_area_size(LabelAreaPosition::Left, LEFT * scale)
            .set_label_area_size(LabelAreaPosition::Bottom, BOTTOM * scale);
        let (area, x, y) = match kind {
            Scale::Linear => {
                let mut chart = chart.build_cartesian_2d(x0..x1, y0..y1)?;
                let [x, y] = [(x0..x1, x_labels), (y0..y1, y_labels)]
                    .map(|(range, labels)| decimals(range, labels));
                let words = |decimals: usize| {
                    move |value: &f64| label(*value, decimals).replace('-', "\u{2212}")
                };
                self.mesh(&mut chart, scale, &words(x), &words(y), [x_labels, y_labels])?;
                (chart.plotting_area().strip_coord_spec(), self.x, self.y)
            }
            Scale::Logarithmic => {
                let [x, y] = [(x0..x1).log_scale(), (y0..y1).log_scale()];
                let mut chart = chart.build_cartesian_2d(x, y)?;
                let words = |value: &f64| format!("{}", (value * 1e9).round() / 1e9);
                self.mesh(&mut chart, scale, &words, &words, [LABELS, 2 * LABELS])?;
                let area = chart.plotting_area().strip_coord_spec();
                (area, self.x.map(libm::log10), self.y.map(libm::log10))
            }
        };
        let plot = Plot { area, scale, x, y };
        let (w, h) = plot.size();
        let frame = vec![(0, 0), (w, 0), (w, h), (0, h), (0, 0)];
        plot.area.draw(&PathElement::new(frame, FRAME.stroke_width(scale)))?;
        Ok(plot)
    }

    fn mesh<B: DrawingBackend, X, Y>(
        &self,
        chart: &mut ChartContext<B, Cartesian2d<X, Y>>,
        scale: u32,
        x_words: &dyn Fn(&f64) -> String,
        y_words: &dyn Fn(&f64) -> String,
        [x_labels, y_labels]: [usize; 2],
    ) -> Drawn<B>
    where
        B::ErrorType: 'static,
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        chart
            .configure_mesh()
            .x_labels(x_labels)
            .y_labels(y_labels)
            .max_light_lines(0)
            .bold_line_style(GRID.stroke_width(scale))
            .axis_style(FRAME.stroke_width(scale))
            .set_all_tick_mark_size(4 * scale)
            .label_style(text(scale))
            .axis_desc_style(text(scale))
            .x_label_formatter(&x_words)
            .y_label_formatter(&y_words)
            .x_desc(self.names[0])
            .y_desc(self.names[1])
            .draw()
    }
}

impl<B: DrawingBackend> Plot<B> {
    /// Width and height in pixels.
    pub fn size(&self) -> (i32, i32) {
        let (width, height) = self.area.dim_in_pixel();
        (width as i32, height as i32)
    }

    /// Position of a value, in pixels.
    pub fn place(&self, (x, y): (f64, f64)) -> (i32, i32) {
        let (width, height) = self.size();
        let share = |value: f64, [from, to]: [f64; 2]| (value - from) / (to - from);
        let right = share(x, self.x) * f64::from(width);
        let down = (1.0 - share(y, self.y)) * f64::from(height);
        (right.round() as i32, down.round() as i32)
    }

    pub fn line(&self, points: &[(f64, f64)], style: ShapeStyle) -> Drawn<B> {
        let points: Vec<_> = points.iter().map(|point| self.place(*point)).collect();
        self.area.draw(&PathElement::new(points, style))
    }

    pub fn dashed(
        &self,
        points: &[(f64, f64)],
        (dash, gap): (u32, u32),
        style: ShapeStyle,
    ) -> Drawn<B> {
        let points: Vec<_> = points.iter().map(|point| self.place(*point)).collect();
        let (dash, gap) = (dash * self.scale, gap * self.scale);
        let element = plotters::element::DashedPathElement::new(points, dash, gap, style);
        self.area.draw(&element)
    }

    pub fn write(&self, words: &str, at: (i32, i32), anchor: HPos) -> Drawn<B> {
        let style = text(self.scale).pos(Pos::new(anchor, VPos::Center));
        self.area.draw_text(words, &style, at)
    }
}
