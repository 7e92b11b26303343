"""What goes wrong is refused with a reason: nothing traps, nothing leaks."""

from __future__ import annotations

import pytest
from wasmtime import WasmtimeError

from flying import reason, same_steps
from harness import Package
from harness import Refused as NativeRefused
from host import TIME, Host, Refused

# In the bytes of a state: the instance's state in the order of calls, and the checksum.
PHASE, CHECKSUM = 32, 8
MEMORY_BYTES = 4_000_000


def test_verif_wasm_refuses_an_impossible_trim_as_the_library_does(
    package: Package, host: Host
) -> None:
    """Initialisation fails with the same reason; a reset makes the instance new."""
    wasm = host.instantiate("co-simulation")
    with pytest.raises(Refused) as refused:
        wasm.initialise(mach0=6.0, altitude0=42000.0)
    with package.instance() as native, pytest.raises(NativeRefused) as natively:
        native.initialise(mach0=6.0, altitude0=42000.0)
    assert refused.value.status == "error"
    assert reason(refused.value.text) == reason(natively.value.text)
    wasm.call("reset")
    wasm.initialise()
    with package.flight() as native:
        same_steps(native, wasm, range(10))


# Calls in step mode: an error ends the run (section 2.3.1 of FMI 3.0), a discarded value does not.
BAD_CALLS = {
    "not a number": ("set-float64", ([0], [float("nan")]), "discard", "delta_e = NaN is refused"),
    "too late": ("set-int64", ("aero", [2]), "error", "aero = 2 is refused: a fixed parameter"),
    "no such variable": ("get-float64", ([9999],), "error", "9999 is unknown"),
    "another type": ("get-boolean", ([0],), "error", "delta_e .* is no Boolean"),
    "an absent type": (
        "get-string",
        ([0],),
        "error",
        "delta_e .* is no String, its type is Float64",
    ),
    "too few values": ("set-float64", ([0, 1], [0.0]), "error", "so 2 values are needed"),
    "too few seeds": ("get-directional-derivative", ([2], [0], []), "error", "nSeed = 0"),
    "time that is set": ("set-float64", ([TIME], [1.0]), "error", "time can only be read"),
    "out of order": ("exit-initialization-mode", (), "error", "not allowed in state"),
    "a mode it has not": ("enter-event-mode", (), "error", "not allowed in state"),
    "a step back": ("do-step", (-1.0, 0.1, True), "error", "currentCommunicationPoint = -1 s"),
    "no step": ("do-step", (0.0, 0.0, True), "error", "communicationStepSize = 0 is refused"),
    "a category": ("set-debug-logging", (True, ["x"]), "error", 'category "x" is unknown'),
    "bytes": ("set-fmu-state", (b"123",), "error", "these 3 bytes are no FMU state"),
    "dependencies": ("get-variable-dependencies", (0,), "error", "of single elements"),
    "a clock": ("get-interval-decimal", ([0],), "error", "not allowed in state"),
}


@pytest.mark.parametrize("bad", BAD_CALLS)
def test_verif_bad_calls_are_refused_with_a_reason(package: Package, host: Host, bad: str) -> None:
    """The state stays as it was; another instance is not disturbed."""
    name, arguments, status, text = BAD_CALLS[bad]
    arguments = [package.references(x) if x == "aero" else x for x in arguments]
    wasm, other = host.flight(), host.flight()
    before = wasm.call("get-fmu-state")
    with pytest.raises(Refused, match=text) as refused:
        wasm.call(name, *arguments)
    assert refused.value.status == status and len(host.log) == 1
    after = wasm.call("get-fmu-state")
    assert after[PHASE + 1 : -CHECKSUM] == before[PHASE + 1 : -CHECKSUM]
    if status == "error":
        with pytest.raises(Refused, match="not allowed in state"):
            wasm.step(0.001)
        wasm.call("reset")
        wasm.initialise()
    for flight in (wasm, other):
        with package.flight() as native:
            same_steps(native, flight, range(5))


@pytest.mark.parametrize("value", [0, 4, -1, 2**32 + 1, -(2**63)])
def test_verif_no_number_is_taken_for_another_item(host: Host, value: int) -> None:
    """Enumerations have 64 bits, of which none is lost."""
    wasm = host.instantiate("co-simulation")
    with pytest.raises(Refused, match="aero = ") as refused:
        wasm.set(aero=value)
    assert refused.value.status == "discard"
    assert wasm.call("get-int64", wasm.host.package.references("aero")) == [1]


def test_verif_no_instance_without_name_or_with_another_token(host: Host) -> None:
    """Nor for a mode that the FMU does not have; the host is told why."""
    for arguments, text in (
        (("co-simulation", "", None), "name"),
        (("co-simulation", "ahv", "{0}"), "instantiationToken"),
        (("model-exchange", "ahv", "{0}"), "instantiationToken"),
        (("co-simulation", "ahv", None, True, False, []), "hasEventMode"),
    ):
        assert host.instantiate(*arguments) is None
        assert text in host.log[-1].text and host.log[-1].status == "error"


def test_verif_instances_are_freed(host: Host) -> None:
    """In a memory that holds a hundred instances there can be as many as one likes, one by one."""
    host.store.set_limits(memory_size=MEMORY_BYTES)
    for _ in range(400):
        host.flight().close()
    with pytest.raises(WasmtimeError):
        kept = [host.flight() for _ in range(400)]
        assert not kept


def test_verif_messages_are_read_by_no_printf(host: Host) -> None:
    """A name or a category with a per cent sign arrives as it is."""
    wasm = host.instantiate("co-simulation", "100 %d")
    with pytest.raises(Refused, match='category "50 %s" is unknown'):
        wasm.call("set-debug-logging", True, ["50 %s"])
    assert host.log[-1].instance == "100 %d"
