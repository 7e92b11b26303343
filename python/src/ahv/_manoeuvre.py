"""Inputs over time from a CSV file, by the rules of `cargo ahv fly --input`."""

from __future__ import annotations

import csv as spreadsheet
import math
import re
from collections.abc import Iterator, Sequence
from os import PathLike
from pathlib import Path

import numpy as np
import numpy.typing as npt
from fmpy import read_model_description

from ahv._columns import NUMBER, Column, Inputs, ManoeuvreError, columns
from ahv._package import fmu as packaged
from ahv._text import short

MAX_QUOTED_CHARACTERS = 40


def manoeuvre(
    csv: str | PathLike[str], fmu: str | PathLike[str] | None = None
) -> npt.NDArray[np.void]:
    """Inputs over time from a CSV file, for FMPy: `simulate_fmu(..., input=manoeuvre(csv))`.

    The file is what `cargo ahv fly --input` reads: a header `time,delta_e,phi` with any inputs of
    the FMU, in any order; time in s, values in the FMU's units, or in degrees under a name such as
    `delta_e[deg]`. Values are linear between rows; a jump is two rows with the same time, the
    values before and after it. Columns are separated by commas, semicolons or tabs, numbers have a
    decimal point or comma. Lines that start with `#` and columns of outputs are ignored. The text
    is UTF-8, or UTF-16 with a byte order mark.

    Args:
        csv: path of the file.
        fmu: path of the FMU, or of its folder, whose inputs are meant; by default the FMU of this
            package.

    Returns:
        A structured array of shape (rows,): `time`, s, then the inputs in the order of the file,
        in the units of the FMU (rad, m/s, 1). All fields are float64.

    Raises:
        ManoeuvreError: the file is refused; the text has file, line, column and what is accepted.
        OSError: the file cannot be read.
    """
    path = Path(csv)
    description = read_model_description(str(packaged() if fmu is None else fmu), validate=False)
    return _parse(_decode(path.read_bytes(), str(path)), str(path), Inputs(description))


def _decode(content: bytes, file: str) -> str:
    if content.startswith((b"\xff\xfe\0\0", b"\0\0\xfe\xff")):
        raise ManoeuvreError(f"{file}: the text is in UTF-32; save the file as CSV in UTF-8")
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        try:
            text = content.decode("utf-16")
        except UnicodeDecodeError:
            text = "\0"
        if "\0" in text:
            raise ManoeuvreError(
                f"{file}: the text starts as UTF-16 but is damaged; save the file again"
            )
        return text
    content = content.removeprefix(b"\xef\xbb\xbf")
    try:
        text = content.decode("utf-8")
        reached, problem = text.find("\0"), "a zero byte, which text cannot contain"
        before = text[: max(reached, 0)].count("\n")
    except UnicodeDecodeError as error:
        reached, problem = error.start, "the text is not in UTF-8"
        before = content[:reached].count(b"\n")
    if reached >= 0:
        raise ManoeuvreError(f"{file}, line {before + 1}: {problem}; save the file as CSV in UTF-8")
    return text


def _parse(text: str, file: str, inputs: Inputs) -> npt.NDArray[np.void]:
    records = _records(text, file, inputs)
    header, at = next(records)
    names = columns(header, at, inputs)
    order = [column.name for column in names if column.is_input]
    decimal_mark = _DecimalMark()
    rows: list[tuple[float, ...]] = []
    for record, at in records:
        row = _row(record, at, names, decimal_mark)
        _check_sequence(row, rows, order, at)
        rows.append(row)
    return np.array(rows, dtype=[(name, np.float64) for name in ("time", *order)])


def _records(text: str, file: str, inputs: Inputs) -> Iterator[tuple[list[str], str]]:
    """Fields of each line with its place; without empty lines and comments."""
    lines = [
        (f"{file}, line {number}", line)
        for number, line in enumerate(re.split("[\n\r]", text.replace("\r\n", "\n")), 1)
        if line.strip(" \t,;") and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise ManoeuvreError(
            f"{file}: no header; the first line must be a header such as `{inputs.example()}`"
        )
    delimiter = _delimiter(lines[0][1])
    for number, (at, line) in enumerate(lines, 1):
        # A quotation that goes on beyond its line contains the line's end.
        end = "\n" if number < len(lines) else ""
        try:
            record = next(spreadsheet.reader([line + end], delimiter=delimiter))
        except spreadsheet.Error as error:
            raise ManoeuvreError(f"{at}: {error}") from error
        if any("\n" in field for field in record):
            raise ManoeuvreError(f"{at}: a quotation mark opens and is not closed on this line")
        yield [field.strip() for field in record], at


def _delimiter(header: str) -> str:
    """Comma, semicolon or tab, whichever is most frequent outside quotes."""
    outside = "".join(header.split('"')[::2])
    return max(",;\t", key=outside.count)


class _DecimalMark:
    """The decimal mark of the file, once a number has shown it."""

    known: str | None = None

    def number(self, field: str) -> float:
        found = next((character for character in field if character in ".,"), None)
        if found is not None:
            self.known = self.known or found
            if found != self.known:
                raise ValueError(
                    f"`{field}` has a decimal `{found}`, earlier numbers have `{self.known}`"
                )
        if not field:
            raise ValueError("the value is missing")
        digits = field.replace(",", ".")
        value = float(digits) if NUMBER.fullmatch(digits) else math.nan
        if not math.isfinite(value):
            raise ValueError(f"`{field[:MAX_QUOTED_CHARACTERS]}` is not a finite number")
        return value


def _row(
    record: Sequence[str], at: str, names: Sequence[Column], decimal_mark: _DecimalMark
) -> tuple[float, ...]:
    """Time and inputs of a row."""
    beyond = any(record[len(names) :])
    if len(record) < len(names) or beyond:
        hint = "; numbers with decimal commas need semicolons between them" if beyond else ""
        header = ", ".join(column.name for column in names)
        raise ManoeuvreError(
            f"{at}: {len(record)} values where the header names {len(names)} columns "
            f"({header}){hint}"
        )
    time, values = 0.0, []
    for field, column in zip(record, names, strict=False):
        if not column.is_time and not column.is_input:
            continue
        try:
            value = (decimal_mark.number(field) - column.offset) / column.factor
            if not column.least <= value <= column.largest:
                limits = f"[{short(column.least)}, {short(column.largest)}]"
                raise ValueError(
                    f"{short(value)} {column.unit} is outside the range of the FMU, {limits}"
                )
        except ValueError as error:
            raise ManoeuvreError(f"{at}, column {column.name}: {error}") from None
        if column.is_time:
            time = value
        else:
            values.append(value)
    return time, *values


def _check_sequence(
    row: tuple[float, ...], rows: Sequence[tuple[float, ...]], order: Sequence[str], at: str
) -> None:
    """Times do not decrease, at most two rows have the same time, and slopes are finite."""
    if not rows:
        return
    time, last = row[0], rows[-1][0]
    if time < last:
        raise ManoeuvreError(
            f"{at}, column time: {short(time)} s follows {short(last)} s; times must increase, or "
            "occur twice for a jump"
        )
    if len(rows) > 1 and time == rows[-2][0]:
        raise ManoeuvreError(
            f"{at}, column time: a third row for {short(time)} s; a jump has two, the values "
            "before and after it"
        )
    if time == last:
        return
    span = time - last
    for name, before, after in zip(order, rows[-1][1:], row[1:], strict=True):
        # The slope over an infinite span would be zero.
        if not math.isfinite(span) or not math.isfinite((after - before) / span):
            raise ManoeuvreError(
                f"{at}, column {name}: the slope since the row for {short(last)} s is not finite: "
                "values or times are too far apart, or times too close; a jump is two rows with "
                "the same time"
            )
