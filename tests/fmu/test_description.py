"""The description of the FMU says what the contract says, and what the binary does."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import pytest

from contract import COMPLETE, CONTRACT, ENUMERATIONS, EXPERIMENT, START, UNITS, Entry
from harness import ALL_DERIVATIVES, ALL_STATES, EVERYTHING, INPUTS, Package


def limits(variable) -> tuple[float, float]:
    """Smallest and largest value, of the variable or else of its type."""

    def pick(key: str, otherwise: float) -> float:
        sources = (variable, variable.declaredType)
        found = [getattr(source, key) for source in sources if getattr(source, key, None)]
        return float(found[0]) if found else otherwise

    return pick("min", -math.inf), pick("max", math.inf)


def test_verif_identity_and_capabilities(package: Package) -> None:
    """Names and capabilities are those that are promised."""
    description = package.description
    assert description.fmiVersion == "2.0"
    assert description.modelName == "ahv"
    assert description.variableNamingConvention == "flat"
    slave = description.coSimulation
    assert slave.modelIdentifier == "ahv"
    assert slave.canHandleVariableCommunicationStepSize
    assert slave.canGetAndSetFMUstate and slave.canSerializeFMUstate
    assert not slave.needsExecutionTool
    assert not slave.canBeInstantiatedOnlyOncePerProcess
    experiment = description.defaultExperiment
    assert {key: float(getattr(experiment, key)) for key in EXPERIMENT} == EXPERIMENT


@pytest.mark.parametrize("entry", CONTRACT, ids=lambda entry: entry.name)
def test_verif_variable_is_as_promised(package: Package, entry: Entry) -> None:
    """Causality, variability, type, unit and display unit of one variable."""
    variable = package.variables[entry.name]
    kind = variable.declaredType
    unit = variable.unit or (kind.unit if kind else None)
    display = variable.displayUnit or (kind.displayUnit if kind else None)
    found = (variable.causality, variable.variability, variable.type, unit, display)
    assert found == entry[1:]
    assert variable.description


def test_verif_contract_is_complete(package: Package) -> None:
    """No variable is missing from the contract, and the tests know all states."""
    assert set(package.variables) == {entry.name for entry in CONTRACT}
    derivatives = package.description.derivatives
    assert tuple(unknown.variable.name for unknown in derivatives) == ALL_DERIVATIVES
    assert tuple(unknown.variable.derivative.name for unknown in derivatives) == ALL_STATES
    assert set(EVERYTHING) <= set(package.variables)


def test_verif_value_references_are_distinct_rows(package: Package) -> None:
    """The value reference is the row of the table."""
    references = [variable.valueReference for variable in package.description.modelVariables]
    assert references == list(range(len(references)))


@pytest.mark.parametrize("name", ENUMERATIONS)
def test_verif_enumeration_numbers(package: Package, name: str) -> None:
    """A name has its number, and no other name is offered."""
    items = package.variables[name].declaredType.items
    offered = {item.name: int(item.value) for item in items}
    assert offered.items() <= ENUMERATIONS[name].items()
    assert name not in COMPLETE or offered == ENUMERATIONS[name]
    assert all(item.description for item in items)


def test_verif_units_are_defined_in_base_units(package: Package) -> None:
    """Every unit has its dimension, and degrees are shown by the right factor."""
    seen = set()
    for unit in package.description.unitDefinitions:
        base = unit.baseUnit
        exponents = tuple(int(getattr(base, key) or 0) for key in ("kg", "m", "s", "rad"))
        assert exponents == UNITS[unit.name], unit.name
        assert float(base.factor or 1.0) == 1.0 and float(base.offset or 0.0) == 0.0
        assert not any(getattr(base, key) for key in ("A", "K", "mol", "cd"))
        for shown in unit.displayUnits:
            assert shown.name in ("deg", "deg/s")
            assert float(shown.factor) == math.degrees(1.0)
            assert float(shown.offset or 0.0) == 0.0
        seen.add(unit.name)
    assert seen == {entry.unit for entry in CONTRACT if entry.unit}


def test_verif_start_values_of_description_and_binary_agree(package: Package) -> None:
    """Every start value is within its range and is bit for bit what the binary starts with."""
    with package.instance() as instance:
        instance.setup()
        for name, variable in package.variables.items():
            needed = variable.causality in ("parameter", "input")
            assert (variable.start is not None) or not needed, name
            if variable.start is None:
                continue
            start = variable.start
            value = start == "true" if variable.type == "Boolean" else float(start)
            assert instance[name] == value, name
            lowest, highest = limits(variable)
            assert lowest <= value <= highest, name


def test_verif_start_values_are_those_promised(package: Package) -> None:
    """The defaults of the contract, in the binary."""
    with package.instance() as instance:
        instance.setup()
        assert {name: instance[name] for name in START} == START
        offered = {int(item.value) for item in package.variables["aero"].declaredType.items}
        assert instance["aero"] == min(offered)


def test_verif_states_have_positive_nominals(package: Package) -> None:
    """Masters scale their tolerances by the nominal values."""
    assert all(float(package.variables[name].nominal) > 0.0 for name in ALL_STATES)


def test_verif_dependencies_are_ordered_and_complete(package: Package) -> None:
    """Indices ascend, name inputs or states only, and each has a kind."""
    root = ElementTree.parse(package.folder / "modelDescription.xml").getroot()
    names = [variable.get("name") for variable in root.find("ModelVariables")]
    known = {*ALL_STATES, *INPUTS}
    structure = root.find("ModelStructure")
    for part in ("Outputs", "Derivatives"):
        for unknown in structure.find(part):
            indices = [int(index) for index in unknown.get("dependencies", "").split()]
            assert "dependencies" in unknown.attrib
            assert indices == sorted(set(indices))
            assert {names[index - 1] for index in indices} <= known
            assert len(unknown.get("dependenciesKind", "").split()) == len(indices)
        listed = [int(unknown.get("index")) for unknown in structure.find(part)]
        assert listed == sorted(listed)
