//! Beam, liquid and modes.

mod beam;
mod damping;
mod modes;
mod nearly;
mod reference;
mod tanks;
mod uniform_beam;
