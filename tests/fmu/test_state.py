"""Same bits after a reset, a state round trip, in another process, instance or thread."""

from __future__ import annotations

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from ctypes import byref, create_string_buffer
from pathlib import Path
from typing import Any

import pytest
from fmpy.fmi2 import fmi2FMUstate

from contract import FACTORS, OFFSETS
from harness import CONFIGURATIONS, ERROR, Instance, Package

HERE = Path(__file__).parent
# Other values for uncertainty parameters and sensor stations.
UNCERTAIN = {
    **{f"{name}_factor": 1.0 + 0.003 * (k + 1) for k, name in enumerate(FACTORS)},
    **{"pitch_rate_factor": 0.7, "mass_centre_shift": 0.05},
    **{f"{name}_offset": 1e-3 * (k + 1) for k, name in enumerate(OFFSETS)},
    **{"imu_station": 12.5, "probe_station": 0.4},
}
# Offset of the model's hash in the bytes of a state, and length of their checksum.
MODEL_HASH, CHECKSUM = 16, 8


def fly(flight: Instance, steps: int = 20) -> bytes:
    """A manoeuvre; the bits of everything at its end."""
    for k in range(steps):
        flight.set(delta_e=0.001 * (k % 3))
        flight.step(0.01)
    return flight.bits()


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_reset_repeats_the_flight(package: Package, configuration: int) -> None:
    """The second run after a reset is the first one, bit for bit."""
    with package.flight(configuration=configuration, fuel_fraction=0.5) as flight:
        first = fly(flight)
        flight.call("fmi2Reset")
        flight.initialise(configuration=configuration, fuel_fraction=0.5)
        assert fly(flight) == first


def test_verif_reset_restores_every_default(package: Package) -> None:
    """Parameters, inputs, tolerance: a reset instance equals a new one."""
    changed: dict[str, Any] = {
        **{"configuration": 1, "fuel_fraction": 0.3, "slosh_damping": 0.2, "slosh_frequency": 9.0},
        **{"mach0": 9.0, "altitude0": 27000.0, "gamma0": 0.01, "input_mode": 2, "trim": False},
        **{"alpha0": 0.02, "q0": 0.01, "eta10": 0.1, "eta20": 0.1, "eta30": 0.1},
        **{"delta_e": 0.2, "phi": 0.3, "w_gust": 3.0, "u_gust": -4.0},
        **UNCERTAIN,
    }
    with package.instance() as used, package.instance() as fresh:
        used.initialise(tolerance=1e-3, start=5.0, **changed)
        used.step(0.1)
        used.call("fmi2Reset")
        used.initialise()
        fresh.initialise()
        assert all(used[name] == fresh[name] for name in changed)
        assert used.bits() == fresh.bits()
        assert fly(used) == fly(fresh)


@pytest.mark.parametrize("configuration", CONFIGURATIONS)
def test_verif_state_round_trip(package: Package, configuration: int) -> None:
    """A flight continued from a kept state is the same flight; so is one from its bytes."""
    with package.flight(configuration=configuration) as flight:
        fly(flight, 10)
        flight.set(phi=0.01)
        state, time, here = flight.fmu.getFMUstate(), flight.time, flight.bits()
        data = flight.fmu.serializeFMUstate(state)
        end = fly(flight)
        assert end != here
        flight.fmu.setFMUstate(state)
        flight.time = time
        assert flight.bits() == here
        assert fly(flight) == end
        flight.fmu.freeFMUstate(state)
        assert not state.value
        again = flight.fmu.deSerializeFMUstate(data)
        flight.fmu.setFMUstate(again)
        flight.time = time
        assert flight.bits() == here
        assert flight.fmu.serializeFMUstate(again) == data
        assert fly(flight) == end
        flight.fmu.freeFMUstate(again)


def test_verif_state_moves_to_another_instance(package: Package) -> None:
    """The state has the parameters in it: an instance of other parameters continues the flight."""
    with package.flight(fuel_fraction=0.4) as one, package.flight(configuration=1) as other:
        fly(one, 7)
        state = one.fmu.getFMUstate()
        end = fly(one)
        other.fmu.setFMUstate(state)
        other.time = 0.07
        assert fly(other) == end
        one.fmu.freeFMUstate(state)


def test_verif_state_moves_to_another_process(package: Package, tmp_path: Path) -> None:
    """Another process restores the bytes in a fresh instance and flies the same bits."""
    given = {"fuel_fraction": 0.4, "slosh_frequency": 12.0, "w_gust": 2.0, "u_gust": -3.0}
    with package.flight(**given, **UNCERTAIN) as flight:
        fly(flight, 7)
        file = tmp_path / "state"
        file.write_bytes(flight.fmu.serializeFMUstate(flight.fmu.getFMUstate()))
        arguments = [str(package.folder), str(file), repr(flight.time), "20"]
        end = fly(flight)
    script = [sys.executable, str(HERE / "restore.py"), *arguments]
    run = subprocess.run(script, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip() == end.hex()


def test_verif_garbage_is_no_state(package: Package) -> None:
    """Truncated, extended and changed bytes are refused, and the flight goes on unharmed."""
    with package.flight() as flight:
        good = flight.fmu.serializeFMUstate(flight.fmu.getFMUstate())
    flipped = [good[:k] + bytes([good[k] ^ 1]) + good[k + 1 :] for k in range(0, len(good), 7)]
    for bad in (b"", b"x" * len(good), good[:-1], good + b"\0", good[: len(good) // 2], *flipped):
        with package.flight() as flight:
            before = flight.bits()
            state = fmi2FMUstate()
            buffer = create_string_buffer(bad, size=max(1, len(bad)))
            arguments = (buffer, len(bad), byref(state))
            assert flight.status("fmi2DeSerializeFMUstate", *arguments) == ERROR
            assert flight.log[-1].text and not state.value
            assert flight.bits() == before


def sealed(body: bytes) -> bytes:
    """The bytes with a checksum that fits: 64-bit FNV-1a."""
    total = 0xCBF29CE484222325
    for byte in body:
        total = (total ^ byte) * 0x100000001B3 % 2**64
    return body + total.to_bytes(CHECKSUM, "little")


def test_verif_a_state_of_another_model_is_refused(package: Package) -> None:
    """Bytes that are whole, but of a model with another hash; the flight goes on unharmed."""
    with package.flight(**UNCERTAIN) as flight:
        fly(flight, 5)
        good = flight.fmu.serializeFMUstate(flight.fmu.getFMUstate())
        assert sealed(good[:-CHECKSUM]) == good
        other = bytearray(good[:-CHECKSUM])
        other[MODEL_HASH + 3] ^= 0x10
        bad, before, state = sealed(bytes(other)), flight.bits(), fmi2FMUstate()
        buffer = create_string_buffer(bad, size=len(bad))
        arguments = (buffer, len(bad), byref(state))
        assert flight.status("fmi2DeSerializeFMUstate", *arguments) == ERROR
        assert "another model" in flight.log[-1].text and not state.value
        assert flight.bits() == before
        flight.fmu.setFMUstate(flight.fmu.deSerializeFMUstate(good))
        assert flight.bits() == before
        assert {name: flight[name] for name in UNCERTAIN} == UNCERTAIN


def test_verif_interleaved_instances_do_not_meet(package: Package) -> None:
    """Two flights, step by step in turn, are the flights that each alone would be."""
    given = ({"configuration": 3}, {"configuration": 2, "fuel_fraction": 0.5})
    alone = []
    for start in given:
        with package.flight(**start) as flight:
            alone.append(fly(flight))
    with package.flight(**given[0]) as one, package.flight(**given[1]) as two:
        for k in range(20):
            for flight in (one, two):
                flight.set(delta_e=0.001 * (k % 3))
                flight.step(0.01)
        assert [one.bits(), two.bits()] == alone


def test_verif_threads_do_not_meet(package: Package) -> None:
    """Flights in eight threads at once equal the flights one after the other."""

    def run(number: int) -> bytes:
        start = {"configuration": CONFIGURATIONS[number % 3], "fuel_fraction": 0.1 * (number % 7)}
        with package.flight(**start) as flight:
            return fly(flight)

    serial = [run(number) for number in range(16)]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(run, range(16))) == serial
