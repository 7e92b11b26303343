"""Input files: what is read and what is refused, as by `cargo ahv fly --input`."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import ahv

Tool = Callable[..., subprocess.CompletedProcess[str]]

ACCEPTED = [
    "time,delta_e[deg],phi\n0,0,0\n0.5,0,0\n0.5,1,0.25\n",
    '"time","delta_e[deg]","phi"\r\n0,0,0\r\n0.5,0,0\r\n\r\n"0.5",1,0.25',
    "time;delta_e[deg];phi\n0;0;0\n0,5;0;0\n0,5;1;0,25\n",
    "Time [s]\tdelta_e [deg]\tphi\n0\t0\t0\n0.5\t0\t0\n0.5\t1\t0.25\n",
    "time,delta_e[deg],phi,\n0,0,0,\n0.5,0,0,\n0.5,1,0.25,\n",
    "phi,delta_e[deg],time\n0,0,0\n0,0,0.5\n0.25,1,5e-1\n",
    "# a; b\ntime , delta_e[deg] , phi\n#\n0,0,0\n  # c\n0.5,0,0\n \n,,\n0.5,1,0.25\n",
    ",time,V,delta_e[deg],phi\n0,0,7,0,0\n1,0.5,NaN,0,0\n2,0.5,,1,0.25\n",
    "time,phi,delta_e[deg]\r0,0,0\r0.5,0,0\r0.5,0.25,1\r",
    "time,phi,delta_e[deg]\n0,0,0\n.5,+0.,-0\n5.E-1,2.5e-1,1\n",
]
REFUSED = [
    ("", "no header; the first line must be a header such as `time,delta_e,phi"),
    ("\n# time,phi\n", "no header"),
    ("t,phi\n", "line 1: there is no input `t`"),
    ("phi\n1\n", "line 1: there is no column `time`"),
    ("0,1\n1,1\n", "line 1: numbers instead of column names"),
    ("# time;phi\n0,5;1\n", "line 2: numbers instead of column names"),
    ("time,inf\n0,1\n", "line 1: numbers instead of column names"),
    ("time,delta\n", "line 1: there is no input `delta`; did you mean delta_e?"),
    ("time,mach0\n", "line 1: mach0 is a parameter, which does not change in flight"),
    ("time,phi,phi\n", "line 1: there are two columns phi"),
    ("time,Time\n", "line 1: there are two columns time"),
    ("time[ms],phi\n", "line 1, column time: unit `ms` is unknown; s is expected"),
    ("time,delta_e[grad]\n", "line 1, column delta_e: unit `grad` is unknown; rad or deg"),
    ("time,phi[%]\n", "line 1, column phi: unit `%` is unknown; 1 is expected"),
    ("time,phi\n0,1,2\n", "line 2: 3 values where the header names 2 columns (time, phi)"),
    ("time,phi\n0\n", "line 2: 1 values where the header names 2 columns (time, phi)"),
    ("time,phi\n0,1,5\n", "numbers with decimal commas need semicolons"),
    ("time,phi\n0,1\n1,x\n", "line 3, column phi: `x` is not a finite number"),
    ("time,phi\n0,1_0\n", "line 2, column phi: `1_0` is not a finite number"),
    ("time,phi\n0,١\n", "line 2, column phi: `١` is not a finite number"),  # noqa: RUF001
    ("time,phi\r\n\r\n0,\r\n", "line 3, column phi: the value is missing"),
    ("time,phi\n0,inf\n", "line 2, column phi: `inf` is not a finite number"),
    ("time,phi\n0,NaN\n", "line 2, column phi: `NaN` is not a finite number"),
    ("time,phi\n0,1e999\n", "line 2, column phi: `1e999` is not a finite number"),
    ("time;phi\n0;0.5\n1;1,5\n", "line 3, column phi: `1,5` has a decimal `,`, earlier numbers"),
    ("time;phi\n0;1.000,5\n", "line 2, column phi: `1.000,5` is not a finite number"),
    ('time,phi\n0,"1\n2,3\n', "line 2: a quotation"),
    ("time,phi\n1,0\n#\n0.5,0\n", "line 4, column time: 0.5 s follows 1 s"),
    ("time,w_gust\n0,0\n1,201\n", "line 3, column w_gust: 201 m/s is outside the range"),
    ("time,w_gust\n0,-1e200\n", "-1e200 m/s is outside the range of the FMU, [-200, 200]"),
    ("time,delta_e,phi\n0,0,0\n1,0,1e308\n2,0,-1e308\n", "line 4, column phi: the slope"),
    ("time,phi\n0,0\n5e-324,1\n", "the slope since the row for 0 s is not finite"),
    ("time,phi\n-1e308,0\n1e308,0\n", "line 3, column phi: the slope since the row for"),
    ("time,phi\n1,0\n1,1\n1,2\n", "line 4, column time: a third row for 1 s"),
]
BYTES = [
    (b"time\n0\n\xb0", "line 3: the text is not in UTF-8"),
    (b"time\n\0", "line 2: a zero byte"),
    (b"\xff\xfet", "the text starts as UTF-16 but is damaged"),
    (b"\xff\xfet\0\0\0", "the text starts as UTF-16 but is damaged"),
    (b"\xff\xfe\0\0t\0\0\0", "the text is in UTF-32"),
]
PLACE = re.compile(r"a\.csv(?:, line \d+)?(?:, column \w+)?:")


def written(folder: Path, content: str | bytes) -> Path:
    """An input file."""
    file = folder / "a.csv"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return file


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("text", ACCEPTED)
def test_files_of_all_kinds_of_programs_are_one_table(
    version: str, text: str, tmp_path: Path
) -> None:
    for encoding in ("utf-8", "utf-8-sig", "utf-16"):
        table = ahv.manoeuvre(written(tmp_path, text.encode(encoding)), ahv.fmu(version))
        assert table.dtype.names is not None and table.dtype.names[0] == "time"
        assert set(table.dtype.names) == {"time", "delta_e", "phi"}
        assert all(table.dtype[name] == np.float64 for name in table.dtype.names)
        assert table["time"].tolist() == [0.0, 0.5, 0.5]
        assert table["phi"].tolist() == [0.0, 0.0, 0.25]
        assert table["delta_e"] == pytest.approx([0.0, 0.0, np.radians(1.0)], rel=1e-15)


@pytest.mark.parametrize(("content", "said"), [*REFUSED, *BYTES])
def test_refusals_name_file_line_and_column(
    content: str | bytes, said: str, tmp_path: Path
) -> None:
    file = written(tmp_path, content)
    with pytest.raises(ahv.ManoeuvreError) as refused:
        ahv.manoeuvre(file)
    assert said in str(refused.value) and str(refused.value).startswith(str(file))


@pytest.mark.parametrize("content", [*ACCEPTED, *(text for text, _ in (*REFUSED, *BYTES))])
def test_verif_the_tool_reads_and_refuses_the_same(
    content: str | bytes, tmp_path: Path, fmus: dict[str, Path], tool: Tool
) -> None:
    file = written(tmp_path, content)
    options = ("--fmu", fmus["2.0"], "--output", tmp_path / "flight", "--stop", "0.01")
    flown = tool("fly", "--input", file, *options)
    try:
        ahv.manoeuvre(file)
    except ahv.ManoeuvreError as refused:
        assert flown.returncode != 0
        assert PLACE.findall(flown.stderr)[:1] == PLACE.findall(str(refused))[:1], flown.stderr
    else:
        assert flown.returncode == 0, flown.stderr


@pytest.mark.parametrize("name", ["elevator_doublet", "throttle_step", "gust"])
def test_shipped_manoeuvres_are_what_numpy_reads(name: str, root: Path) -> None:
    file = root / f"examples/{name}.csv"
    plain = np.genfromtxt(file, delimiter=",", names=True)
    read = ahv.manoeuvre(file)
    assert read.dtype.names == plain.dtype.names
    assert np.array_equal(read, plain)
