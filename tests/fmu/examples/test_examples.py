"""What every example says when something it needs is not there."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
SCRIPTS = (
    "closed_loop/fly.py",
    "closed_loop/sloshing.py",
    "closed_loop/coupling.py",
    "closed_loop/container.py",
    "closed_loop/steps.py",
    "ensemble/ensemble.py",
    "ensemble/replay.py",
    "ensemble/sensitivity.py",
    "ensemble/rates.py",
    "gusts/gusts.py",
)


def run(script: str, *options: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run an example."""
    return subprocess.run(
        [sys.executable, str(EXAMPLES / script), *options],
        capture_output=True,
        text=True,
        env=os.environ | environment,
        check=False,
    )


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_missing_package_is_named_with_the_command_that_brings_it(
    script: str, tmp_path: Path
) -> None:
    (tmp_path / "fmpy.py").write_text("raise ModuleNotFoundError(name='fmpy')\n", "utf-8")
    done = run(script, PYTHONPATH=str(tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("fmpy is missing: pip install")


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_missing_fmu_is_named_with_the_command_that_makes_it(script: str, tmp_path: Path) -> None:
    output = [] if script == "closed_loop/steps.py" else ["--output", str(tmp_path / "out")]
    done = run(script, "--fmu", str(tmp_path / "none.fmu"), *output)
    assert done.returncode == 1
    assert done.stderr.startswith("error: ") and "none.fmu" in done.stderr
    assert "run `cargo ahv package`" in done.stderr
    assert not (tmp_path / "out").exists()
