"""Collisions of two squirmers (Fig. 6, beta = 5) under lubrication theory as published, by SciPy.

Variables: angle of the line of centres, ln of the gap, and each orientation's angle measured from the
direction to the other sphere, as in scene/src/motion/coordinates.rs; the midpoint follows too, so that
the work is the same. Loads and balance: DESIGN of the crate `scene`, modules `loads` and `balance`.
"""

import math
import pathlib
import platform
import re
import subprocess
import time

import numpy
import scipy
from scipy.integrate import solve_ivp

BETA = 5.0
B = (1.5, 1.5 * BETA)
KAPPA1, KAPPA2 = 10.0, 100.0
AXIAL_SQUIRMING = 9.0 / 4.0
TOLERANCE = 1e-8
REPEATS = 20


def solve(a, b, c, force, torque):
    """(U, w) of [6a, -4b; -4b, 8c] (U, w) = (force, torque)."""
    inverse = 1.0 / (48.0 * a * c - 16.0 * b * b)
    return (force * 8.0 * c + torque * 4.0 * b) * inverse, (force * 4.0 * b + torque * 6.0 * a) * inverse


def right_hand_side(_t, y):
    _, _, theta, ln_gap, a1, a2 = y
    eps, log = math.exp(ln_gap), -ln_gap
    # Loads as (sum, difference) of those on the sphere itself and on the other one.
    xa = (1.0, 1.0 + 2.0 * (0.25 / eps + 9.0 / 40.0 * log))
    ya = (1.0, 1.0 + log / 3.0)
    yb = (0.0, -0.5 * log)
    yc = (1.0 + 0.25 * log, 1.0 + 0.15 * log)
    thrust = (4.0, 0.0)
    c1, s1, c2, s2 = math.cos(a1), math.sin(a1), math.cos(a2), -math.sin(a2)
    axial_sum = axial_difference = 0.0
    force = [0.0] * 4
    legendre = (((c1, 1.0), (c2, 1.0)), ((1.5 * c1 * c1 - 0.5, c1), (1.5 * c2 * c2 - 0.5, c2)))
    for strength, isolated, ((p1, w1), (p2, w2)) in zip(B, thrust, legendre):
        xf = (isolated, isolated + 2.0 * AXIAL_SQUIRMING * log)
        yf = (isolated, isolated + 2.0 * log)
        yt = (2.0 * log, 1.2 * log)
        axial_sum += strength * (p1 - p2) * xf[0]
        axial_difference += strength * (p1 + p2) * xf[1]
        one, two = strength * w1 * s1, strength * w2 * s2
        force[0] += (one + two) * yf[0]
        force[1] += (one - two) * yf[1]
        force[2] += (one - two) * yt[0]
        force[3] += (one + two) * yt[1]
    repulsion = KAPPA1 * KAPPA2 / math.pi / math.expm1(KAPPA2 * eps)
    axial_difference -= 2.0 * repulsion
    total, spin_difference = solve(ya[0], yb[0], yc[1], force[0], force[3])
    difference, spin_sum = solve(ya[1], yb[1], yc[0], force[1], force[2])
    opening = -axial_difference / (6.0 * xa[1] * eps)
    axial, across = axial_sum / (12.0 * xa[0]), 0.5 * total
    turning = -difference / (2.0 + eps)
    sin, cos = math.sin(theta), math.cos(theta)
    return (
        axial * cos - across * sin,
        axial * sin + across * cos,
        turning,
        opening,
        0.5 * (spin_sum + spin_difference) - turning,
        0.5 * (spin_sum - spin_difference) - turning,
    )


def parting(_t, y):
    return y[3]


parting.terminal = True
parting.direction = 1.0


def contact(dx):
    """State when the straight paths first come within the gap 1, and the incoming angle."""
    half = math.sqrt(9.0 - dx * dx)
    line = (dx, -half)
    theta = math.atan2(line[1], line[0])
    incoming = -0.5 * math.pi
    return [0.0, 0.0, theta, 0.0, incoming - theta, -incoming - theta - math.pi], incoming


def best_of(dx):
    """Least seconds of REPEATS collisions, and the last solution."""
    start, _ = contact(dx)
    best = math.inf
    for _ in range(REPEATS):
        began = time.perf_counter()
        found = solve_ivp(
            right_hand_side, (0.0, 200.0), start, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE, events=parting
        )
        best = min(best, time.perf_counter() - began)
    return best, found


def compiled():
    """Least seconds of the same collisions by lt/examples/collision.rs, by dx."""
    command = ["cargo", "run", "--quiet", "--release", "-p", "squirmers-lt", "--example", "collision"]
    root = pathlib.Path(__file__).resolve().parents[2]
    printed = subprocess.run(command, cwd=root, check=True, capture_output=True, text=True).stdout
    return {float(dx): 1e-6 * float(us) for dx, us in re.findall(r"dx (\S+): (\S+) us", printed)}


def main():
    print(f"numpy {numpy.__version__}, scipy {scipy.__version__}, python {platform.python_version()}")
    compiled()  # builds
    for dx in (1.0, 2.0):
        # What else the machine does changes: each has its best on both sides of the other's.
        before, ours, (after, found), again = best_of(dx)[0], compiled()[dx], best_of(dx), compiled()[dx]
        best, ours = min(before, after), min(ours, again)
        incoming = contact(dx)[1]
        theta, a1 = found.y[2, -1], found.y[4, -1]
        deflection = math.degrees(theta + a1 - incoming)
        print(
            f"dx {dx:g}: {1e3 * best:.3f} ms, {found.nfev} right-hand sides, deflection {deflection:.5f} degrees; "
            f"lt {1e6 * ours:.2f} us: {best / ours:.0f} times"
        )


if __name__ == "__main__":
    main()
