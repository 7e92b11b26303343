"""What the command lines of the examples have in common: one line says what is wrong."""

from __future__ import annotations

import argparse
import sys
import zipfile
from math import inf
from pathlib import Path


def need(*fmus: Path) -> None:
    """End the program unless each of these files is an FMU."""
    for file in fmus:
        if not file.is_file():
            sys.exit(f"error: {file} does not exist: run `cargo ahv package`")
        if not zipfile.is_zipfile(file):
            sys.exit(f"error: {file} is no FMU: `cargo ahv package` writes target/ahv.fmu")


def make(folder: Path) -> None:
    """Make the folder of the results, or end the program."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as failure:
        sys.exit(f"error: {failure}: give another --output")


def duration(text: str) -> float:
    """Seconds of a flight."""
    seconds = float(text)
    if not 0.1 <= seconds < inf:
        raise argparse.ArgumentTypeError(f"{text} is refused: a flight takes 0.1 s or more")
    return seconds


def setting(text: str) -> tuple[str, float]:
    """A parameter and its value."""
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        said = f"{text} is refused: NAME=VALUE is expected, VALUE a number"
        raise argparse.ArgumentTypeError(said) from None
