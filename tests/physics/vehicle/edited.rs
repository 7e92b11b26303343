//! Data files whose text is changed before it is read.

use ahv::data::{
    AeroData, AeroSet, Data, DataFile, EARTH, EarthData, PARKER2007, SHOCK_EXPANSION, VEHICLE,
    VehicleData, XU2015,
};

/// The texts of all files.
#[derive(Clone)]
pub struct Texts {
    pub vehicle: String,
    pub earth: String,
    /// In the order of the sets.
    pub sets: [String; 3],
}

pub const SETS: [AeroSet; 3] = [AeroSet::Xu2015, AeroSet::Parker2007, AeroSet::ShockExpansion];

impl Texts {
    pub fn new() -> Self {
        Self {
            vehicle: VEHICLE.text.into(),
            earth: EARTH.text.into(),
            sets: [XU2015, PARKER2007, SHOCK_EXPANSION].map(|set| set.text.into()),
        }
    }

    pub fn data(&self) -> Data {
        let [xu2015, parker2007, shock_expansion] = [0, 1, 2]
            .map(|set| AeroData::parse("set.toml", &self.sets[set]).expect("a coefficient set"))
            .map(Box::new);
        Data {
            vehicle: VehicleData::parse("vehicle.toml", &self.vehicle).expect("a vehicle").into(),
            earth: EarthData::parse("earth.toml", &self.earth).expect("an earth").into(),
            xu2015,
            parker2007,
            shock_expansion,
            ..Data::embedded().expect("the embedded data are valid")
        }
    }
}

/// Writes another number, or others in a list, in place of those of a key; whether the key is there.
pub fn edit(text: &mut String, table: &str, key: &str, change: &dyn Fn(f64) -> f64) -> bool {
    let mut inside = false;
    let mut found = false;
    let lines = text.lines().map(|line| {
        if line.starts_with('[') {
            inside = line == format!("[{table}]");
        }
        let rest = line.strip_prefix(key).and_then(|rest| rest.strip_prefix(" = { value = "));
        let (true, Some(rest)) = (inside, rest) else { return line.to_string() };
        found = true;
        let (numbers, rest) = rest.split_once(", unit").expect("a number with a unit");
        let list = numbers.starts_with('[');
        let changed: Vec<String> = numbers
            .trim_matches(['[', ']'])
            .split(", ")
            .map(|number| format!("{:?}", change(number.parse().expect("a number"))))
            .collect();
        let changed = changed.join(", ");
        let changed = if list { format!("[{changed}]") } else { changed };
        format!("{key} = {{ value = {changed}, unit{rest}")
    });
    let edited = lines.collect::<Vec<_>>().join("\n");
    *text = edited;
    found
}

/// Adds a key to a table.
pub fn add(text: &mut String, table: &str, line: &str) {
    let head = format!("[{table}]\n");
    assert!(text.contains(&head), "no table {table}");
    *text = text.replacen(&head, &format!("{head}{line}\n"), 1);
}
