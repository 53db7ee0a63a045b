#!/usr/bin/env python3
"""H-infinity synthesis, norm and structured singular value beside SLICOT, on the same plants.

Optional: nothing of the project needs it. slycot is built from source and wants gfortran, LAPACK's
development files and cmake.

    python3 -m venv peer && peer/bin/pip install slycot==0.7.1
    peer/bin/python benchmark/synthesis/slycot_peer.py build/release/bench/synthesis_cases

gamma     ours (the norm of our closed loop, by our norm) against the smallest that SB10AD reaches.
norm      of our closed loop, by AB13DD: must be ours.
mu        our bounds against the upper bound of AB13MD (real blocks 1 x 1, complex full blocks).
Exit status 1 when a gamma is more than 1 % or a mu bound more than 2 % above SLICOT's.
"""

import json
import math
import subprocess
import sys

import numpy as np
import slycot

GAMMA_SHARE, NORM_SHARE, MU_SHARE = 0.01, 0.001, 0.02


def matrices(case):
    """Empty matrices keep their shape through the length of D."""
    d = np.array(case["D"], dtype=float)
    a = np.array(case["A"], dtype=float).reshape(len(case["A"]), len(case["A"]))
    b = np.array(case["B"], dtype=float).reshape(len(a), d.shape[1])
    c = np.array(case["C"], dtype=float).reshape(d.shape[0], len(a))
    return a, b, c, d


def closed_loop(plant, controller, controls, measurements):
    """Lower linear fractional transformation, written here so that it is not ours."""
    a, b, c, d = plant
    ak, bk, ck, dk = controller
    b1, b2 = np.hsplit(b, [b.shape[1] - controls])
    c1, c2 = np.vsplit(c, [c.shape[0] - measurements])
    d1, d2 = np.vsplit(d, [d.shape[0] - measurements])
    d11, d12 = np.hsplit(d1, [d.shape[1] - controls])
    d21, d22 = np.hsplit(d2, [d.shape[1] - controls])
    q = np.linalg.inv(np.eye(controls) - dk @ d22)
    s = np.linalg.inv(np.eye(measurements) - d22 @ dk)
    return (np.block([[a + b2 @ q @ dk @ c2, b2 @ q @ ck], [bk @ s @ c2, ak + bk @ s @ d22 @ ck]]),
            np.vstack([b1 + b2 @ q @ dk @ d21, bk @ s @ d21]),
            np.hstack([c1 + d12 @ q @ dk @ c2, d12 @ q @ ck]), d11 + d12 @ q @ dk @ d21)


def norm_of(system):
    a, b, c, d = system
    if np.linalg.eigvals(a).real.max() >= 0.0:
        return math.inf
    return slycot.ab13dd("C", "I", "S", "D", len(a), b.shape[1], c.shape[0], a, np.eye(len(a)), b, c,
                         d, 1e-9)[0]


def smallest_gamma(plant, controls, measurements, start):
    """SB10AD's gamma, or None: it gives up on some plants, and its loop is checked as ours is."""
    a, b, c, d = (m.copy() for m in plant)
    try:
        answer = slycot.sb10ad(len(a), b.shape[1], c.shape[0], controls, measurements, start,
                               a, b, c, d, job=1, gtol=1e-5)
    except Exception as error:  # slycot raises one class per SLICOT status
        return None, f"SB10AD: {str(error).strip().splitlines()[-1].strip()}"
    norm = norm_of(answer[5:9])
    if not norm <= answer[0] * (1.0 + 1e-3):
        return None, f"SB10AD's loop has the norm {norm:.4g}, not its gamma {answer[0]:.4g}"
    return answer[0], ""


def compare_plants(cases):
    failed = 0
    print(f"{'plant':<28}{'gamma':>10}{'SB10AD':>10}{'ratio':>9}{'AB13DD of our loop':>20}")
    for case in cases:
        plant = matrices(case["plant"])
        numbers = case["controls"], case["measurements"]
        norm = norm_of(closed_loop(plant, matrices(case["controller"]), *numbers))
        gamma, why = smallest_gamma(plant, *numbers, 1.5 * case["gamma"])
        ratio = case["gamma"] / gamma if gamma else math.nan
        bad = abs(norm / case["gamma"] - 1.0) > NORM_SHARE or ratio > 1.0 + GAMMA_SHARE
        failed += bad
        there = f"{gamma:10.5g}" if gamma else f"{'-':>10}"
        print(f"{case['name']:<28}{case['gamma']:10.5g}{there}{ratio:9.4f}{norm:20.6g}"
              f"{'  FAILED' if bad else ''}  {why}")
    return failed


def compare_mu(cases):
    failed = 0
    print(f"\n{'blocks':<34}{'lower':>10}{'upper':>10}{'AB13MD':>10}{'upper/AB13MD':>14}")
    for case in cases:
        matrix = np.array(case["real"]) + 1j * np.array(case["imaginary"])
        bound = slycot.ab13md(matrix, np.array(case["sizes"]), np.array(case["types"]))[0]
        ratio = case["upper"] / bound
        bad = ratio > 1.0 + MU_SHARE or case["lower"] > bound * (1.0 + 1e-6)
        failed += bad
        blocks = " ".join(f"{'real' if kind == 1 else size}"
                          for size, kind in zip(case["sizes"], case["types"]))
        print(f"{blocks:<34}{case['lower']:10.5g}{case['upper']:10.5g}{bound:10.5g}{ratio:14.4f}"
              f"{'  FAILED' if bad else ''}")
    return failed


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    cases = json.loads(subprocess.run(sys.argv[1:], check=True, capture_output=True).stdout)
    failed = compare_plants(cases["plants"]) + compare_mu(cases["mu"])
    print(f"\n{len(cases['plants'])} plants, {len(cases['mu'])} matrices, {failed} outside")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
