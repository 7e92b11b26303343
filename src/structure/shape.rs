//! Mode shapes between the nodes, and exact integrals of their products.

use super::beam::Beam;

/// A point on the beam with the values of its element's Hermite functions, shared by all shapes.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    /// Station, m from the nose.
    pub x: f64,
    /// Quadrature weight, m; 0 for a single point.
    pub weight: f64,
    element: usize,
    w: [f64; 4],
    slope: [f64; 4],
}

/// Deflection and slope at the nodes, cubic between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shape {
    /// Deflection w of the nodes, nose first.
    pub w: Vec<f64>,
    /// Slope dw/dx of the nodes; 1/m if w is dimensionless.
    pub slope: Vec<f64>,
}

impl Shape {
    /// From a displacement of [`Beam`], times `scale`.
    pub fn scaled(displacement: &[f64], scale: f64) -> Self {
        let every_second =
            |first: usize| displacement[first..].iter().step_by(2).map(|u| scale * u).collect();
        Self { w: every_second(0), slope: every_second(1) }
    }

    /// Deflection at a point.
    pub fn w_at(&self, point: &Point) -> f64 {
        self.at(point)[0]
    }

    /// Slope at a point.
    pub fn slope_at(&self, point: &Point) -> f64 {
        self.at(point)[1]
    }

    /// Deflection and slope at a point.
    #[inline]
    pub fn at(&self, point: &Point) -> [f64; 2] {
        let e = point.element;
        let ([w0, w1], [t0, t1]) = ([self.w[e], self.w[e + 1]], [self.slope[e], self.slope[e + 1]]);
        [&point.w, &point.slope].map(|by| by[0] * w0 + by[1] * t0 + by[2] * w1 + by[3] * t1)
    }
}

impl Beam {
    /// The point at station `x`, m; beyond an end the cubic of the last element is extrapolated.
    pub fn point(&self, x: f64) -> Point {
        self.point_in(((x / self.element_m) as usize).min(self.elements() - 1), x, 0.0)
    }

    fn point_in(&self, element: usize, x: f64, weight: f64) -> Point {
        let l = self.element_m;
        let s = (x - self.station(element)) / l;
        let r = 1.0 - s;
        Point {
            x,
            weight,
            element,
            w: [r * r * (1.0 + 2.0 * s), l * s * r * r, s * s * (3.0 - 2.0 * s), -l * s * s * r],
            slope: [-6.0 * s * r / l, r * (1.0 - 3.0 * s), 6.0 * s * r / l, s * (3.0 * s - 2.0)],
        }
    }

    /// Gauss points of `[from, to]`, four per element or piece of one.
    ///
    /// The quadrature is exact for polynomials of degree 7 in each element, such as the product of two shapes
    /// and x.
    pub fn gauss_points(&self, from: f64, to: f64) -> impl Iterator<Item = Point> {
        let last = self.elements() - 1;
        let element_of = move |x: f64| ((x / self.element_m) as usize).min(last);
        let rule = gauss_rule();
        (element_of(from)..=element_of(to)).flat_map(move |e| {
            let start = if e == 0 { from } else { from.max(self.station(e)) };
            let end = if e == last { to } else { to.min(self.station(e + 1)) };
            let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
            rule.map(|(node, weight)| self.point_in(e, middle + half * node, half * weight))
        })
    }

    /// Integral of `f` over `[from, to]`, exact under the condition of [`Beam::gauss_points`].
    pub fn integrate(&self, from: f64, to: f64, f: impl Fn(&Point) -> f64) -> f64 {
        self.gauss_points(from, to).map(|point| point.weight * f(&point)).sum()
    }
}

/// Gauss-Legendre rule with four points on `[-1, 1]`: nodes and weights.
fn gauss_rule() -> [(f64, f64); 4] {
    let spread = 2.0 / 7.0 * 1.2_f64.sqrt();
    let (inner, outer) = ((3.0 / 7.0 - spread).sqrt(), (3.0 / 7.0 + spread).sqrt());
    let root = 30.0_f64.sqrt();
    let (heavy, light) = ((18.0 + root) / 36.0, (18.0 - root) / 36.0);
    [(-outer, light), (-inner, heavy), (inner, heavy), (outer, light)]
}
