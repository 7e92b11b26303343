//! The flight as an FMU: the only place where flight and FMI meet.

mod ignored;
mod message;

pub use message::Message;

use crate::data::{DATA_FILES, Data, OwnFiles};
use crate::flight::{
    BeyondLimit, DEFAULT_TOLERANCE, Flight, INPUT_ORDER, Sample, Setup, Snapshot, TOLERANCES,
};
use crate::short::short;
use crate::variables::TABLE;
use crate::vehicle::ALPHA;
use fmi_model::identity::{fnv, hash_of_table};
use fmi_model::instance::LARGEST;
use fmi_model::{
    About, Exchange, InputDerivatives, InternalStep, Model, Resources, Saving, Simulation, Tangent,
    Variable,
};

impl Model for Setup {
    type Simulation = Flight;
    type Error = Message;

    const ABOUT: About = About {
        identifier: "ahv",
        description: "Longitudinal flight of a flexible air-breathing hypersonic vehicle with sloshing propellant",
        author: "The ahv authors",
        version: env!("CARGO_PKG_VERSION"),
        license: env!("CARGO_PKG_LICENSE"),
        tool: concat!("cargo ahv ", env!("CARGO_PKG_VERSION")),
        events: "The initial state that was found, parameters without effect, the first input beyond its limit",
        // The time span that the open-loop instability leaves.
        stop_s: 2.0,
        // Half of the longest step at which explicit Euler lets no flexible mode grow, whatever the
        // configuration and coefficient set: masters take it as their integrator's step.
        step_s: 2e-4,
    };
    const VARIABLES: &'static [Variable<Self>] = &TABLE;
    const IDENTITY: u128 = {
        let mut hash = hash_of_table(&Self::ABOUT, Self::VARIABLES);
        let mut file = 0;
        while file < DATA_FILES.len() {
            hash = fnv(hash, DATA_FILES[file].packed);
            file += 1;
        }
        hash
    };
    const RESOURCES: Resources<Self> =
        Resources::Identified(|folder| Ok(Self::of(Data::with(&OwnFiles::in_folder(folder)?)?)));
    const DEFAULT_TOLERANCE: f64 = DEFAULT_TOLERANCE;
    const TOLERANCES: [f64; 2] = TOLERANCES;

    fn new() -> Result<Self, Message> {
        Ok(Self::new()?)
    }

    fn identity(&self) -> u128 {
        match self.data().own_files.as_slice() {
            [] => Self::IDENTITY,
            _ => {
                let table = hash_of_table(&Self::ABOUT, Self::VARIABLES);
                self.data().packed().into_iter().fold(table, fnv)
            }
        }
    }

    fn description(&self) -> String {
        let description = Self::ABOUT.description;
        match self.data().own_files.as_slice() {
            [] => description.to_string(),
            files => format!("{description}; data: {}", files.join(", ")),
        }
    }

    fn start(&self, time_s: f64, tolerance: f64) -> Result<Flight, Message> {
        Ok(self.start(time_s, tolerance)?)
    }

    fn started(&self, default: &Self, flight: &Flight, say: &mut dyn FnMut(String)) {
        let (alpha, [delta_e, phi]) = (flight.states()[ALPHA], flight.trim().control);
        say(format!("start with alpha = {alpha} rad, delta_e = {delta_e} rad, phi = {phi}"));
        for (name, why) in ignored::ignored(&self.parameters) {
            let Some(variable) = fmi_model::table::find::<Self>(name) else { continue };
            let (now, before) = (variable.start(self), variable.start(default));
            if let (Some(now), true) = (now, now != before) {
                say(format!("{name} = {} has no effect: {why}", short(now)));
            }
        }
    }
}

impl Simulation for Flight {
    type Sample = Sample;
    type Error = Message;

    const EXCHANGE: Option<Exchange<Self>> = Some(Exchange {
        set_time: Self::set_time,
        set_states: |flight, states| {
            if let Ok(state) = states.try_into() {
                flight.set_state(state);
            }
        },
        completed_step: |flight| Ok(flight.check()?),
    });
    const INPUT_DERIVATIVES: Option<InputDerivatives<Self>> = Some(InputDerivatives {
        highest: INPUT_ORDER,
        set: Self::set_input_derivative,
        first: |flight| &flight.inputs().derivatives[0],
    });
    const TANGENT: Option<Tangent<Self>> =
        Some(|flight, states, inputs| match (states.try_into(), inputs.try_into()) {
            (Ok(states), Ok(inputs)) => Ok(flight.tangent(states, inputs)?),
            _ => unreachable!("the table has as many states and inputs as the flight"),
        });
    const INTERNAL_STEP: Option<InternalStep<Self>> =
        Some(|flight, end| Ok(flight.advance_once(end)?));
    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: Snapshot::NUMBERS,
        save: |flight, numbers| numbers.extend(flight.snapshot().numbers()),
        check: |numbers| {
            Snapshot::from_numbers(numbers).is_some_and(|snapshot| possible(&snapshot))
        },
        load: |flight, numbers| {
            if let Some(snapshot) = Snapshot::from_numbers(numbers) {
                flight.rewind(&snapshot);
            }
        },
    });

    fn time(&self) -> f64 {
        self.time()
    }

    fn inputs(&self) -> &[f64] {
        &self.inputs().values
    }

    fn set_input(&mut self, number: usize, value: f64) {
        self.set_input(number, value);
    }

    fn states(&self) -> &[f64] {
        self.state()
    }

    fn evaluate(&mut self) -> Result<&Sample, Message> {
        Ok(self.evaluate()?)
    }

    fn derivatives(sample: &Sample) -> &[f64] {
        &sample.derivatives
    }

    fn advance(&mut self, end_s: f64) -> Result<(), Message> {
        Ok(self.advance(end_s)?)
    }

    fn advise(&mut self, say: &mut dyn FnMut(String)) {
        /// The controls' names, their unit, and what may have been mistaken.
        const CONTROLS: [(&str, &str, &str); crate::vehicle::CONTROLS] =
            [("delta_e", " rad", "; inputs are in rad, not in degrees"), ("phi", "", "")];
        for BeyondLimit { control, asked, limit } in self.newly_beyond_limits() {
            let (name, unit, mistake) = CONTROLS[control];
            let [asked, limit] = [asked, limit].map(short);
            say(format!(
                "{name} asks for {asked}{unit} in all and gets {limit}{unit}, its limit (said once)\
                 {mistake}"
            ));
        }
    }
}

/// Whether a flight can have this snapshot; inputs may have left the range in which they can be set.
fn possible(snapshot: &Snapshot) -> bool {
    let Snapshot { inputs, state, time, integrator } = snapshot;
    let [least, largest] = TOLERANCES;
    // Behind the step that they were for, derivatives are what it made of them.
    let fastest = if inputs.ahead { LARGEST } else { f64::MAX };
    time.is_finite()
        && (least..=largest).contains(&integrator.tolerance)
        && integrator.proposal > 0.0
        && integrator.proposal.is_finite()
        && state.iter().chain(&inputs.values).all(|value| value.is_finite())
        && inputs.derivatives.iter().flatten().all(|rate| rate.abs() <= fastest)
}

fmi_model::export!(Setup);
