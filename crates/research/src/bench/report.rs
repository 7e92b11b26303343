//! The table of a benchmark, with machine and versions.

use super::chart;
use super::precision::Point;
use super::timing::Spread;
use ahv_tool::table::{number, row, table};
use ahv_tool::workspace::{Files, MAX_DATA_BYTES, read_text, root, shown, write_together};
use anyhow::Result;
use serde::Serialize;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    pub what: String,
    pub unit: &'static str,
    #[serde(flatten)]
    pub value: Spread,
    /// Target or comparison.
    pub note: String,
}

#[derive(Debug, Serialize)]
pub struct Report {
    /// Processor, cores and load.
    pub machine: String,
    /// Commit of the source; `+` if files have changed since.
    pub commit: String,
    /// Versions of compilers, tools and other integrators.
    pub versions: Vec<String>,
    pub lines: Vec<Line>,
    /// Skipped measurements, with reasons.
    pub left_out: Vec<String>,
    /// Error against time, for the figure.
    pub points: Vec<Point>,
}

/// First line of the output of a program; `None` if there is no such program.
pub fn says(program: impl AsRef<OsStr>, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).current_dir(root()).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    output.status.success().then(|| text.lines().next().unwrap_or_default().trim().to_string())
}

fn machine() -> String {
    let information = read_text(Path::new("/proc/cpuinfo"), MAX_DATA_BYTES).unwrap_or_default();
    let name = information.lines().find_map(|line| line.strip_prefix("model name"));
    let name =
        name.map_or(std::env::consts::ARCH, |line| line.trim_start_matches([' ', '\t', ':']));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let load = read_text(Path::new("/proc/loadavg"), MAX_DATA_BYTES).unwrap_or_default();
    let load = load.split(' ').next().unwrap_or("unknown");
    format!("{name}, {cores} cores, load {load} before the run")
}

impl Report {
    pub fn new() -> Result<Self> {
        let commit = says("git", &["describe", "--always", "--dirty=+"]);
        let versions = [
            says("rustc", &["--version"]),
            says("cc", &["--version"]),
            says("valgrind", &["--version"]),
        ];
        Ok(Self {
            machine: machine(),
            commit: commit.unwrap_or_else(|| "unknown".into()),
            versions: versions.into_iter().flatten().collect(),
            lines: Vec::new(),
            left_out: Vec::new(),
            points: Vec::new(),
        })
    }

    /// Adds a line; values in `unit`.
    pub fn line(
        &mut self,
        what: impl Into<String>,
        value: Spread,
        unit: &'static str,
        note: impl Into<String>,
    ) {
        let line = Line { what: what.into(), unit, value, note: note.into() };
        errln!("  {}: {} {} {}", line.what, number(value.median), unit, line.note);
        self.lines.push(line);
    }

    /// Adds the version printed by a program, once.
    pub fn version(&mut self, program: impl AsRef<OsStr>, arguments: &[&str]) {
        let version = says(program, arguments).filter(|version| !self.versions.contains(version));
        self.versions.extend(version);
    }

    /// Adds the versions of packages in a Python environment.
    pub fn python_versions(&mut self, python: &Path, packages: &[&str]) {
        let code = format!(
            "from importlib.metadata import version as v; \
             print('; '.join(p + ' ' + v(p) for p in {packages:?}))"
        );
        self.version(python, &["-c", &code]);
    }

    pub fn left_out(&mut self, what: &str, why: &anyhow::Error) {
        let text = format!("{what}: {why:#}");
        errln!("  skipped: {text}");
        self.left_out.push(text);
    }

    /// Prints the table; writes bench.json and, with points, precision.svg and .png.
    pub fn finish(&self, directory: &Path) -> Result<()> {
        let json = serde_json::to_vec_pretty(self)?;
        let mut files = Files::from([(directory.join("bench.json"), json)]);
        if !self.points.is_empty() {
            files.extend(chart::files(&self.points, directory)?);
        }
        write_together(&files)?;
        outln!("{}\ncommit {}; {}\n", self.machine, self.commit, self.versions.join("; "))?;
        let mut rows = vec![row(["", "median", "min", "max", "unit", "note"])];
        for Line { what, unit, value, note } in &self.lines {
            let mut cells = vec![what.clone(), number(value.median)];
            let varies = value.least != value.largest;
            cells.extend([value.least, value.largest].map(|v| match varies {
                true => number(v),
                false => String::new(),
            }));
            cells.extend([(*unit).to_string(), note.clone()]);
            rows.push(cells);
        }
        out!("{}", table(&rows))?;
        for text in &self.left_out {
            outln!("  skipped: {text}")?;
        }
        outln!("")?;
        for file in files.keys() {
            outln!("{}", shown(file))?;
        }
        Ok(())
    }
}
