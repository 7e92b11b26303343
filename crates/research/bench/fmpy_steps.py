"""Seconds per simulated second in FMPy, at steps of 10 ms: two inputs set, five outputs read.

Usage: fmpy_steps.py REPEATS AHV_FMU IDLE_FMU [PYTHON_FMU]
  IDLE_FMU  an FMU of two inputs and five outputs whose steps do nothing
Prints for each a line: name;median;least;largest.
"""

import statistics
import sys
import tempfile
import time

import fmpy
from fmpy.fmi2 import FMU2Slave

STEP = 0.01
STEPS = 140
# rad, against trim: as examples/elevator_doublet.csv.
DOUBLET = [0.0] * 50 + [0.0044] * 15 + [-0.0044] * 15 + [0.0] * 60
INPUTS, OUTPUTS = ("delta_e", "phi"), ("V", "gamma", "alpha", "q", "eta1")


def measure(name, file, repeats, inputs=INPUTS, outputs=OUTPUTS):
    """Flies `repeats` times and prints the time of the steps alone."""
    folder = tempfile.mkdtemp()
    fmpy.extract(file, unzipdir=folder)
    description = fmpy.read_model_description(folder)
    identifier = description.coSimulation.modelIdentifier
    references = {v.name: v.valueReference for v in description.modelVariables}
    inputs, outputs = ([references[n] for n in names] for names in (inputs, outputs))
    fmu = FMU2Slave(
        guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName=name
    )
    times = []
    for _ in range(repeats):
        fmu.instantiate()
        fmu.setupExperiment(startTime=0.0, tolerance=1e-8)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        start = time.perf_counter()
        for step in range(STEPS):
            fmu.setReal(inputs, [DOUBLET[step], 0.0])
            fmu.doStep(step * STEP, STEP)
            fmu.getReal(outputs)
        times.append((time.perf_counter() - start) / (STEP * STEPS))
        fmu.terminate()
        # Not fmu.freeInstance(): that unloads the library too.
        fmu.fmi2FreeInstance(fmu.component)
    print(f"{name};{statistics.median(times)};{min(times)};{max(times)}", flush=True)


def main():
    repeats, ahv, idle, *python = sys.argv[1:]
    measure("ours", ahv, int(repeats))
    measure("empty steps", idle, int(repeats), ("u1", "u2"), ("y1", "y2", "y3", "y4", "y5"))
    for file in python:
        measure("PythonFMU", file, min(int(repeats), 3))


if __name__ == "__main__":
    main()
