"""The closed loop in air that rises and falls: Dryden turbulence, gusts of many lengths."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "closed_loop")]
try:
    import matplotlib
    import numpy as np
    from fmpy import extract

    import design
    from air import SIGMA_M_PER_S, gust, turbulence
    from flight import Flight, fly
    from law import Law
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

PEAK_M_PER_S = 5.0
GRADIENTS_M = [50, 100, 200, 400, 800, 1600, 3200]
START_S, GUST_S = 0.5, 12.0
SHOWN = ("eta1", "slosh1", "n_z")
# Columns of Flight.rows.
TIME, GAMMA, ETA1, SLOSH, LOAD, ELEVATOR = 0, 2, 4, 5, 6, 7
# Baffles or none.
DAMPINGS = {"slosh damping 0.05": {}, "slosh damping 0.01": {"slosh_damping": 0.01}}


def autopilots(folder: str) -> tuple[Law, Law]:
    """The autopilot of the closed loop, and one that leaves all controls in trim."""
    law = design.design(design.model(folder))
    idle = Law(**vars(law) | {"K": 0.0 * law.K, "Ki": 0.0 * law.Ki})
    return law, idle


def meet(folder: str, law: Law, air: np.ndarray, **parameters: float) -> Flight:
    """Level flight through this air; shape (steps + 1,), m/s."""
    return fly(folder, law, np.zeros((len(air) - 1, 2)), SHOWN, gust=air, **parameters)


def away(rows: np.ndarray) -> np.ndarray:
    """What is shown as deviations from the first row: deg, 1 mm, 1 mm, g, deg, deg/s."""
    moved = rows - rows[0]
    rate = np.gradient(rows[:, ELEVATOR], rows[:, TIME])
    return np.column_stack(
        [
            moved[:, GAMMA] / design.DEG,
            moved[:, ETA1] * 1e3,
            moved[:, SLOSH] * 1e3,
            moved[:, LOAD],
            moved[:, ELEVATOR] / design.DEG,
            rate / design.DEG,
        ]
    )


HEAD = "gamma deg | nose mm | slosh mm | n_z g | elevator deg | its rate deg/s |"


def line(name: str, values: np.ndarray) -> str:
    """A row of a table."""
    return f"| {name} | " + " | ".join(f"{value:.3g}" for value in values) + " |"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--stop", type=float, default=120.0, help="s, of the turbulence")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, default=Path("target/gusts"))
    options = parser.parse_args()
    if not options.fmu.is_file():
        sys.exit(f"error: {options.fmu} does not exist: run `cargo ahv package`")
    options.output.mkdir(parents=True, exist_ok=True)
    folder = extract(str(options.fmu))
    law, idle = autopilots(folder)
    speed, period, steps = law.level[0], law.period_s, round(options.stop / law.period_s)

    figure, axes = plt.subplots(2, 4, figsize=(11, 5), layout="constrained")
    print(f"turbulence, standard deviations over {options.stop:g} s:\n| sigma, m/s | {HEAD}")
    for name, sigma in SIGMA_M_PER_S.items():
        air = turbulence(sigma, speed, steps, period, options.seed)
        for damping, parameters in DAMPINGS.items():
            flown = meet(folder, law, air, **parameters)
            if flown.ended:
                sys.exit(f"error: lost in turbulence: {flown.ended}")
            print(line(f"{sigma:.2f} ({name}), {damping}", away(flown.rows).std(axis=0)))
    free = meet(folder, idle, air)
    print(f"without autopilot: {free.rows[-1, TIME]:.2f} s, {free.ended}")
    shown, values = flown.rows[:, TIME] <= 20.0, away(flown.rows)
    axes[0, 0].plot(flown.rows[shown, TIME], air[1:][shown], "C7", lw=0.8)
    for axis, column in zip(axes[0, 1:], (3, 2, 4), strict=True):
        axis.plot(flown.rows[shown, TIME], values[shown, column], "C0", lw=0.8)

    count = round(GUST_S / period)
    rows = {damping: [] for damping in DAMPINGS}
    for damping, parameters in DAMPINGS.items():
        print(f"\ngust of {PEAK_M_PER_S:g} m/s, {damping}, largest:\n| gradient length, m | {HEAD}")
        for gradient in GRADIENTS_M:
            air = gust(PEAK_M_PER_S, gradient, speed, count, period, START_S)
            flown = meet(folder, law, air, **parameters)
            if flown.ended:
                sys.exit(f"error: lost in a gust: {flown.ended}")
            rows[damping].append(np.abs(away(flown.rows)).max(axis=0))
            print(line(f"{gradient}", rows[damping][-1]))
            if gradient == 400 and not parameters:
                axes[1, 0].plot(flown.rows[:, TIME], air[1:], "C7", lw=1)
                axes[1, 0].set_xlim(0.0, 2.0)
    for axis, column in zip(axes[1, 1:], (3, 2, 4), strict=True):
        for (damping, table), style in zip(rows.items(), ("C0o-", "C3s--"), strict=True):
            axis.semilogx(GRADIENTS_M, np.array(table)[:, column], style, ms=4, label=damping)
        axis.axvspan(GRADIENTS_M[0] * 0.8, 100, color="C7", alpha=0.25, lw=0)
        axis.set_xlabel("gradient length, m; grey: too sharp", fontsize=8)
    labels = ("load factor, g", "slosh, fore tank, mm", "elevator, deg")
    for axis, label in zip(axes[0], ("turbulence, m/s", *labels), strict=True):
        axis.set(xlabel="time, s", ylabel=label)
    for axis, label in zip(axes[1], ("gust of 400 m, m/s", *labels), strict=True):
        axis.set_ylabel(label if axis is axes[1, 0] else f"largest {label}")
    axes[1, 0].set_xlabel("time, s")
    axes[1, 2].legend(fontsize=8)
    for axis in axes.ravel():
        axis.grid(alpha=0.3)
    figure.savefig(options.output / "gusts.png", dpi=110)
    plt.close(figure)
    print(f"\n{options.output / 'gusts.png'}")


if __name__ == "__main__":
    main()
