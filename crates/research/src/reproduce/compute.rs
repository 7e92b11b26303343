//! Computes the requested parts of a report.

use super::claims::{Evidence, test};
use super::coefficient_sets::Set;
use super::figures::{loci, shapes, tradeoff, veering as veering_figure};
use super::fit_errors::FitErrors;
use super::inertia_laws::Laws;
use super::interaction::Interaction;
use super::operating_point::{Gamma, OperatingPoint};
use super::origin::Origin;
use super::report::{ERRATA, Figure, PAPER, Report, SetReport};
use super::sweep::{Parameter, Sweep};
use super::tables::{Table, table1, table2, table3};
use super::veering::Veering;
use super::{Part, claims};
use crate::identify::{Place, TradeOff};
use crate::published::Published;
use ahv::data::{AeroSet, Data};
use ahv::flight::Parameters;
use ahv::structure::Modes;
use ahv::vehicle::{Configuration, VehicleDefinition, VehicleOptions, structure};
use ahv_tool::figure::{Drawing, files};
use ahv_tool::workspace::Files;
use anyhow::Result;
use std::cell::RefCell;
use std::path::PathBuf;

const CONFIGURATIONS: [Configuration; 3] =
    [Configuration::Rigid, Configuration::EvenMassBeam, Configuration::SloshBeam];
/// The sweeps and their figures.
const SWEEPS: [(Parameter, Part, &str, &str); 3] = [
    (Parameter::Fuel, Part::Fig6, "fig6", "Fig. 6: poles and zeros while fuel is burnt"),
    (Parameter::Damping, Part::Fig7, "fig7", "Fig. 7: poles and zeros over slosh damping"),
    (Parameter::Frequency, Part::Fig8, "fig8", "Fig. 8: poles and zeros over slosh frequency"),
];

pub struct Computation<'a> {
    parts: &'a [Part],
    figures: PathBuf,
    /// The figures drawn so far.
    pub drawn: RefCell<Files>,
    data: Data,
    published: Published,
    base: VehicleOptions,
}

impl<'a> Computation<'a> {
    pub fn new(parts: &'a [Part], figures: PathBuf) -> Result<Self> {
        let data = Data::embedded()?;
        let base = Parameters::new(&data).options;
        let drawn = RefCell::default();
        Ok(Self { parts, figures, drawn, data, published: Published::embedded()?, base })
    }

    fn wants(&self, parts: &[Part]) -> bool {
        parts.iter().any(|part| self.parts.contains(part))
    }

    pub fn report(&self, sets: &[Set]) -> Result<Report> {
        let mut table = None;
        if self.wants(&[Part::Table1]) {
            errln!("table 1");
            table = Some(self.table1()?);
        }
        let mut figures = Vec::new();
        if self.wants(&[Part::Fig3]) {
            figures.push(self.fig3()?);
        }
        if self.wants(&[Part::Fig5]) {
            figures.push(self.fig5()?);
        }
        let mut veering = Vec::new();
        if self.wants(&[Part::Interaction]) {
            errln!("veering of the modes: half and full tanks");
            for fuel in [0.5, 1.0] {
                veering.push(Veering::new(&self.data, &self.base, fuel)?);
            }
            self.draw(&veering_figure::Figure(&veering), veering_figure::SIZE, "veering")?;
        }
        let trade_off = self.trade_off()?;
        let best = trade_off.as_ref().map(|trade_off| self.best(trade_off)).transpose()?;
        let set = |set| self.set(set, best.as_ref());
        Ok(Report {
            paper: PAPER,
            version: env!("CARGO_PKG_VERSION"),
            table1: table,
            figures,
            veering,
            sets: sets.iter().map(set).collect::<Result<_>>()?,
            origin: self.origin()?,
            trade_off,
            fit: self.wants(&[Part::Fit]).then(FitErrors::embedded).transpose()?,
            errata: self.wants(&[Part::Errata]).then_some(ERRATA),
        })
    }

    fn trade_off(&self) -> Result<Option<TradeOff>> {
        if !self.wants(&[Part::Tradeoff]) {
            return Ok(None);
        }
        errln!("xu2015: trade-off between misfit and distance, in both directions");
        let trade_off = TradeOff::new(&|place| {
            let Place { weight, distance, misfit } = place;
            errln!("  weight {weight:<8.2e} distance {distance:<10.4} misfit {misfit:.1}");
        })?;
        self.draw(&tradeoff::Figure(&trade_off), tradeoff::SIZE, "tradeoff")?;
        Ok(Some(trade_off))
    }

    /// The best fit with one inertia and free stations.
    fn best(&self, trade_off: &TradeOff) -> Result<[OperatingPoint; 3]> {
        let of = |configuration| {
            let options = VehicleOptions { configuration, aero: AeroSet::Xu2015, ..self.base };
            let definition =
                VehicleDefinition::with_coefficients(&self.data, &options, &trade_off.best_set);
            OperatingPoint::of(definition, Gamma::Printed)
        };
        let [rigid, even, slosh] = CONFIGURATIONS.map(of);
        Ok([rigid?, even?, slosh?])
    }

    fn origin(&self) -> Result<Option<Origin>> {
        if !self.wants(&[Part::Origin]) {
            return Ok(None);
        }
        errln!("where the printed digits come from");
        Origin::new(&self.data, &self.base, &self.published).map(Some)
    }

    fn table1(&self) -> Result<Table> {
        Ok(table1(&self.published.table1, &points(&self.data, &self.base)?))
    }

    fn set(&self, set: &Set, best: Option<&[OperatingPoint; 3]>) -> Result<SetReport> {
        let best = best.filter(|_| set.aero == AeroSet::Xu2015);
        let base = VehicleOptions { aero: set.aero, ..self.base };
        let mut report = SetReport {
            name: set.name,
            description: set.description,
            tables: Vec::new(),
            claims: Vec::new(),
            figures: Vec::new(),
            sweeps: Vec::new(),
            laws: None,
            interaction: None,
        };
        let mut points = None;
        if self.wants(&[Part::Table2, Part::Table3, Part::Interaction]) {
            errln!("{}: tables 2 and 3", set.name);
            points = Some(self::points(&self.data, &base)?);
        }
        if let Some(points) = &points {
            if self.wants(&[Part::Table2]) {
                let of = |points: &[OperatingPoint; 3]| table2(&self.published.table2, points);
                report.tables.push(beside(of(points), best.map(of)));
            }
            if self.wants(&[Part::Table3]) {
                let of = |points: &[OperatingPoint; 3]| table3(&self.published.table3, points);
                report.tables.push(beside(of(points), best.map(of)));
            }
        }
        for (parameter, part, file, title) in SWEEPS {
            let frequency = parameter == Parameter::Frequency && self.wants(&[Part::Interaction]);
            if self.wants(&[part, Part::Claims]) || frequency {
                let (from, to, steps) = parameter.range();
                errln!("{}: {parameter:?} from {from} to {to}, {} points", set.name, steps + 1);
                report.sweeps.push(Sweep::new(&self.data, &base, parameter)?);
            }
            if let (true, Some(sweep)) = (self.wants(&[part]), report.sweeps.last()) {
                let file = format!("{file}_{}", set.name);
                self.draw(&loci::Loci(sweep), loci::SIZE, &file)?;
                let title = format!("{title} ({})", set.name);
                report.figures.push(Figure { file, title, caption: caption(sweep) });
            }
        }
        if let ([fuel, damping, frequency], true) =
            (report.sweeps.as_slice(), self.wants(&[Part::Claims]))
        {
            errln!("{}: {} claims", set.name, claims::CLAIMS.len());
            let laws = Laws::new(&self.data, &base, claims::SLIGHT)?;
            report.claims = test(&Evidence { fuel, damping, frequency, laws: &laws });
            report.laws = Some(laws);
        }
        if let (Some(points), true) = (&points, self.wants(&[Part::Interaction])) {
            let sweep = report.sweeps.iter().find(|s| s.parameter == Parameter::Frequency);
            if let Some(sweep) = sweep {
                let interaction = Interaction::new(&self.data, &base, points, sweep)?;
                report.interaction = Some(interaction);
            }
        }
        Ok(report)
    }

    fn draw(&self, drawing: &impl Drawing, size: (u32, u32), file: &str) -> Result<()> {
        errln!("figure: {file}");
        self.drawn.borrow_mut().extend(files(drawing, size, &self.figures.join(file))?);
        Ok(())
    }

    fn fig3(&self) -> Result<Figure> {
        let (beam, _) = structure(&self.data, &self.base)?;
        let stiffness = shapes::Stiffness { data: &self.data.vehicle, beam: &beam };
        let file = "fig3".to_string();
        self.draw(&stiffness, shapes::STIFFNESS_SIZE, &file)?;
        Ok(Figure {
            file,
            title: "Fig. 3: bending stiffness along the vehicle".into(),
            caption:
                "The paper's figure has no numbers. This is the smoothest stiffness that gives both columns \
                 of Table 1 with ordinary tanks. Its uncertainty is a factor of 1.2 amidships \
                 and of 3.4 at the ends (erratum 16)."
                    .into(),
        })
    }

    fn fig5(&self) -> Result<Figure> {
        let options = |configuration| VehicleOptions { configuration, ..self.base };
        let (even, _) = structure(&self.data, &options(Configuration::EvenMassBeam))?;
        let (beam, oscillators) = structure(&self.data, &options(Configuration::SloshBeam))?;
        let [even, slosh] = [Modes::solve(&even, &[])?, Modes::solve(&beam, &oscillators)?];
        let drawing = shapes::Shapes {
            data: &self.data.vehicle,
            even: &even,
            slosh: &slosh,
            beam: &beam,
            oscillators: &oscillators,
        };
        let file = "fig5".to_string();
        self.draw(&drawing, shapes::SHAPES_SIZE, &file)?;
        Ok(Figure {
            file,
            title: "Fig. 5: the first three mode shapes".into(),
            caption:
                "Full tanks. Each sloshing mass is attached at the middle of its tank and hardly \
                      moves in space while the beam moves relative to it."
                    .into(),
        })
    }
}

fn points(data: &Data, base: &VehicleOptions) -> Result<[OperatingPoint; 3]> {
    let [rigid, even, slosh] = CONFIGURATIONS
        .map(|configuration| OperatingPoint::new(data, &VehicleOptions { configuration, ..*base }));
    Ok([rigid?, even?, slosh?])
}

fn beside(table: Table, best: Option<Table>) -> Table {
    match best {
        Some(best) => table.beside(best),
        None => table,
    }
}

fn caption(sweep: &Sweep) -> String {
    let held = match sweep.parameter {
        Parameter::Fuel => {
            "Sloshing frequencies follow from depth and gravity. Where those of the two tanks meet, the \
             poles veer and exchange damping; the zeros cross (enlarged in (e) and (f))."
        }
        Parameter::Damping => "Half fuel; sloshing frequencies follow from depth and gravity.",
        Parameter::Frequency => "Half fuel; both tanks at the same frequency.",
    };
    format!(
        "{held} Panels (a) to (d) show the real part over the parameter, (e) to (h) the upper half \
         of the s-plane. Open: start; filled: end. Branches are tracked by their eigenvectors; the \
         lowest modal assurance between two steps is {:.3}.",
        sweep.weakest_match
    )
}
