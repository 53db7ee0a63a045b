#!/usr/bin/env python3
"""Forward orthogonal least squares beside an independent implementation, on the same rows.

Optional: nothing of the project needs it.

    python3 -m venv peer && peer/bin/pip install sysidentpy==0.9.0
    build/release/bin/amb run --rig turbomolecular_pump --scenario turbomolecular_pump_identify \\
        --record pump.lcm
    build/release/bin/amb export pump.lcm --csv pump.csv
    peer/bin/python benchmark/speed/sysidentpy_peer.py build/release/bin/amb pump.csv

From the excitation of all four axes to the reading of each: the closed loop, which is stable, so
that a free run tells something. Same lags, same degree, same number of terms; each is the better of
two runs in time, in processes of one thread each.
"""

import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import time

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402: threads are counted when it is loaded

AXES = ("ux", "uy", "lx", "ly")
LAGS = 4
SKIP = 50  # rows at the start that do not judge, as amb does


def columns(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = csv.reader(file)
        head = next(rows)
        data = np.array([[float(value) if value else math.nan for value in row] for row in rows])
    inputs = [head.index(f"excitation_{axis}_m") for axis in AXES]
    outputs = [head.index(f"position_{axis}_m") for axis in AXES]
    return data[:, inputs], data[:, outputs]


def fit_percent(measured, predicted):
    measured, predicted = measured[SKIP:], predicted[SKIP:]
    if not np.all(np.isfinite(predicted)):
        return -math.inf
    error = np.linalg.norm(measured - predicted)
    return 100.0 * (1.0 - error / np.linalg.norm(measured - measured.mean()))


def ours(amb, path, axis, arguments):
    with tempfile.NamedTemporaryFile(suffix=".json") as answer:
        subprocess.run(
            [amb, "identify", "narx", path, "--rig", "turbomolecular_pump",
             "--input", ",".join(f"excitation_{a}_m" for a in AXES),
             "--output", f"position_{axis}_m", "--train", arguments.train,
             "--test", arguments.test, "--degree", str(arguments.degree),
             "--terms", str(arguments.terms), "--output-lags", str(LAGS),
             "--input-lags", str(LAGS), "--skip", str(SKIP), "--json", answer.name],
            check=True, stdout=subprocess.DEVNULL)
        found = json.load(open(answer.name, encoding="utf-8"))
    judged = found["judged"][-1]
    return (found["time_s"], judged["one_step"]["fit_percent"][0],
            judged["free_run"]["fit_percent"][0])


def theirs(inputs, output, arguments):
    from sysidentpy.basis_function import Polynomial
    from sysidentpy.model_structure_selection import FROLS
    from sysidentpy.parameter_estimation import LeastSquares

    train = slice(*map(int, arguments.train.split(":")))
    test = slice(*map(int, arguments.test.split(":")))
    scale_u, scale_y = inputs[train].std(axis=0), output[train].std()
    u, y = inputs / scale_u, (output / scale_y).reshape(-1, 1)
    lags = list(range(1, LAGS + 1))
    model = FROLS(order_selection=False, n_terms=arguments.terms, ylag=lags,
                  xlag=[lags] * len(AXES), basis_function=Polynomial(degree=arguments.degree),
                  estimator=LeastSquares(), err_tol=None)
    began = time.perf_counter()
    model.fit(X=u[train], y=y[train])
    took = time.perf_counter() - began
    fits = []
    for steps in (1, None):
        predicted = model.predict(X=u[test], y=y[test], steps_ahead=steps)
        fits.append(fit_percent(y[test, 0], np.asarray(predicted).reshape(-1)))
    return took, *fits


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("amb")
    parser.add_argument("data", help="CSV file of amb export")
    parser.add_argument("--train", default="40000:60000")
    parser.add_argument("--test", default="60000:64000")
    parser.add_argument("--degree", type=int, default=2)
    parser.add_argument("--terms", type=int, default=14)
    arguments = parser.parse_args()
    inputs, outputs = columns(arguments.data)
    print(f"rows {arguments.train} fitted, {arguments.test} judged; degree {arguments.degree}, "
          f"{LAGS}+{LAGS} lags, {arguments.terms} terms")
    print(f"{'':6}{'amb: s':>10}{'one step':>10}{'free run':>10}"
          f"{'SysIdentPy: s':>16}{'one step':>10}{'free run':>10}   (fit in %)")
    for n, axis in enumerate(AXES):
        own = min(ours(arguments.amb, arguments.data, axis, arguments) for _ in range(2))
        peer = min(theirs(inputs, outputs[:, n], arguments) for _ in range(2))
        print(f"{axis:6}{own[0]:10.2f}{own[1]:10.2f}{own[2]:10.2f}"
              f"{peer[0]:16.2f}{peer[1]:10.2f}{peer[2]:10.2f}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
