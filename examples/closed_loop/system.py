"""The closed loop as one file: FMUs connected by a system structure, SSP 1.0 or 2.0.

Gains are in the autopilot's FMU. In SSP 2.0 the manoeuvre is in autopilot.ssv and the vehicle's
case in vehicle.ssv.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Mapping
from math import isfinite
from pathlib import Path
from typing import NamedTuple

import numpy as np
from fmpy import read_model_description
from fmpy.model_description import ModelVariable
from pythonfmu.builder import FmuBuilder

from law import Law

HERE = Path(__file__).resolve().parent
SSP = "http://ssp-standard.org/SSP1/SystemStructure"
MEASURED, WANTED, COMMANDS = ("V", "gamma", "q"), ("V_change", "gamma_wanted"), ("delta_e", "phi")
# Connections from outputs to inputs; a sensor or an actuator of the signal's name stands between.
LOOP = [
    *[("vehicle", name, "autopilot", name) for name in MEASURED],
    *[("autopilot", name, "vehicle", name) for name in COMMANDS],
]
FROM_MANOEUVRE = [("manoeuvre", name, "autopilot", name) for name in WANTED]
# Further outputs to record.
RECORDED = [
    *[("vehicle", name) for name in ("h", "alpha", "eta1", "slosh1", "slosh2", "n_z")],
    *[("vehicle", name) for name in ("delta_e_effective", "phi_effective", "choking_margin")],
    *[("autopilot", name) for name in ("missed", "saturated")],
]
HEADER = '<?xml version="1.0" encoding="UTF-8"?>\n'
# In files of SSP 1.0 parameter sets stand within the structure: Ecos reads no others, and applies
# those of one name.
INLINE, SET = "1.0", "initial"
# Breakpoints of the native autopilot.
BREAKPOINTS = 8
NONE: Mapping[str, float] = {}


class BadSystem(Exception):
    """The system has no such variable, or the manoeuvre is invalid."""


class Component(NamedTuple):
    """An FMU and its parameters."""

    name: str
    fmu: Path
    parameters: Mapping[str, float] = NONE


def check_manoeuvre(path: Path) -> np.ndarray:
    """Rows of a manoeuvre, whose columns are those wanted, and whose times increase."""
    columns = ",".join(["time_s", *WANTED])
    with path.open(encoding="utf-8") as lines:
        if lines.readline().strip() != columns:
            raise BadSystem(f"{path}: the first line must be {columns}")
    rows = np.atleast_1d(np.genfromtxt(path, delimiter=",", names=True))
    times = rows["time_s"]
    if not times.size or (np.diff(times) <= 0.0).any():
        raise BadSystem(f"{path}: time_s must increase from row to row")
    return rows


def commands(manoeuvre: Path) -> dict[str, float]:
    """The manoeuvre of a CSV file as parameters of the native autopilot; or BadSystem."""
    rows = check_manoeuvre(manoeuvre)
    if len(rows) > BREAKPOINTS:
        raise BadSystem(f"{manoeuvre}: {len(rows)} rows; the autopilot holds {BREAKPOINTS}")
    return {
        f"command{i}_{name}": float(value)
        for i, row in enumerate(rows, start=1)
        for name, value in zip(("time", "V_change", "gamma"), row, strict=True)
    }


def native(
    vehicle: Path,
    autopilot: Path,
    manoeuvre: Path | None = None,
    case: Mapping[str, float] = NONE,
    between: Iterable[Component] = (),
    level: Mapping[str, float] = NONE,
) -> list[Component]:
    """The loop of the FMUs ahv and ahv_autopilot; or BadSystem.

    Without a manoeuvre in level flight; `case`: parameters of the vehicle; `between`: actuators and
    sensors; `level`: parameters of the autopilot for level flight of this case.
    """
    given = commands(manoeuvre) if manoeuvre else {}
    return [
        Component("autopilot", autopilot, {**given, **level}),
        *between,
        Component("vehicle", vehicle, case),
    ]


def foreign(
    vehicle: Path,
    law: Law,
    manoeuvre: Path,
    folder: Path,
    case: Mapping[str, float] = NONE,
    between: Iterable[Component] = (),
) -> list[Component]:
    """The loop with an autopilot and a manoeuvre in Python, whose FMUs are built in `folder`."""
    check_manoeuvre(manoeuvre)
    law.save(folder / "law.json")
    (folder / "manoeuvre.csv").write_text(manoeuvre.read_text(encoding="utf-8"), "utf-8")
    files = {
        "manoeuvre": [folder / "manoeuvre.csv"],
        "autopilot": [HERE / "law.py", folder / "law.json"],
    }
    parts = [
        Component(name, FmuBuilder.build_FMU(HERE / f"{name}.py", folder / f"{name}.fmu", own))
        for name, own in files.items()
    ]
    return [*parts, *between, Component("vehicle", vehicle, case)]


def build(path: Path, components: list[Component], stop_s: float, version: str = "2.0") -> Path:
    """Write the .ssp file of this version of the standard; or BadSystem."""
    connections = connected(components)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        described = []
        for component in components:
            variables = read(component.fmu)
            if "Real" not in {variable.type for variable in variables.values()}:
                raise BadSystem(f"{component.fmu} is of FMI 3.0: give FMUs of FMI 2.0")
            connectors = kinds(component.name, connections)
            for name, kind in connectors.items():
                if name not in variables or variables[name].causality != kind:
                    raise BadSystem(f"{component.fmu}: there is no {kind} {name}")
            archive.write(component.fmu, f"resources/{component.name}.fmu")
            values = parameter_set(component, variables, version) if component.parameters else ""
            if values and version != INLINE:
                archive.writestr(f"resources/{component.name}.ssv", HEADER + values)
            described.append(element(component, connectors, values if version == INLINE else ""))
        archive.writestr(
            "SystemStructure.ssd", structure("".join(described), connections, stop_s, version)
        )
    return path


def connected(components: list[Component]) -> list[tuple[str, str, str, str]]:
    """Connections of a loop of these components."""
    names, found = {component.name for component in components}, []
    for source, signal, target, into in LOOP + FROM_MANOEUVRE:
        for part in names & {f"{signal}_sensor", f"{signal}_actuator"}:
            found.append((source, signal, part, "u"))
            source, signal = part, "y"
        if source in names:
            found.append((source, signal, target, into))
    return found


def read(fmu: Path) -> dict[str, ModelVariable]:
    """Variables of an FMU by name; or BadSystem."""
    try:
        return {v.name: v for v in read_model_description(str(fmu)).modelVariables}
    except (zipfile.BadZipFile, KeyError) as failure:
        raise BadSystem(f"{fmu} is no FMU: {failure}") from failure


def kinds(component: str, connections: list[tuple[str, str, str, str]]) -> dict[str, str]:
    """Kind of every connector of a component, by name."""
    found = {}
    for source, output, target, into in connections:
        found |= {output: "output"} if source == component else {}
        found |= {into: "input"} if target == component else {}
    return found | {name: "output" for owner, name in RECORDED if owner == component}


def element(component: Component, connectors: dict[str, str], values: str) -> str:
    """A component of SystemStructure.ssd, with its parameter set or a reference to it."""
    inner = "".join(
        f'<ssd:Connector name="{name}" kind="{kind}"><ssc:Real/></ssd:Connector>\n'
        for name, kind in connectors.items()
    )
    if values:
        binding = (
            f"<ssd:ParameterBinding>\n<ssd:ParameterValues>\n{values}</ssd:ParameterValues>\n"
            "</ssd:ParameterBinding>\n"
        )
    else:
        binding = (
            '<ssd:ParameterBinding type="application/x-ssp-parameter-set" '
            f'source="resources/{component.name}.ssv"/>\n'
        )
    bindings = f"<ssd:ParameterBindings>\n{binding}</ssd:ParameterBindings>\n"
    bindings = bindings if component.parameters else ""
    return (
        f'<ssd:Component name="{component.name}" type="application/x-fmu-sharedlibrary" '
        f'source="resources/{component.name}.fmu">\n<ssd:Connectors>\n{inner}</ssd:Connectors>\n'
        f"{bindings}</ssd:Component>\n"
    )


def parameter_set(component: Component, variables: dict[str, ModelVariable], version: str) -> str:
    """The parameter set of a component."""
    rows = []
    for name, value in component.parameters.items():
        if name not in variables or variables[name].causality != "parameter":
            raise BadSystem(f"{component.fmu}: there is no parameter {name}")
        kind = variables[name].type
        if kind not in ("Real", "Integer"):
            # libcosim and Ecos set no enumerations, and FMPy takes every Boolean for true.
            raise BadSystem(f"{name} is not real: masters do not set it alike")
        if not isfinite(value):
            raise BadSystem(f"{name} = {value} is refused: a number is expected")
        text = f'<ssv:{kind} value="{value!r}"/>'
        rows.append(f'<ssv:Parameter name="{name}">{text}</ssv:Parameter>\n')
    return (
        f'<ssv:ParameterSet version="{version}" name="{SET}"\n'
        f'    xmlns:ssv="{SSP}ParameterValues" xmlns:ssc="{SSP}Common">\n'
        f"<ssv:Parameters>\n{''.join(rows)}</ssv:Parameters>\n</ssv:ParameterSet>\n"
    )


def structure(
    elements: str, connections: list[tuple[str, str, str, str]], stop_s: float, version: str
) -> str:
    """SystemStructure.ssd."""
    lines = "".join(
        f'<ssd:Connection startElement="{a}" startConnector="{x}" '
        f'endElement="{b}" endConnector="{y}"/>\n'
        for a, x, b, y in connections
    )
    return f"""{HEADER}<ssd:SystemStructureDescription version="{version}" name="closed_loop"
    xmlns:ssd="{SSP}Description"
    xmlns:ssc="{SSP}Common">
<ssd:System name="closed_loop">
<ssd:Elements>
{elements}</ssd:Elements>
<ssd:Connections>
{lines}</ssd:Connections>
</ssd:System>
<ssd:DefaultExperiment startTime="0" stopTime="{stop_s}"/>
</ssd:SystemStructureDescription>
"""
