//! The WebAssembly component of the FMU, by the draft of the layered standard FMI-LS-WASM.

use super::library::{Flags, Product, compile, remap};
use super::platform::Platform;
use super::toolchain::{Toolchain, output_of};
use crate::workspace::{cargo, root, shown};
use anyhow::{Context, Result, bail};
use fmi_model::standard::Standard;
use std::path::Path;
use std::process::Stdio;

/// The draft names the platform after a system that the component does not need: its core is compiled
/// for none.
const WASM: Platform = Platform {
    fmi2: "wasm32-wasip2",
    fmi3: "wasm32-wasip2",
    ending: "wasm",
    os: "unknown",
    arch: "wasm32",
    triple: "wasm32-unknown-unknown",
};

/// Linker for Debian's compiler, from LLVM; those of rustup have their own.
const LINKER: &str = "wasm-ld";

/// Folder of the layered standard in an FMU.
const EXTRA: &str = "extra/org.modelica.fmi-ls-wasm";

const MANIFEST: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmi-ls:fmiLayeredStandardManifest xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"
    fmi-ls:fmi-ls-name="org.modelica.fmi-ls-wasm"
    fmi-ls:fmi-ls-version="0.1.0"
    fmi-ls:fmi-ls-description="FMI Layered Standard for WebAssembly"/>
"#;

/// Name of a model's component in an archive of FMI 3.0.
pub fn name(identifier: &str) -> String {
    WASM.binary(Standard::Fmi3, identifier)
}

/// Builds a model's component, or says what is missing for it.
pub fn component(identifier: &str) -> Result<Vec<u8>> {
    let toolchain = Toolchain::new(WASM)?;
    let mut command = toolchain.cargo();
    command.args(["--target", WASM.triple]);
    // Every runtime that has components has these instructions.
    let mut flags = Flags { all: vec!["-Ctarget-feature=+simd128".into()], ..Flags::default() };
    if let Some(sources) = &toolchain.std {
        if output_of(Path::new(LINKER), &["--version"]).is_none() {
            bail!("the linker {LINKER} is missing; on Debian: apt-get install lld");
        }
        command.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", LINKER);
        flags.all.push(remap(sources, "rust"));
    }
    let directory = toolchain.directory();
    let product = Product { package: "ahv-wasm", is_example: true, name: identifier };
    wrap(&compile(command, &product, WASM, directory, flags)?)
}

/// Wraps a core module into a component.
fn wrap(module: &Path) -> Result<Vec<u8>> {
    let mut wrap = cargo();
    wrap.args([
        "run",
        "--quiet",
        "--profile",
        "tool",
        "--package",
        "ahv-wasm-wrap",
        "--manifest-path",
    ])
    .arg(root().join("Cargo.toml"))
    .arg("--")
    .arg(module)
    .stderr(Stdio::inherit());
    let output = wrap.output().context("cannot start cargo")?;
    if !output.status.success() {
        bail!("{} cannot be made a component: see the messages above", shown(module));
    }
    Ok(output.stdout)
}

/// Manifests of the layered standard, by name: the FMI standard and the draft want different names.
pub fn manifests() -> [(String, Vec<u8>); 2] {
    ["fmi-ls-manifest.xml", "manifest.xml"]
        .map(|name| (format!("{EXTRA}/{name}"), MANIFEST.as_bytes().to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manifest_has_the_name_of_its_folder_in_the_namespace_of_the_standard() {
        let folder = EXTRA.strip_prefix("extra/").unwrap();
        let [standard, draft] = manifests();
        assert_eq!(standard.0, format!("extra/{folder}/fmi-ls-manifest.xml"));
        assert_eq!(draft.0, format!("extra/{folder}/manifest.xml"));
        assert_eq!(standard.1, draft.1);
        let mut reader = quick_xml::Reader::from_str(MANIFEST);
        let root = loop {
            if let quick_xml::events::Event::Empty(root) = reader.read_event().unwrap() {
                break root;
            }
        };
        assert_eq!(root.name().as_ref(), "fmi-ls:fmiLayeredStandardManifest");
        let value = |name: &str| root.try_get_attribute(name).unwrap().unwrap().value.into_owned();
        assert_eq!(value("xmlns:fmi-ls"), "http://fmi-standard.org/fmi-ls-manifest");
        assert_eq!(value("fmi-ls:fmi-ls-name"), folder);
        for name in ["fmi-ls:fmi-ls-version", "fmi-ls:fmi-ls-description"] {
            assert!(!value(name).is_empty());
        }
    }
}
