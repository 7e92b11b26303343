"""No master but a checker: the FMU Manipulation Toolbox."""

from __future__ import annotations

import subprocess
import sysconfig
from pathlib import Path

from harness import Package


def test_verif_fmutool_finds_nothing(package: Package) -> None:
    """`fmutool -check` says that the FMU is sound, and gives no warning."""
    tool = Path(sysconfig.get_path("scripts")) / "fmutool"
    command = [str(tool), "-input", str(package.path), "-check"]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = (run.stdout + run.stderr).splitlines()
    assert any("seems to be compliant with FMI-2.0" in line for line in lines), lines
    assert any("No semantic error" in line for line in lines), lines
    assert all(line.startswith("INFO") for line in lines), lines
