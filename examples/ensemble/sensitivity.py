"""Which parameters decide about the margins: Sobol' indices, with confidence intervals.

Of what every vehicle has, stable or not: the least distance of the Nyquist curve from -1, which is
0 if the loop is unstable or there is no trim, and whether that is so. No flights are needed.
"""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from pathlib import Path

HERE = Path(__file__).resolve().parent
LOOP = HERE.parent / "closed_loop"
sys.path[:0] = [str(HERE), str(LOOP)]
# The package of this repository, unless it is installed.
sys.path.append(str(HERE.parents[1] / "python/src"))
try:
    import matplotlib
    import numpy as np
    from scipy.stats import sobol_indices, uniform

    import command_line
    from batch import margins_part
    from cluster import connect, upload
    from law import BadLaw, Law, autopilot_beside
    from vehicles import VARIED, scaled
except ModuleNotFoundError as missing:
    sys.exit(
        f"{missing.name} is missing: pip install --require-hashes -r tests/fmu/requirements.lock"
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt

RESULTS = ("distance from -1", "unstable or no trim")
CONFIDENCE, RESAMPLES = 0.95, 400
# Vehicles per task: seconds.
CHUNK = 1000


def picture(indices: dict[str, np.ndarray], path: Path) -> None:
    """Plot first-order and total indices, shape (3, results, parameters): value, low and high."""
    figure, axes = plt.subplots(1, len(RESULTS), figsize=(9, 4), sharey=True, layout="constrained")
    places = np.arange(len(VARIED))
    for k, (axis, result) in enumerate(zip(axes, RESULTS, strict=True)):
        for shift, (name, (value, low, high)) in zip((-0.2, 0.2), indices.items(), strict=True):
            away = np.maximum([value[k] - low[k], high[k] - value[k]], 0.0)
            axis.barh(places + shift, value[k], 0.38, xerr=away, label=name, error_kw={"lw": 1})
        axis.set_title(result, fontsize=11)
        axis.set_yticks(places, list(VARIED))
        axis.set_xlabel("Sobol' index")
        axis.grid(alpha=0.3, axis="x")
    axes[0].invert_yaxis()
    axes[0].legend(fontsize=9)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fmu", type=Path, default=Path("target/ahv.fmu"))
    parser.add_argument("--autopilot", type=Path, help="its FMU; default: beside the vehicle's")
    parser.add_argument("--samples", type=int, default=1024, help="a power of two")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scheduler", help="Dask cluster, tcp://HOST:PORT; default: this machine")
    parser.add_argument("--workers", type=int, help="local processes; default: one per core")
    parser.add_argument("--output", type=Path, default=Path("target/ensemble"))
    options = parser.parse_args()
    autopilot = options.autopilot or autopilot_beside(options.fmu)
    command_line.need(options.fmu, autopilot)
    if options.samples < 2 or options.samples & (options.samples - 1):
        sys.exit(f"error: --samples {options.samples} is no power of two")
    try:
        law = Law.within(autopilot)
    except BadLaw as failure:
        sys.exit(f"error: {failure}")
    command_line.make(options.output)

    def results(unit: np.ndarray) -> np.ndarray:
        """Results, shape (results, vehicles), of points in the unit cube, by column."""
        vehicles = scaled(unit.reshape(len(VARIED), -1).T)
        chunks = [vehicles[i : i + CHUNK] for i in range(0, len(vehicles), CHUNK)]
        futures = client.map(margins_part, [shared] * len(chunks), [law] * len(chunks), chunks)
        distance = np.concatenate(client.gather(futures))
        found = np.array([distance, distance == 0.0], dtype=float)
        return found.reshape(len(RESULTS), *unit.shape[1:])

    begin = time.monotonic()
    with connect(options.scheduler, options.workers) as client:
        upload(client, options.output)
        shared = client.scatter(options.fmu.read_bytes(), broadcast=True, hash=True)
        found = sobol_indices(
            func=results,
            n=options.samples,
            dists=[uniform()] * len(VARIED),
            rng=np.random.default_rng(options.seed),
        )
    count = options.samples * (len(VARIED) + 2)
    print(f"{count} vehicles in {time.monotonic() - begin:.0f} s")
    with warnings.catch_warnings(action="ignore"):
        # SciPy has no interval of an index that is 0 in every part of the sample.
        bounds = found.bootstrap(confidence_level=CONFIDENCE, n_resamples=RESAMPLES)
    values = {"first order": found.first_order, "total": found.total_order}
    intervals = (bounds.first_order.confidence_interval, bounds.total_order.confidence_interval)
    indices = {
        name: np.array([value, *(np.where(np.isnan(bound), value, bound) for bound in interval)])
        for (name, value), interval in zip(values.items(), intervals, strict=True)
    }
    for k, result in enumerate(RESULTS):
        print(f"\n| {result} | first order | total |\n|---|---|---|")
        for i in np.argsort(-found.total_order[k]):
            cells = [
                f"{value:.2f} ({low:.2f} to {high:.2f})"
                for value, low, high in (index[:, k, i] for index in indices.values())
            ]
            print(f"| `{list(VARIED)[i]}` | {' | '.join(cells)} |")
    image = options.output / "sensitivity.png"
    picture(indices, image)
    print(f"\n{image}")


if __name__ == "__main__":
    main()
