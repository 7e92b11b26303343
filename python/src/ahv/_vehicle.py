"""The FMU of the user's own vehicle, made of the built-in one without a compiler."""

from __future__ import annotations

import os
import re
import tempfile
import zipfile
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from xml.sax.saxutils import escape

from ahv._instance import FMUError, Instance
from ahv._package import fmu as packaged
from ahv._text import plain

DESCRIPTION = "modelDescription.xml"
VEHICLE, COEFFICIENTS = "resources/vehicle.toml", "resources/aero.toml"
# What the package says of the built-in vehicle alone: its page, and its reference flight.
REFERENCE = "extra/org.fmi-standard.fmi-ls-ref/"
# A WebAssembly component reads no files.
COMPONENT = ("binaries/wasm32-wasip2/", "extra/org.modelica.fmi-ls-wasm/")
BUILT_IN = ("documentation/index.html", "documentation/cross-check/", REFERENCE, *COMPONENT)
# Files that an instance needs.
NEEDED = (DESCRIPTION, "binaries/", "resources/")
NO_TOKEN = "{00000000-0000-0000-0000-000000000000}"
TOKEN = re.compile(r"belong to (\{[0-9a-f-]{36}\})")
# Before the reason why the data are refused.
RESOURCES = re.compile(r"^(\w+: )?\w+ is \S+, not that of the built-in data, \S+, and ")
# The item that the user's coefficients add to the enumeration of `aero`.
OWN = (
    '<Item name="own" value="4" '
    'description="Coefficients of the user, in the resources of this FMU"/>'
)
# A variable with a start value: up to the value; name; the value.
START = re.compile(
    r'(name="([^"]+)" valueReference="\d+"(?:(?!valueReference=).)*? start=")([^"]*)', re.DOTALL
)


class VehicleError(ValueError):
    """The data of a vehicle are refused; the text names file, key, value and limit."""


def vehicle(
    toml: str | PathLike[str] | None,
    coefficients: str | PathLike[str] | None = None,
    output: str | PathLike[str] | None = None,
    *,
    fmu: str | PathLike[str] | None = None,
) -> Path:
    """The FMU of your own vehicle, as `cargo ahv package --vehicle` makes it, without a compiler.

    It has its own GUID, names your files in its description, and starts with your values. Your
    coefficients become the set `own`, the default of `aero`. The page and the reference flight of
    the built-in vehicle are left out.

    Args:
        toml: geometry, mass, beam and tanks, a file like `template("vehicle")`; or None.
        coefficients: coefficients of eq. (4), inertia and envelope, a file like
            `template("coefficients")`; or None.
        output: FMU to write; by default the name of `toml` (or of `coefficients`) with `.fmu`, or
            `_fmi3.fmu` in FMI 3.0, in the present folder. It is replaced when all has succeeded.
        fmu: FMU to make it of, such as `ahv.fmu("3.0")`; by default `ahv.fmu()`.

    Returns:
        The path of the FMU written. The same files give the same bytes.

    Raises:
        VehicleError: the data are refused, or have no trim in the default flight condition.
        ValueError: neither file is given.
        FMUError: the FMU has no library for this machine.
        OSError: a file cannot be read or written.
    """
    given = {VEHICLE: toml, COEFFICIENTS: coefficients}
    sources = {name: Path(file) for name, file in given.items() if file is not None}
    if not sources:
        raise ValueError("a vehicle or coefficients of your own are needed")
    base = packaged() if fmu is None else Path(fmu)
    files = _files(base)
    if any(name in files for name in given):
        raise VehicleError(f"{base} has data of its own; the built-in vehicle's FMU is needed")
    files |= {name: source.read_bytes() for name, source in sources.items()}
    description = files[DESCRIPTION].decode()
    token, starts = _examined(files, sources)
    files[DESCRIPTION] = _described(description, token, starts, sources).encode()
    if output is None:
        is_fmi3 = 'fmiVersion="3' in description
        stem = next(iter(sources.values())).stem
        output = f"{stem}{'_fmi3' if is_fmi3 else ''}.fmu"
    return _write(Path(output), files)


def _files(base: Path) -> dict[str, bytes]:
    """Files of the FMU that any vehicle has."""
    with zipfile.ZipFile(base) as archive:
        names = [name for name in archive.namelist() if not name.endswith("/")]
        return {name: archive.read(name) for name in names if not name.startswith(BUILT_IN)}


def _examined(
    files: Mapping[str, bytes], sources: Mapping[str, Path]
) -> tuple[str, dict[str, str]]:
    """The data's GUID and start values, of the FMU itself."""
    with tempfile.TemporaryDirectory(prefix="ahv_") as directory:
        folder = Path(directory).resolve()
        for name, content in files.items():
            if name.startswith(NEEDED):
                file = folder / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
        token = _token(folder, sources)
        with Instance(folder, token) as instance:
            try:
                instance.initialise()
            except FMUError as error:
                raise VehicleError(str(error)) from error
            parameters = [v.name for v in instance.variables.values() if v.causality == "parameter"]
            return token, {name: _start(instance, name) for name in parameters}


def _token(folder: Path, sources: Mapping[str, Path]) -> str:
    """The GUID of the data in the folder, which the FMU tells if it is given another."""
    try:
        with Instance(folder, NO_TOKEN):
            pass
    except FMUError as error:
        text = str(error)
        if found := TOKEN.search(text):
            return found[1]
        if not RESOURCES.match(text):
            raise
        problem = RESOURCES.sub("", text)
        # The user's files have other names there.
        for name, source in sources.items():
            head = re.match(rf"(.*[/\\])?{Path(name).name}(?=[: ])", problem)
            problem = f"{source}{problem[head.end() :]}" if head else problem
        raise VehicleError(problem) from error
    raise FMUError("the FMU accepts any GUID: it is not that of this package")


def _start(instance: Instance, name: str) -> str:
    value = instance.value(name)
    kind = instance.variables[name].type
    if kind == "Boolean":
        return str(bool(value)).lower()
    return plain(float(value)) if kind in ("Real", "Float64") else str(value)


def _described(
    text: str, token: str, starts: Mapping[str, str], sources: Mapping[str, Path]
) -> str:
    """The model description with what depends on the data; all else stays as it is."""
    root = re.compile(r'(<fmiModelDescription [^>]*(?:guid|instantiationToken)=")[^"]*')
    text = root.sub(lambda head: head[1] + token, text, count=1)
    quotes = {'"': "&quot;", "'": "&apos;"}
    names = escape(", ".join(source.name for source in sources.values()), quotes)
    described = re.compile(r'(<fmiModelDescription [^>]* description="[^"]*)')
    text = described.sub(lambda head: f"{head[1]}; data: {names}", text, count=1)
    text = START.sub(lambda start: start[1] + starts.get(start[2], start[3]), text)
    if COEFFICIENTS in sources:
        items = re.compile(r'( name="Aero">.*?)(\n *)(<Item [^>]*/>)(?!\n *<Item)', re.DOTALL)
        text = items.sub(lambda list_: f"{list_[0]}{list_[2]}{OWN}", text, count=1)
    return text


def _write(output: Path, files: Mapping[str, bytes]) -> Path:
    """Write the FMU beside its place, then put it there."""
    part = output.with_name(f".{output.name}.{os.getpid()}")
    try:
        with zipfile.ZipFile(part, "x") as archive:
            for name in sorted(files):
                # The date of the built-in package's files, on every machine.
                entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
                entry.compress_type = zipfile.ZIP_DEFLATED
                entry.create_system = 3
                mode = 0o100755 if name.startswith("binaries/") else 0o100644
                entry.external_attr = mode << 16
                archive.writestr(entry, files[name], compresslevel=9)
        part.replace(output)
    finally:
        part.unlink(missing_ok=True)
    return output
