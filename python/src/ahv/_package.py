"""The FMUs inside the package."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import Literal

from fmpy import extract

# Filled by `cargo ahv wheel`.
FOLDER = Path(__file__).parent / "data"
MODELS = {
    "vehicle": "ahv",
    "autopilot": "ahv_autopilot",
    "actuator": "ahv_actuator",
    "sensor": "ahv_sensor",
}
ENDINGS = {"2.0": ".fmu", "3.0": "_fmi3.fmu"}
TEMPLATES = {"vehicle": "vehicle.toml", "coefficients": "parker2007.toml"}


def fmu(
    version: Literal["2.0", "3.0"] = "2.0",
    model: Literal["vehicle", "autopilot", "actuator", "sensor"] = "vehicle",
) -> Path:
    """Path of an FMU in the installed package.

    Args:
        version: of the standard, "2.0" or "3.0".
        model: the vehicle, or a part of its control loop: "autopilot", "actuator" or "sensor".

    Raises:
        ValueError: there is no FMU for this version of the standard, or of this model.
        FileNotFoundError: the package has no FMUs, because it was not installed from a wheel.
    """
    if version not in ENDINGS:
        raise ValueError(f'version is {version!r}; "2.0" or "3.0" is expected')
    if model not in MODELS:
        names = ", ".join(f'"{name}"' for name in MODELS)
        raise ValueError(f"model is {model!r}; one of {names} is expected")
    path = FOLDER / f"{MODELS[model]}{ENDINGS[version]}"
    if not path.is_file():
        raise FileNotFoundError(
            f"{path} does not exist: this copy of the package has no FMUs; install the wheel "
            "(`cargo ahv wheel`, then `pip install target/ahv-*.whl`) or pass the path of an FMU"
        )
    return path


def template(kind: Literal["vehicle", "coefficients"]) -> Path:
    """Path of a data file of the built-in vehicle, to copy and change for `ahv.vehicle`.

    Args:
        kind: "vehicle", geometry, mass, beam and tanks; or "coefficients", the published
            coefficients of eq. (4), inertia and envelope.

    Raises:
        ValueError: there is no such file.
    """
    if kind not in TEMPLATES:
        raise ValueError(f'kind is {kind!r}; "vehicle" or "coefficients" is expected')
    return FOLDER / TEMPLATES[kind]


@contextmanager
def unzipped(path: str | PathLike[str] | None) -> Iterator[Path]:
    """The folder of an FMU: `path` itself if it is one, or the FMU unzipped for the duration."""
    path = fmu() if path is None else Path(path)
    if path.is_dir():
        yield path.resolve()
        return
    with tempfile.TemporaryDirectory(prefix="ahv_") as folder:
        extract(path, unzipdir=folder)
        yield Path(folder).resolve()
