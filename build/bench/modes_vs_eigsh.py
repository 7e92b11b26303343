"""Time and error of SciPy's shift-invert eigsh on the matrices of the beam, beside ours.

Usage: modes_vs_eigsh.py FILE.json, with the keys
  element_m, stiffness[], density[]              elements of the beam
  oscillators[]: {node, mass, stiffness}         sloshing masses
  omega_rad_per_s[], median_s                    our frequencies and the time they took
Our frequencies hold 1e-12 (tests/verif_modes.rs), so they serve as the truth.
"""

import json
import statistics
import sys
import time

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import eigsh

REPEATS = 50
RIGID = 2


def matrices(data):
    """K and M in scaled rotations (element length times slope), as CSC."""
    length, count = data["element_m"], len(data["density"])
    k = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]], float)
    m = np.array(
        [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]], float
    )
    size = 2 * (count + 1) + len(data["oscillators"])
    rows, cols, stiffness, mass = [], [], [], []

    def add(places, k_block, m_block):
        for i, row in enumerate(places):
            for j, col in enumerate(places):
                rows.append(row)
                cols.append(col)
                stiffness.append(k_block[i][j])
                mass.append(m_block[i][j])

    for e, (ei, density) in enumerate(zip(data["stiffness"], data["density"], strict=True)):
        add(range(2 * e, 2 * e + 4), k * ei / length**3, m * density * length / 420)
    for j, o in enumerate(data["oscillators"]):
        places = [2 * o["node"], 2 * (count + 1) + j]
        spring = o["stiffness"] * np.array([[1, -1], [-1, 1]])
        add(places, spring, np.diag([0, o["mass"]]))

    def build(entries):
        return coo_matrix((entries, (rows, cols)), shape=(size, size)).tocsc()

    return build(stiffness), build(mass)


def main():
    with open(sys.argv[1]) as file:
        data = json.load(file)
    k, m = matrices(data)
    ours = np.sort([omega for omega in data["omega_rad_per_s"] if omega > 0])
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        count = RIGID + len(ours)
        values = eigsh(k, k=count, M=m, sigma=-1.0, which="LM", return_eigenvectors=True)[0]
        times.append(time.perf_counter() - start)
    theirs = np.sqrt(np.abs(np.sort(values)))
    print(f"unknowns {k.shape[0]}, modes {len(ours)}")
    median = statistics.median(times)
    print(f"median: ours {1e3 * data['median_s']:.2f} ms, eigsh {1e3 * median:.2f} ms")
    print("rigid-body modes of eigsh, rad/s (truth 0):", theirs[:RIGID])
    print("eigsh against ours, relative:", theirs[RIGID:] / ours - 1)


if __name__ == "__main__":
    main()
