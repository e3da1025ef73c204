"""Collisions of two squirmers under lubrication theory as published, by heyoka: Taylor series, compiled when it runs.

The same equations and variables as in bench/scipy/lubrication.py. The sums over the modes and the two small linear
systems are worked out by hand: the fewer operations, the faster heyoka is.
"""

import csv
import json
import math
import os
import pathlib
import platform
import re
import subprocess
import tempfile
import time

import heyoka
import numpy

KAPPA1, KAPPA2 = 10.0, 100.0
TOLERANCE = 1e-8
END_TIME = 200.0
# heyoka overlooks the parting within the first step if the start is a root of the event too: begin a rounding inside.
TOUCHING = -(2.0**-53)
STATE = heyoka.make_vars("x", "y", "theta", "ln_gap", "a1", "a2")
THETA, LN_GAP, A1, A2 = 2, 3, 4, 5
# What a step returns when the first terminal event stops it.
PARTED = -1
SIDE = 100
SMALL_SIDE = 2
COLLISIONS = 5000
MAPS = 5
ROOT = pathlib.Path(__file__).resolve().parents[2]


def right_hand_side(beta):
    """Rates of STATE as expressions."""
    _, _, theta, ln_gap, a1, a2 = STATE
    b1, b2 = 1.5, 1.5 * beta
    eps, log = heyoka.exp(ln_gap), -ln_gap
    c1, s1, c2, s2 = heyoka.cos(a1), heyoka.sin(a1), heyoka.cos(a2), -heyoka.sin(a2)
    # Slip near the contact: what multiplies the logarithms.
    along = b1 * (c1 + c2) + b2 * (1.5 * (c1 * c1 + c2 * c2) - 1.0)
    across1, across2 = s1 * (b1 + b2 * c1), s2 * (b1 + b2 * c2)
    decay = heyoka.exp(-KAPPA2 * eps)
    repulsion = KAPPA1 * KAPPA2 / math.pi * decay / (1.0 - decay)
    axial_difference = 4.0 * b1 * (c1 + c2) + 4.5 * log * along - 2.0 * repulsion
    # 6 eps (1 + 2 (1/(4 eps) + 9/40 log)), which stays finite.
    opening = -axial_difference / (3.0 + 6.0 * eps * (1.0 + 0.45 * log))
    # [6a, -4b; -4b, 8c] (difference, spin_sum) = (thrust + slip, slip) with a = 1 + log/3, b = -log/2, c = 1 + log/4:
    # the squares of log cancel in its determinant.
    thrust = 4.0 * b1 * (s1 - s2)
    slip = 2.0 * log * (across1 - across2)
    determinant = 48.0 + 28.0 * log
    difference = ((8.0 + 2.0 * log) * thrust + 8.0 * slip) / determinant
    spin_sum = (6.0 * slip - 2.0 * log * thrust) / determinant
    # 8 (1 + 0.15 log) spin_difference = 1.2 log (across1 + across2).
    spin_difference = 1.2 * log * (across1 + across2) / (8.0 + 1.2 * log)
    turning = -difference / (2.0 + eps)
    axial, across = b1 / 3.0 * (c1 - c2), b1 / 3.0 * (s1 + s2)
    sin, cos = heyoka.sin(theta), heyoka.cos(theta)
    rates = (
        axial * cos - across * sin,
        axial * sin + across * cos,
        turning,
        opening,
        0.5 * (spin_sum + spin_difference) - turning,
        0.5 * (spin_sum - spin_difference) - turning,
    )
    return list(zip(STATE, rates))


def integrator(beta, lanes=None):
    """An integrator that stops where the pair parts: of one pair, or of a pair in each lane."""
    options = {"tol": TOLERANCE, "fast_math": True}
    when = {"direction": heyoka.event_direction.positive}
    if lanes is None:
        parting = heyoka.t_event(STATE[LN_GAP], **when)
        return heyoka.taylor_adaptive(right_hand_side(beta), numpy.zeros(6), t_events=[parting], **options)
    parting = heyoka.t_event_batch(STATE[LN_GAP], **when)
    return heyoka.taylor_adaptive_batch(right_hand_side(beta), numpy.zeros((6, lanes)), t_events=[parting], **options)


def deflections(start, end):
    """Outgoing minus incoming angles of both, in degrees."""
    turned = numpy.subtract(end, start)
    return numpy.degrees((turned[THETA] + turned[A1], turned[THETA] + turned[A2]))


def contact(dx):
    """State when the straight paths of Fig. 6 first come within the gap 1."""
    theta = math.atan2(-math.sqrt(9.0 - dx * dx), dx)
    incoming = -0.5 * math.pi
    return [0.0, 0.0, theta, TOUCHING, incoming - theta, -incoming - theta - math.pi]


def collision(pair, dx):
    """Least seconds of COLLISIONS collisions, the deflection of the first squirmer, and the steps."""
    start = contact(dx)
    best = math.inf
    for _ in range(COLLISIONS):
        pair.time = 0.0
        pair.state[:] = start
        pair.reset_cooldowns()
        began = time.perf_counter()
        outcome, _, _, steps, *_ = pair.propagate_until(END_TIME)
        best = min(best, time.perf_counter() - began)
        assert int(outcome) == PARTED, outcome
    return best, deflections(start, pair.state)[0], steps


def starts():
    """States of fixtures/families/incoming-angles.toml, by (delta, sigma), in the order of scatter.csv.

    All begin at the gap 1, so that the flight before it has no length. Those that open there never meet.
    """
    values = [round(0.01 + 1.98 / (SIDE - 1) * i, 12) for i in range(SIDE)]
    found = {}
    for sigma in values:
        for delta in values:
            a1, a2 = 0.5 * math.pi * (sigma - delta), 0.5 * math.pi * (sigma + delta) - math.pi
            if math.cos(a1) + math.cos(a2) > 0.0:
                found[delta, sigma] = [0.0, 0.0, 0.0, TOUCHING, a1, a2]
    return found


class Map:
    """Every start once through the lanes of a batch: a lane whose pair has ended takes the next start at once.

    When no start is left, lanes take the first ones again, so that all are busy to the end; those do not count.
    `ends` has the states of those that parted, `steps` counts their steps.
    """

    def __init__(self, batch, states):
        lanes = batch.batch_size
        self.ends, self.steps, self.not_finite, self.late, self.calls, self.stepping = {}, 0, 0, 0, 0, 0.0
        began_map = time.perf_counter()
        times, taken = numpy.zeros(lanes), lanes
        pair, began = list(range(lanes)), [0] * lanes
        batch.state[:] = numpy.transpose([states[i % len(states)] for i in pair])
        batch.set_time(times)
        batch.reset_cooldowns()
        left = len(states)
        while left > 0:
            began_step = time.perf_counter()
            batch.step()
            self.stepping += time.perf_counter() - began_step
            self.calls += 1
            late = batch.time.max() > END_TIME
            for lane, (outcome, _) in enumerate(batch.step_res):
                going = outcome == heyoka.taylor_outcome.success
                if going and not (late and batch.time[lane] > END_TIME):
                    continue
                if pair[lane] < len(states):
                    left -= 1
                    if int(outcome) == PARTED:
                        self.ends[pair[lane]] = batch.state[:, lane].copy()
                        self.steps += self.calls - began[lane]
                    elif going:
                        self.late += 1
                    else:
                        self.not_finite += 1
                pair[lane], began[lane] = taken, self.calls
                batch.state[:, lane] = states[taken % len(states)]
                taken += 1
                times = batch.time.copy()
                times[lane] = 0.0
                batch.set_time(times)
                batch.reset_cooldowns(lane)
        self.seconds = time.perf_counter() - began_map


def build():
    """The built program; the example too is ready then."""
    build_example = ["cargo", "build", "--quiet", "--release", "-p", "squirmers-lt", "--example", "collision"]
    subprocess.run(build_example, cwd=ROOT, check=True)
    build_program = ["cargo", "build", "--quiet", "--release", "--message-format=json", "--bin", "squirmers"]
    printed = subprocess.run(build_program, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    artifacts = [json.loads(line) for line in printed.splitlines()]
    return next(found["executable"] for found in artifacts if found.get("executable"))


def compiled_collisions():
    """Least seconds and deflection of the same collisions by lt/examples/collision.rs, by dx."""
    command = ["cargo", "run", "--quiet", "--release", "-p", "squirmers-lt", "--example", "collision"]
    printed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    found = re.findall(r"dx (\S+): (\S+) us.*deflection (\S+) degrees", printed)
    return {float(dx): (1e-6 * float(us), float(degrees)) for dx, us, degrees in found}


def compiled_map(program, side):
    """Seconds of the map by `squirmers scatter`, from start to exit, and its rows."""
    with tempfile.TemporaryDirectory() as folder:
        what = f"scatter --beta 0 --method lt --tol {TOLERANCE} --threads 1 --grid {side}"
        command = [program, *what.split(), "--out", folder]
        began = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        seconds = time.perf_counter() - began
        with open(pathlib.Path(folder) / "scatter.csv", newline="", encoding="utf-8") as file:
            return seconds, list(csv.DictReader(file))


def collisions():
    """The collisions of Fig. 6, beta = 5."""
    pair = integrator(5.0)
    print(f"Fig. 6, beta = 5, one pair at a time, order {pair.order}:")
    for dx in (1.0, 2.0):
        # What else the machine does changes: each has its best on both sides of the other's.
        before, compiled = collision(pair, dx), compiled_collisions()[dx]
        after, again = collision(pair, dx), compiled_collisions()[dx]
        best, ours = min(before[0], after[0]), min(compiled[0], again[0])
        _, deflection, steps = after
        print(
            f"dx {dx:g}: {1e6 * best:.2f} us, {steps} steps, deflection {deflection:.5f} degrees; "
            f"lt {1e6 * ours:.2f} us, deflection {compiled[1]:.5f} degrees: {best / ours:.2f} times"
        )


def compare(rows, starts_by_angles, ends):
    """Largest difference of a deflection from `rows`, and how many pairs parted in both."""
    largest, compared = 0.0, 0
    by_angles = {(float(row["delta"]), float(row["sigma"])): row for row in rows if row["outcome"] == "scattered"}
    for i, (angles, start) in enumerate(starts_by_angles.items()):
        if i in ends and angles in by_angles:
            row = by_angles[angles]
            theirs = [float(row["deflection1_deg"]), float(row["deflection2_deg"])]
            largest = max(largest, abs(deflections(start, ends[i]) - theirs).max())
            compared += 1
    return largest, compared


def maps(program):
    """The map of the incoming angles, beta = 0."""
    lanes = heyoka.recommended_simd_size()
    batch = integrator(0.0, lanes)
    starts_by_angles = starts()
    states = list(starts_by_angles.values())
    stepping = seconds = ours = ours_small = math.inf
    for _ in range(MAPS):
        found = Map(batch, states)
        stepping, seconds = min(stepping, found.stepping), min(seconds, found.seconds)
        once, rows = compiled_map(program, SIDE)
        ours, ours_small = min(ours, once), min(ours_small, compiled_map(program, SMALL_SIDE)[0])
    parted = len(found.ends)
    largest, compared = compare(rows, starts_by_angles, found.ends)
    lane_step, steps = stepping / (found.calls * lanes), found.steps / parted
    price, ours_price = lane_step * steps, (ours - ours_small) / (SIDE**2 - SMALL_SIDE**2)
    print(f"\nMap of {SIDE} x {SIDE} incoming angles, beta = 0, {lanes} lanes, order {batch.order}, best of {MAPS}:")
    print(
        f"{len(states)} of {SIDE**2} pairs meet; {parted} parted, {found.late} had not by {END_TIME:g}, "
        f"{found.not_finite} not finite"
    )
    print(f"{found.steps} steps of those that parted, {steps:.2f} each")
    print(
        f"{1e6 * lane_step:.4f} us a lane's step: {1e3 * stepping:.2f} ms within step() / "
        f"({found.calls} calls x {lanes} lanes)"
    )
    print(f"{1e6 * price:.2f} us a trajectory with every lane busy: {1e6 * lane_step:.4f} us x {steps:.2f} steps")
    print(
        f"{1e6 * seconds / len(states):.2f} us a trajectory with the refilling, in Python: "
        f"{1e3 * seconds:.1f} ms / {len(states)}"
    )
    print(
        f"{1e6 * ours_price:.2f} us a trajectory by squirmers: ({1e3 * ours:.1f} ms of scatter --grid {SIDE} - "
        f"{1e3 * ours_small:.1f} ms of --grid {SMALL_SIDE}) / ({SIDE**2} - {SMALL_SIDE**2})"
    )
    print(f"squirmers takes {ours_price / price:.2f} times as long as heyoka with every lane busy")
    print(f"largest difference of a deflection: {largest:.1e} degrees, of {compared} pairs")


def main():
    program = build()
    if hasattr(os, "sched_setaffinity"):
        # One core, for the programs that this one starts too.
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    print(f"heyoka {heyoka.__version__}, numpy {numpy.__version__}, python {platform.python_version()}")
    collisions()
    maps(program)


if __name__ == "__main__":
    main()
