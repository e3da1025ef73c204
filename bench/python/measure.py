"""What the Python package costs over the library: importing it, a run, a sweep.

    python measure.py PROGRAM

PROGRAM is the command line `squirmers`, built with `cargo build --release`. Prints a table. A run's overhead is the time of the call less the time of the
run in the library, which the run itself says. Sweeps by both sides take turns; each side's shortest time counts, for the same rows: that of the command line
with its start, that of Python without and with it.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

AXES = {"beta": "0.01:5:0.01", "dx": "0.01:2:0.01"}
ROUNDS = 5


def importing():
    code = "import time; began = time.perf_counter(); import squirmers; print(time.perf_counter() - began)"
    times = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(20)]
    return sorted(times)[10]


def overheads(samples):
    import squirmers

    scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
    over, own = [], []
    for _ in range(1000):
        began = time.perf_counter()
        run = squirmers.run(scene, "exact", samples=samples)
        over.append(time.perf_counter() - began - run.seconds)
        own.append(run.seconds)
    return sorted(own)[500], sorted(over)[500]


def sweeps(program, model):
    vary = [f"--vary={name}={values}" for name, values in AXES.items()]
    with tempfile.TemporaryDirectory() as folder:
        code = (
            "import time, numpy, squirmers;"
            "axes = {'beta': numpy.arange(1, 501) / 100, 'dx': numpy.arange(1, 201) / 100};"
            f"began = time.perf_counter(); squirmers.sweep('opposed', axes, models='{model}');"
            "print(time.perf_counter() - began)"
        )
        sides = {
            "command line": [program, "sweep", "opposed", *vary, "--method", model, "--out", f"{folder}/out", "--fresh"],
            "Python": [sys.executable, "-c", code],
        }
        times, calls = {side: [] for side in sides}, []
        for _ in range(ROUNDS):
            for side, command in sides.items():
                began = time.perf_counter()
                said = subprocess.run(command, check=True, capture_output=True).stdout
                times[side].append(time.perf_counter() - began)
                if side == "Python":
                    calls.append(float(said))
        rows = sum(1 for _ in Path(folder, "out", "sweep.csv").open()) - 1
    return rows, min(times["command line"]), min(calls), min(times["Python"])


def main():
    (program,) = sys.argv[1:]
    print(f"import squirmers: {1e3 * importing():.1f} ms")
    for samples in (True, False):
        own, over = overheads(samples)
        print(f"run, samples={samples}: {1e6 * own:.1f} us in the library, {1e6 * over:.1f} us over it")
    for model in ("lt", "exact"):
        rows, command_line, call, process = sweeps(program, model)
        ratios = f"{call / command_line:.3f} and {process / command_line:.3f}"
        print(f"sweep of {rows} collisions, {model}: command line {command_line:.2f} s, Python {call:.2f} s, its process {process:.2f} s: {ratios} times as long")


if __name__ == "__main__":
    main()
