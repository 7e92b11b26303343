"""The FMU for FMI 3.0 is the one for FMI 2.0 in other words: the same variables, the same bits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy.fmi3 import FMU3Slave

from fmi3 import TIME, Package3, packaged3
from harness import (
    ACTIVE_STATES,
    AERO_SETS,
    ALL_DERIVATIVES,
    ALL_STATES,
    CONFIGURATIONS,
    DISCARD,
    ERROR,
    EVERYTHING,
    INPUTS,
    OK,
    Package,
)

STEP, STEPS = 0.01, 60
# Kinds of variables, in FMI 2.0 and in FMI 3.0.
TYPES = {"Real": "Float64", "Integer": "Int32"}
COMMON = (
    *("canGetAndSetFMUState", "canSerializeFMUState"),
    *("providesDirectionalDerivatives", "providesAdjointDerivatives"),
)
LOOK = (
    *("providesIntermediateUpdate", "canReturnEarlyAfterIntermediateUpdate"),
    "mightReturnEarlyFromDoStep",
)
# Inputs that move: their slopes differ by rounding.
ROUNDING = 1e-11


@pytest.fixture(scope="module")
def package3(tmp_path_factory: pytest.TempPathFactory) -> Package3:
    """The FMU for FMI 3.0, unzipped once."""
    return packaged3(tmp_path_factory.mktemp("ahv 3 with space"))


def moved(step: int) -> dict[str, float]:
    """Something on all inputs in every step, without a pattern."""
    one, two, three = 1.7 * step**1.3, 2.3 * step**1.2, 1.9 * step**1.1
    values = (0.01 * np.sin(one), 0.1 * np.cos(two), 20 * np.sin(three), 20 * np.cos(one))
    return dict(zip(INPUTS, map(float, values), strict=True))


def test_verif_capabilities_are_those_that_are_promised(package3: Package3) -> None:
    """Both interfaces, states, derivatives, a look within a step; no events."""
    root = ElementTree.parse(package3.folder / "modelDescription.xml").getroot()
    assert root.get("fmiVersion") == "3.0"
    slave, model = root.find("CoSimulation").attrib, root.find("ModelExchange").attrib
    for interface in (slave, model):
        assert interface["modelIdentifier"] == "ahv"
        for capability in COMMON:
            assert interface[capability] == "true", capability
    for capability in LOOK:
        assert slave[capability] == "true", capability
    assert slave["canHandleVariableCommunicationStepSize"] == "true"
    assert slave["maxOutputDerivativeOrder"] == "1" and slave["hasEventMode"] == "false"
    assert model["needsCompletedIntegratorStep"] == "true"


def test_verif_both_descriptions_have_the_same_variables(
    package: Package, package3: Package3
) -> None:
    """Names, references, causality, units, starts and ranges; FMI 3.0 also has the time."""
    assert package.description.guid == package3.description.guid
    (time,) = set(package3.variables) - set(package.variables)
    assert time == "time" and package3.variables[time].valueReference == TIME
    assert package3.variables[time].causality == "independent"
    for name, two in package.variables.items():
        three = package3.variables[name]
        assert three.type == TYPES.get(two.type, two.type), name
        for key in ("valueReference", "description", "causality", "variability", "initial"):
            assert getattr(two, key) == getattr(three, key), (name, key)
        for key in ("unit", "displayUnit", "start", "min", "max", "nominal"):
            assert getattr(two, key) == getattr(three, key), (name, key)
        if two.declaredType and two.declaredType.items:
            items = [
                [(item.name, item.value) for item in variable.declaredType.items]
                for variable in (two, three)
            ]
            assert items[0] == items[1]
        if two.derivative:
            assert two.derivative.name == three.derivative.name


@pytest.mark.parametrize("part", ["outputs", "derivatives", "initialUnknowns"])
def test_verif_both_descriptions_have_the_same_structure(
    package: Package, package3: Package3, part: str
) -> None:
    """Unknowns in the same order, with the same dependencies of the same kinds."""

    def told(description) -> list:
        return [
            (
                unknown.variable.name,
                [known.name for known in unknown.dependencies],
                unknown.dependenciesKind,
            )
            for unknown in getattr(description, part)
        ]

    assert told(package.description) == told(package3.description)


def test_verif_start_values_of_description_and_binary_agree(package3: Package3) -> None:
    """Before and in initialization mode; outputs have values only in the latter."""
    with package3.slave() as slave:
        for entered in (False, True):
            if entered:
                slave.fmu.enterInitializationMode()
            for name, variable in package3.variables.items():
                if variable.start is None:
                    continue
                text = variable.start
                value = text == "true" if variable.type == "Boolean" else float(text)
                assert slave[name] == value, name
        assert slave["V"] > 0.0


@pytest.mark.parametrize("aero", AERO_SETS)
@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_co_simulation_has_the_bits_of_fmi2(
    package: Package, package3: Package3, configuration: int, aero: str
) -> None:
    """All variables in a flight in which everything moves, with time told by the FMU."""
    with (
        package.flight(configuration=configuration, aero=aero) as two,
        package3.slave() as three,
    ):
        three.initialise(configuration=configuration, aero=aero)
        for step in range(STEPS):
            two.set(**moved(step))
            three.set(**moved(step))
            assert (two.get(*EVERYTHING) == three.get(*EVERYTHING)).all(), step
            answer = three.fmu.doStep(two.time, STEP)
            two.step(STEP)
            assert answer == (False, False, False, two.time)
            assert three["time"] == two.time
        assert (two.get(*EVERYTHING) == three.get(*EVERYTHING)).all()


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_model_exchange_has_the_bits_of_fmi2(
    package: Package, package3: Package3, configuration: int
) -> None:
    """FMPy's integrator flies both alike."""
    flights = [
        fmpy.simulate_fmu(
            str(which.path),
            fmi_type="ModelExchange",
            stop_time=1.0,
            output_interval=STEP,
            start_values={"configuration": configuration, "delta_e": 0.01},
            output=[*ALL_STATES, "n_z"],
        )
        for which in (package, package3)
    ]
    assert len(flights[0]) == len(flights[1]) >= 100
    for name in flights[0].dtype.names:
        assert (flights[0][name] == flights[1][name]).all(), name


def test_verif_adjoint_derivatives_are_the_transposed_directional_ones(package3: Package3) -> None:
    """The Jacobian by columns and by rows, of all rates and outputs by all states and inputs."""
    knowns = package3.references(*ALL_STATES, *INPUTS)
    unknowns = package3.references(*ALL_DERIVATIVES, "n_z", "moment", "V")
    with package3.slave().initialise(fuel_burn=True) as slave:

        def adjoint(unknowns: list[int], seed: Sequence[float]) -> list[float]:
            return slave.fmu.getAdjointDerivative(unknowns, knowns, seed, len(knowns))

        columns = [slave.fmu.getDirectionalDerivative(unknowns, [x], [1.0]) for x in knowns]
        rows = [adjoint([y], [1.0]) for y in unknowns]
        assert np.array_equal(np.array(columns).T, np.array(rows))
        weights = np.linspace(-1.0, 2.0, len(unknowns))
        expected = weights @ np.array(rows)
        assert np.allclose(
            adjoint(unknowns, weights), expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max()
        )


def test_verif_states_go_from_one_standard_to_the_other(
    package: Package, package3: Package3
) -> None:
    """The bytes of a flight continue it under the other standard, bit for bit."""
    with package.flight() as two, package3.slave() as three:
        for step in range(10):
            two.set(**moved(step))
            two.step(STEP)
        time, state = two.time, two.fmu.getFMUstate()
        saved = two.fmu.serializeFMUstate(state)
        three.fmu.setFMUState(three.fmu.deserializeFMUState(saved))
        assert (two.get(*EVERYTHING) == three.get(*EVERYTHING)).all()
        two.step(STEP)
        three.fmu.doStep(time, STEP)
        assert (two.get(*EVERYTHING) == three.get(*EVERYTHING)).all()
        two.fmu.freeFMUstate(state)


def test_verif_a_look_within_a_step_changes_nothing(package3: Package3) -> None:
    """Instants ascend, values lie on the flight in short steps, and the end has its bits."""
    seen: list[tuple[float, float]] = []
    output = package3.references("V")

    def look(_env, time, asked, allowed, finished, _early, _requested, _when) -> None:
        assert asked and allowed and finished
        seen.append((time, looked.fmu.getFloat64(output)[0]))

    options = {"intermediateUpdate": look, "requiredIntermediateVariables": output}
    with package3.slave(**options) as looked, package3.slave() as plain, package3.slave() as fine:
        for slave in (looked, plain, fine):
            slave.initialise(delta_e=0.005)
        for step in range(4):
            looked.fmu.doStep(step * 0.25, 0.25)
            plain.fmu.doStep(step * 0.25, 0.25)
            assert (looked.get(*EVERYTHING) == plain.get(*EVERYTHING)).all()
        times = [time for time, _ in seen]
        assert times == sorted(times) and times[-1] == 1.0 and len(times) > 8
        for time, speed in seen:
            fine.fmu.doStep(fine["time"], time - fine["time"])
            assert speed == pytest.approx(fine["V"], rel=1e-9)


@pytest.mark.parametrize("asked", [0.0, 0.11, 7.0])
def test_verif_a_master_can_have_the_step_end_early(package3: Package3, asked: float) -> None:
    """Where it asks to, or at once if that is past; never beyond the step."""
    reached: list[float] = []

    def look(_env, time, _asked, _allowed, _finished, early, requested, when) -> None:
        reached.append(time)
        requested[0], when[0] = early and len(reached) == 1, asked

    options = {"intermediateUpdate": look, "earlyReturnAllowed": True}
    with package3.slave(**options).initialise(delta_e=0.02) as slave:
        event, end, early, time = slave.fmu.doStep(0.0, 0.25)
        assert not event and not end and time == slave["time"]
        assert reached[0] < 0.11
        assert time == min(max(asked, reached[0]), 0.25) and early == (time < 0.25)
        assert slave.fmu.doStep(time, 0.25)[3] == time + 0.25


def test_verif_inputs_move_within_a_step_as_by_derivatives_of_fmi2(
    package: Package, package3: Package3
) -> None:
    """The FMU asks where the inputs will be; between, they are linear."""
    slopes = {"delta_e": 0.05, "phi": -0.2, "w_gust": 100.0}
    references = package3.references(*slopes)

    def move(_env, time, asked, _allowed, finished, _early, _requested, _when) -> None:
        if asked and not finished:
            three.fmu.setFloat64(references, [slope * time for slope in slopes.values()])

    options = {"intermediateUpdate": move, "requiredIntermediateVariables": references}
    with package.flight() as two, package3.slave(**options) as three:
        three.initialise()
        for _ in range(20):
            time = two.time
            two.set(**{name: slope * time for name, slope in slopes.items()})
            two.fmu.setRealInputDerivatives(references, [1] * len(slopes), list(slopes.values()))
            two.step(STEP)
            three.fmu.doStep(time, STEP)
        ours, theirs = three.get(*EVERYTHING), two.get(*EVERYTHING)
        assert np.allclose(ours, theirs, rtol=ROUNDING, atol=1e-12)
        assert three["delta_e"] == pytest.approx(0.05 * 20 * STEP)


def test_verif_inputs_stop_where_a_step_returned_early(package3: Package3) -> None:
    """The next step holds them, unless the master says where they go on to."""
    reference = package3.references("delta_e")

    def move(_env, time, asked, _allowed, finished, early, requested, when) -> None:
        if first and asked and not finished:
            slave.fmu.setFloat64(reference, [0.01])
        requested[0], when[0] = first and finished and early, time

    options = {"intermediateUpdate": move, "requiredIntermediateVariables": reference}
    with package3.slave(earlyReturnAllowed=True, **options).initialise() as slave:
        first = True
        _, _, early, time = slave.fmu.doStep(0.0, 0.5)
        reached = slave["delta_e"]
        assert early and 0.0 < reached < 0.01
        assert reached == pytest.approx(0.01 * time / 0.5)
        first = False
        slave.fmu.doStep(time, 0.5)
        assert slave["delta_e"] == reached


def test_verif_a_flight_out_of_the_envelope_asks_to_be_terminated(package3: Package3) -> None:
    """The step succeeds as far as it went, says why, and the next one is refused."""
    for allowed in (True, False):
        with package3.slave(earlyReturnAllowed=allowed).initialise(delta_e=0.15) as slave:
            time, end = 0.0, False
            while not end:
                start, (_, end, early, time) = time, slave.fmu.doStep(time, 0.1)
            assert start < time < start + 0.1 and early == allowed
            assert (
                slave.log[-1].status == DISCARD and "edge of its valid range" in slave.log[-1].text
            )
            assert slave["time"] == time and np.isfinite(slave.get(*EVERYTHING)).all()
            assert slave.status("doStep", time, 0.1) == ERROR
            assert "terminateSimulation" in slave.log[-1].text


REFUSED: list[tuple[str, Callable, int, str]] = [
    ("not a number", lambda s: s.status("setFloat64", [0], [np.nan]), DISCARD, "finite number"),
    ("out of range", lambda s: s.status("setFloat64", [9999], [0.0]), ERROR, "is unknown"),
    ("an output", lambda s: s.status("setFloat64", [2], [0.0]), ERROR, "only inputs"),
    ("wrong type", lambda s: s.status("getInt32", [0]), ERROR, "is no Int32"),
    ("too late", lambda s: s.status("setFloat64", s.package.references("mach0"), [9.0]), ERROR, ""),
    ("no clocks", lambda s: s.status("getClock", [0]), ERROR, "allowed in: event mode"),
    ("no events", lambda s: s.status("enterEventMode"), ERROR, "continuous-time mode"),
    ("a step back", lambda s: s.status("doStep", -1.0, 0.1), ERROR, "do not continue"),
    ("no step", lambda s: s.status("doStep", 0.0, 0.0), ERROR, "positive number"),
]


@pytest.mark.parametrize(
    ("call", "status", "text"), [row[1:] for row in REFUSED], ids=[row[0] for row in REFUSED]
)
def test_verif_refusals_say_why_and_an_error_ends_the_run(
    package3: Package3, call: Callable, status: int, text: str
) -> None:
    """Discarded values change nothing; after an error there is only the reset."""
    with package3.slave().initialise() as slave:
        before = slave.get(*EVERYTHING)
        assert call(slave) == status
        assert slave.log[-1].status == status and text in slave.log[-1].text
        assert (slave.get(*EVERYTHING) == before).all()
        assert slave.status("doStep", 0.0, STEP) == (OK if status == DISCARD else ERROR)
        slave.fmu.reset()
        slave.initialise()
        assert slave.status("doStep", 0.0, STEP) == OK


def test_verif_a_wrong_token_or_event_mode_is_not_instantiated(package3: Package3) -> None:
    """FMPy gets NULL; the log says what does not fit."""
    heard: list[str] = []

    def hear(_env, _status, _category, text: bytes) -> None:
        heard.append(text.decode())

    for token, options, text in (
        ("{0}", {}, "instantiationToken is {0}"),
        (None, {"eventModeUsed": True}, "hasEventMode = false"),
        (None, {"requiredIntermediateVariables": [TIME]}, "has no intermediateUpdate"),
    ):
        slave = FMU3Slave(
            guid=token or package3.description.guid,
            unzipDirectory=str(package3.folder),
            modelIdentifier="ahv",
            instanceName="ahv",
        )
        with pytest.raises(Exception, match="Failed to instantiate"):
            slave.instantiate(logMessage=hear, **options)
        assert text in heard[-1]


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_states_of_missing_parts_stay_zero(package3: Package3, configuration: int) -> None:
    """The parts that a configuration lacks are zero under this standard too."""
    with package3.model() as model:
        model.initialise(configuration=configuration)
        rates = np.array(model.get(*ALL_DERIVATIVES[ACTIVE_STATES[configuration] : -1]))
        assert not rates.any()
