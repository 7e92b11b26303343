//! What works and is probably not meant: said in the log, and nowhere else.

use crate::fmi::instance::Instance;
use crate::fmi::sys::Status;
use crate::short::short;
use crate::variables;
use crate::vehicle;

/// The controls' names, their unit, and what may have been mistaken.
const CONTROLS: [(&str, &str, &str); vehicle::CONTROLS] =
    [("delta_e", " rad", "; inputs are in rad, not in degrees"), ("phi", "", "")];

impl Instance {
    /// Says which parameters were changed in vain.
    pub(super) fn say_ignored(&mut self) {
        for (name, why) in self.flight.parameters().ignored() {
            let value = |flight| variables::find(name).map(|variable| variable.get(flight));
            let (now, before) = (value(&self.flight), value(&self.pristine));
            if let (Some(now), true) = (now, now != before) {
                self.log.push(Status::Ok, || {
                    let now = short(now);
                    format!("fmi2ExitInitializationMode: {name} = {now} has no effect: {why}")
                });
            }
        }
    }

    /// Says, once for each, that an input asks for more than its actuator can do: in `call`, if the
    /// master listens.
    pub(super) fn say_limits(&mut self, call: &str) {
        if !self.log.wants(Status::Ok) {
            return;
        }
        for (control, (name, unit, mistake)) in CONTROLS.into_iter().enumerate() {
            let beyond = self.flight.beyond_limits(control);
            let (false, Some((asked, [min, max]))) = (self.limit_said[control], beyond) else {
                continue;
            };
            let [asked, limit] = [asked, asked.clamp(min, max)].map(short);
            self.limit_said[control] = true;
            self.log.push(Status::Ok, || {
                format!(
                    "{call}: {name} asks for {asked}{unit} in all and gets {limit}{unit}, its limit \
                     (said once){mistake}"
                )
            });
        }
    }
}
