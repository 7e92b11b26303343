"""The header of an input file: variable and unit of each column."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ahv._text import suggest

# What Rust reads as a number, and `cargo ahv fly` with it.
NUMBER = re.compile(r"[+-]?(inf(inity)?|nan|([0-9]+\.?[0-9]*|\.[0-9]+)(e[+-]?[0-9]+)?)", re.I)
LARGEST = 1.7976931348623157e308


class ManoeuvreError(ValueError):
    """An input file is refused; the text names file, line and column, and what is accepted."""


@dataclass
class Column:
    """A column of the file; value of the FMU = (number - offset) / factor."""

    name: str
    is_time: bool = False
    is_input: bool = False
    unit: str = "1"
    factor: float = 1.0
    offset: float = 0.0
    least: float = -LARGEST
    largest: float = LARGEST


class Inputs:
    """What an FMU's description says of its inputs and other variables."""

    def __init__(self, description: Any) -> None:
        self.variables = {v.name: v for v in description.modelVariables}
        self.names = [v.name for v in self.variables.values() if v.causality == "input"]
        self._units = {unit.name: unit for unit in description.unitDefinitions}

    def example(self) -> str:
        """A header, for messages."""
        return ",".join(["time", *self.names])

    def display(self, variable: Any) -> tuple[str, float, float]:
        """Name, factor and offset of the display unit, or of the unit without one."""
        unit = variable.unit or "1"
        for shown in self._units[unit].displayUnits if unit in self._units else ():
            if shown.name == variable.displayUnit:
                return shown.name, shown.factor, shown.offset
        return unit, 1.0, 0.0


def columns(titles: Sequence[str], at: str, inputs: Inputs) -> list[Column]:
    """Parse a header; `at` is its place in messages."""
    if any(NUMBER.fullmatch(title.replace(",", ".")) for title in titles):
        raise ManoeuvreError(
            f"{at}: numbers instead of column names; add a header line such as "
            f"`{inputs.example()}`, without `#`"
        )
    found: list[Column] = []
    for title in titles:
        column = _column(title, at, inputs)
        if column.name and any(known.name == column.name for known in found):
            raise ManoeuvreError(f"{at}: there are two columns {column.name}")
        found.append(column)
    # A delimiter at the end of the line adds a column without a name.
    while found and not found[-1].name:
        found.pop()
    if not any(column.is_time for column in found):
        raise ManoeuvreError(
            f"{at}: there is no column `time`; a header is expected, such as "
            f"`{inputs.example()}`, with commas, semicolons or tabs"
        )
    return found


def _column(title: str, at: str, inputs: Inputs) -> Column:
    name, unit = title, None
    if title.endswith("]") and "[" in title:
        name, unit = (part.strip() for part in title[:-1].split("[", 1))
    if name.isascii() and name.lower() == "time":
        if unit not in (None, "s"):
            raise ManoeuvreError(f"{at}, column {name}: unit `{unit}` is unknown; s is expected")
        return Column("time", is_time=True)
    if not name:
        return Column(name)
    variable = inputs.variables.get(name)
    if variable is None:
        hint = suggest(name, inputs.names)
        raise ManoeuvreError(f"{at}: there is no input `{name}`; {hint}")
    if variable.causality == "parameter":
        raise ManoeuvreError(
            f"{at}: {name} is a parameter, which does not change in flight; remove the column and "
            f'use start_values={{"{name}": VALUE}}'
        )
    if variable.causality != "input":
        return Column(name)
    own = variable.unit or "1"
    shown, factor, offset = inputs.display(variable)
    if unit in (None, own):
        factor, offset = 1.0, 0.0
    elif unit != shown:
        other = "" if shown == own else f" or {shown}"
        raise ManoeuvreError(
            f"{at}, column {name}: unit `{unit}` is unknown; {own}{other} is expected"
        )
    least = -LARGEST if variable.min is None else float(variable.min)
    largest = LARGEST if variable.max is None else float(variable.max)
    return Column(name, False, True, own, factor, offset, least, largest)
