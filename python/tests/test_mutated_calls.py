"""Whatever a call is given, an answer or one clear exception comes back: 500 calls, each with one or two arguments put wrong."""

import random
import warnings

import numpy as np
import pytest
import squirmers

CALLS = 500


class Odd:
    """An object that is nothing that anybody expects, and raises when it is looked at."""

    def __len__(self):
        raise RuntimeError("no length")

    def __iter__(self):
        raise RuntimeError("no items")

    def __float__(self):
        raise RuntimeError("no number")


def closed_file():
    with open(__file__) as file:
        return file


def raises_midway(gaps):
    if len(np.atleast_1d(gaps)) and np.min(gaps) < 0.05:
        raise ZeroDivisionError("no answer near contact")
    return {"X11A": 1 / np.asarray(gaps)}


WRONG = [
    None,
    True,
    -1,
    0,
    10**400,
    2**63,
    float("nan"),
    float("inf"),
    -float("inf"),
    -0.0,
    1e-320,
    1e308,
    1j,
    "",
    "exat",
    "lt ",
    "a\0b",
    "\udcff",
    "9" * 3000,
    b"bytes",
    [],
    [[]],
    [None],
    ["x"],
    [1, [2, 3]],
    [float("nan")] * 3,
    np.array([]),
    np.zeros((3, 4, 5)),
    np.array([1 + 2j]),
    np.array(["2020-01-01"], dtype="datetime64[D]"),
    np.array([object()], dtype=object),
    np.ma.masked_all(3),
    {},
    {"unknown": 1.0},
    {1: 2},
    {"dx": []},
    {"dx": [float("nan")]},
    set(),
    range(3),
    object(),
    Odd(),
    print,
    len,
    raises_midway,
    closed_file(),
    lambda gaps: None,
    lambda gaps: {"X11A": np.ones(2)},
    lambda gaps: {"X13A": np.ones_like(gaps)},
    squirmers.Squirmer,
    squirmers.Squirmer(1.0),
    squirmers.Model("lt"),
]

SCENE = squirmers.Scene.of("opposed", beta=1.0, dx=1.0)
OUTSIDE = squirmers.loads("exact", np.geomspace(0.01, 100, 30))

#: Functions, and arguments with which they work and take a moment.
GOOD = [
    (squirmers.Squirmer, {"beta": 1.0, "speed": 1.0, "swirl_modes": [0.0, 1.0], "radius": 0.5, "bottom_heaviness": 1.0}),
    (squirmers.Squirmer, {"modes": [1.5, 1.0], "radius": 2.0}),
    (
        squirmers.Scene,
        {
            "squirmers": (squirmers.Squirmer(1.0),) * 2,
            "positions": [(0, 0), (4, 1)],
            "angles_deg": (0, 90),
            "repulsion": (10, 100),
            "gravity": (0, -1, 0),
        },
    ),
    (squirmers.Scene, {"squirmers": squirmers.Squirmer(1.0), "positions": [(0, 0, 0), (4, 1, 1)], "orientations": [(1, 0, 0), (0, 1, 1)]}),
    (squirmers.Model, {"name": "bem", "level": 1, "direct": True, "cache": None}),
    (squirmers.loads, {"model": "lt", "gaps": [0.1, 1.0], "modes": 2, "swirl_modes": 1, "ratio": 0.5, "progress": False}),
    (squirmers.mobility, {"model": "lt", "gaps": [0.1, 1.0], "modes": 2, "swirl_modes": 1, "ratio": 0.5}),
    (
        squirmers.run,
        {
            "scene": SCENE,
            "model": "lt",
            "end_time": 20.0,
            "tolerance": 1e-7,
            "sample_interval": 0.5,
            "samples": True,
            "departure_distance": 12.0,
            "angles_at": 20.0,
            "max_steps": 10_000,
        },
    ),
    (
        squirmers.sweep,
        {
            "family": "opposed",
            "axes": {"dx": [1.0, 2.0]},
            "models": "lt",
            "out": None,
            "partition": "1/2",
            "tolerance": 1e-6,
            "angles_at": 12.0,
            "time_limit": None,
            "fresh": True,
            "progress": False,
        },
    ),
    (squirmers.scatter, {"beta": 1.0, "models": "lt", "g": 0.0, "grid": 3, "out": None, "tolerance": 1e-6, "angles_at": 12.0, "time_limit": None}),
    (squirmers.fates, {"beta": [1.0], "models": "lt", "g": 0.0, "grid": 3, "out": None}),
    (squirmers.bound_states, {"models": "lt", "beta": 1.0}),
    (squirmers.sensitivity, {"family": "opposed", "axes": {"dx": [1.0]}, "models": "lt", "out": None, "tolerance": 1e-8}),
    (squirmers.kinetics, {"beta": 1.0, "models": ["lt"], "impact": 3.0, "count": 4, "replications": 2, "out": None, "tolerance": 1e-6}),
    (squirmers.flow, {"scene": SCENE, "points": [(3.0, 0.0, 0.0)], "model": "exact", "time": 0.5, "gap": None, "progress": False}),
    (squirmers.stresslet, {"scene": SCENE, "model": "exact", "time": 0.5}),
    (squirmers.stresses, {"model": "exact", "gaps": [0.5], "modes": 2, "swirl_modes": 0, "ratio": 1.0}),
    (
        squirmers.Model.from_callable,
        {
            "f": lambda gaps: {"X11A": 1 / gaps},
            "name": "mine",
            "range": (0.01, 100),
            "noise": 1e-6,
            "matrix": None,
            "version": "1",
            "radius": 1.0,
            "viscosity": 1.0,
            "mode_units": [1.0],
            "slip_calibration": [1.0],
        },
    ),
    (squirmers.Model.from_table, {"table": OUTSIDE, "name": "mine", "interpolation": "log-cubic", "radius": 1.0, "mode_units": [1.0]}),
    (squirmers.judge, {"model": squirmers.Model.from_table(OUTSIDE, name="table"), "grid": 0, "gaps": None, "progress": False}),
    (squirmers.reference, {"version": None}),
]



def judged(model):
    """A judgement without collisions, at a few gaps."""
    return squirmers.judge(model, grid=0, gaps=[0.02, 0.1, 1.0], progress=False)


#: Arguments by position.
PLACED = [
    (squirmers.Scene.of, ["opposed"]),
    (squirmers.Scene.from_toml, ["[parameters]\nx = 1"]),
    (squirmers.set_threads, [10**6]),
    (OUTSIDE.__getitem__, ["X11A"]),
    (OUTSIDE.to_csv, [""]),
    (squirmers.merge, [["share"], None]),
    (squirmers.Model.from_file, ["file.csv"]),
    (lambda f: judged(squirmers.Model.from_callable(f, name="placed", range=(0.01, 100))), [lambda gaps: {"X11A": 1 / gaps}]),
]


def clear(error):
    """Whether an exception says something to a person."""
    expected = (squirmers.SquirmersError, TypeError, ValueError, OverflowError, KeyError, OSError, RuntimeError)
    if isinstance(error, ZeroDivisionError):
        return str(error) == "no answer near contact"
    # Since Python 3.11 a note says which argument it is.
    text = " ".join([str(error), *getattr(error, "__notes__", [])])
    return isinstance(error, expected) and text and "panicked" not in text and len(text) < 5000


def mutated(choice):
    """A call with something put wrong."""
    if choice.random() < 0.12:
        function, placed = choice.choice(PLACED)
        placed = list(placed)
        placed[choice.randrange(len(placed))] = choice.choice(WRONG)
        return function, placed, {}
    function, named = choice.choice(GOOD)
    named = dict(named)
    for _ in range(choice.choice((1, 1, 2))):
        named[choice.choice(list(named))] = choice.choice(WRONG)
    if choice.random() < 0.05:
        named["unknown"] = 1
    return function, [], named


def test_good_calls_work():
    for function, named in GOOD:
        assert function(**named) is not None


@pytest.mark.filterwarnings("ignore")
def test_mutated_calls_answer_or_raise_one_clear_exception(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    choice = random.Random(24)
    refused, functions = 0, set()
    for number in range(CALLS):
        function, placed, named = mutated(choice)
        functions.add(getattr(function, "__name__", str(function)))
        call = f"call {number}: {function} {str(placed)[:200]} {str(named)[:400]}"
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                function(*placed, **named)
        except Exception as error:
            assert clear(error), f"{call}: {type(error)} {str(error)[:300]}"
            refused += 1
        except BaseException as error:
            pytest.fail(f"{call}: {type(error)} {error}")
    assert refused > CALLS // 2 and len(functions) >= len({function for function, _ in GOOD})
