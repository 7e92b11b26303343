"""The closed loop as one file: three FMUs connected by a system structure (SSP 1.0)."""

from __future__ import annotations

import tempfile
import zipfile
from pathlib import Path

import numpy as np
from fmpy import read_model_description
from fmpy.ssp.ssd import SystemStructureDescription, get_connections, read_ssd
from pythonfmu.builder import FmuBuilder

from law import Law

HERE = Path(__file__).resolve().parent
# Connections from outputs to inputs.
CONNECTIONS = [
    ("manoeuvre", "V_change", "autopilot", "V_change"),
    ("manoeuvre", "gamma_wanted", "autopilot", "gamma_wanted"),
    ("vehicle", "V", "autopilot", "V"),
    ("vehicle", "gamma", "autopilot", "gamma"),
    ("vehicle", "q", "autopilot", "q"),
    ("autopilot", "delta_e", "vehicle", "delta_e"),
    ("autopilot", "phi", "vehicle", "phi"),
]
# Further outputs to record.
RECORDED = [
    *[("vehicle", name) for name in ("h", "alpha", "eta1", "slosh1", "slosh2", "n_z")],
    *[("vehicle", name) for name in ("delta_e_effective", "phi_effective", "choking_margin")],
    *[("autopilot", name) for name in ("missed", "saturated")],
]


class BadSystem(Exception):
    """The system structure names a missing connector, or the manoeuvre is invalid."""


def connectors() -> dict[str, dict[str, str]]:
    """Kind of every connector, by component and name."""
    found: dict[str, dict[str, str]] = {"manoeuvre": {}, "autopilot": {}, "vehicle": {}}
    for source, output, target, into in CONNECTIONS:
        found[source][output] = "output"
        found[target][into] = "input"
    for component, name in RECORDED:
        found[component][name] = "output"
    return found


def description(period_s: float, stop_s: float) -> str:
    """SystemStructure.ssd."""
    components = "".join(
        f'<ssd:Component name="{component}" type="application/x-fmu-sharedlibrary" '
        f'source="resources/{component}.fmu"><ssd:Connectors>'
        + "".join(
            f'<ssd:Connector name="{name}" kind="{kind}"><ssc:Real/></ssd:Connector>'
            for name, kind in names.items()
        )
        + "</ssd:Connectors></ssd:Component>\n"
        for component, names in connectors().items()
    )
    connections = "".join(
        f'<ssd:Connection startElement="{a}" startConnector="{x}" '
        f'endElement="{b}" endConnector="{y}"/>\n'
        for a, x, b, y in CONNECTIONS
    )
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="1.0" name="closed_loop"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
<ssd:System name="closed_loop">
<ssd:Elements>
{components}</ssd:Elements>
<ssd:Connections>
{connections}</ssd:Connections>
</ssd:System>
<ssd:DefaultExperiment startTime="0" stopTime="{stop_s}"/>
</ssd:SystemStructureDescription>
"""


def check_manoeuvre(path: Path) -> None:
    """Check that the columns are those of the component, and that times increase."""
    columns = ",".join(["time_s", *connectors()["manoeuvre"]])
    with path.open(encoding="utf-8") as lines:
        if lines.readline().strip() != columns:
            raise BadSystem(f"{path}: the first line must be {columns}")
    times = np.atleast_1d(np.genfromtxt(path, delimiter=",", names=True)["time_s"])
    if not times.size or (np.diff(times) <= 0.0).any():
        raise BadSystem(f"{path}: time_s must increase from row to row")


def build(path: Path, vehicle: Path, law: Law, manoeuvre: Path, stop_s: float) -> Path:
    """Build the FMUs of autopilot and manoeuvre and write the .ssp file; or BadSystem."""
    check_manoeuvre(manoeuvre)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        law.save(folder / "law.json")
        (folder / "manoeuvre.csv").write_text(manoeuvre.read_text(encoding="utf-8"), "utf-8")
        parts = {"autopilot": [HERE / "law.py", folder / "law.json"]}
        parts["manoeuvre"] = [folder / "manoeuvre.csv"]
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("SystemStructure.ssd", description(law.period_s, stop_s))
            for component, files in parts.items():
                fmu = FmuBuilder.build_FMU(
                    HERE / f"{component}.py", folder / f"{component}.fmu", files
                )
                archive.write(fmu, f"resources/{component}.fmu")
            archive.write(vehicle, "resources/vehicle.fmu")
    validate(path)
    return path


def validate(path: Path) -> SystemStructureDescription:
    """Check the file against the schema and every connector against its FMU."""
    structure = read_ssd(str(path), validate=True)
    with tempfile.TemporaryDirectory() as name, zipfile.ZipFile(path) as archive:
        for component in structure.system.elements:
            if component.source not in archive.namelist():
                raise BadSystem(f"{path.name}: {component.source} is missing")
            fmu = archive.extract(component.source, name)
            variables = {v.name: v for v in read_model_description(fmu).modelVariables}
            for connector in component.connectors:
                variable = variables.get(connector.name)
                if variable is None or variable.causality != connector.kind:
                    raise BadSystem(
                        f"{path.name}: {component.name} has no {connector.kind} {connector.name}"
                    )
    if len(get_connections(structure.system)) != len(structure.system.connections):
        raise BadSystem(f"{path.name}: a connection leads nowhere")
    return structure
