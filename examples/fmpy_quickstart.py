"""Fly an elevator doublet in FMPy: pip install fmpy, then run this in the repository."""

import numpy as np
from fmpy import simulate_fmu

doublet = np.genfromtxt("examples/elevator_doublet.csv", delimiter=",", names=True)
result = simulate_fmu("target/ahv.fmu", input=doublet, output=["V", "gamma", "eta1"])

for time, v, gamma, eta1 in result[::10]:
    print(f"t = {time:4.2f} s  V = {v:8.3f} m/s  gamma = {gamma:9.6f} rad  eta1 = {eta1:8.5f} m")
