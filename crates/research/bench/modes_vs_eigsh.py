"""Time and error of SciPy's shift-invert eigsh and of LAPACK on the beam's matrices, beside ours.

Usage: modes_vs_eigsh.py FILE.json
Prints for each method: name;median s;least s;largest s;largest relative error of omega
Keys of the file:
  element_m, stiffness[], density[]              elements of the beam
  oscillators[]: {node, mass, stiffness}         sloshing masses
  omega_rad_per_s[]                              our frequencies
Our frequencies hold 1e-12 (tests/physics/structure/modes.rs), so they serve as the truth.
"""

import json
import statistics
import sys
import time

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import eigsh

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


def sparse(k, m, count):
    """Shift-invert Lanczos."""
    return eigsh(k, k=count, M=m, sigma=-1.0, which="LM", return_eigenvectors=True)[0]


def dense(k, m, count):
    """LAPACK's divide and conquer on the dense matrices, the lowest eigenvalues only."""
    return eigh(k.toarray(), m.toarray(), subset_by_index=[0, count - 1])[0]


def main():
    with open(sys.argv[1]) as file:
        data = json.load(file)
    k, m = matrices(data)
    ours = np.sort([omega for omega in data["omega_rad_per_s"] if omega > 0])
    for name, method, repeats in (("eigsh", sparse, 50), ("LAPACK", dense, 3)):
        times = []
        for _ in range(repeats):
            start = time.perf_counter()
            values = method(k, m, RIGID + len(ours))
            times.append(time.perf_counter() - start)
        theirs = np.sqrt(np.abs(np.sort(values)))
        errors = theirs[RIGID:] / ours - 1
        numbers = (statistics.median(times), min(times), max(times))
        spread = ";".join(f"{number:.9g}" for number in numbers)
        print(f"{name};{spread};{np.max(abs(errors)):.1e}")


if __name__ == "__main__":
    main()
