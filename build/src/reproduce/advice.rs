//! The text about the interaction, from the computed numbers.

use super::interaction::Interaction;
use super::veering::Veering;

pub fn structure(_: &[Veering]) -> String {
    String::new()
}

pub fn coupling(_: &Interaction) -> String {
    String::new()
}

pub fn designer(_: &Interaction, _: &[Veering]) -> String {
    String::new()
}
