"""Anybody's models: asked, judged, and moving pairs as their numbers say; and the reference numbers."""

import hashlib
import json
import pickle
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
import squirmers

ROOT = Path(__file__).resolve().parents[2]
GAPS = np.array([0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 4, 10, 38, 100])


def named(gaps, modes=2):
    """Exact loads by name."""
    table = squirmers.loads("exact", gaps, modes=modes)
    return {name: table[name].copy() for name in table.names if name != "gap"}


class Counting:
    """Exact loads, changed, and how often they were asked for."""

    def __init__(self, change=None):
        self.change, self.calls, self.gaps, self.threads = change, 0, [], set()
        self.most = 0

    def __call__(self, gaps):
        self.calls += 1
        self.gaps.extend(gaps.tolist())
        self.most = max(self.most, len(gaps))
        self.threads.add(threading.get_ident())
        said = named(gaps)
        if self.change is not None:
            self.change(gaps, said)
        return said


@pytest.fixture(scope="module")
def exact():
    f = Counting()
    return f, squirmers.Model.from_callable(f, name="copy", range=(1e-3, 1e3))


def test_val_a_copy_of_exact_loads_is_faultless_and_moves_pairs_as_exact_loads_do(exact):
    f, model = exact
    card = squirmers.judge(model, grid=4)
    assert card.faultless and card.faults == []
    assert any(sentence.startswith("No fault found in what it gives") for sentence in card.verdict)
    assert card.trusted_down_to == {1: 0.001, 5: 0.001, 20: 0.001}
    assert card.score < 1e-9
    # Each gap once, many gaps a call, never by this thread.
    assert len(f.gaps) == len(set(f.gaps)) and f.calls < 20 and f.most >= 20
    assert threading.get_ident() not in f.threads
    calls = f.calls
    for name, parameters in (("opposed", {"beta": 5.0, "dx": 1.0}), ("right-angles", {"beta": 1.0, "dx": 1.0})):
        scene = squirmers.Scene.of(name, **parameters)
        found, truth = (squirmers.run(scene, of, angles_at=12.0) for of in (model, "exact"))
        assert found.outcome == truth.outcome
        assert found.deflections_deg == pytest.approx(truth.deflections_deg, abs=1e-3)
    assert f.calls <= calls + 15, "the tables hold what was said"


def wrong_sign(gaps, said):
    said["Y11B"] *= -1
    said["Y12B"] *= -1


def wrong_factor(gaps, said):
    for name in ("XF1_2", "XF2_2"):
        said[name] *= 9 / 4


@pytest.mark.parametrize("change", [wrong_sign, wrong_factor])
def test_val_broken_copies_get_the_verdict_that_their_file_gets(change, tmp_path):
    model = squirmers.Model.from_callable(Counting(change), name="broken", range=(1e-3, 1e3))
    asked = squirmers.judge(model, grid=0, gaps=GAPS)
    said = named(GAPS)
    change(GAPS, said)
    lines = [f"{gap!r},{name},{values[k]!r}" for k, gap in enumerate(GAPS.tolist()) for name, values in said.items()]
    path = tmp_path / "broken.csv"
    path.write_text("gap,name,value\n" + "\n".join(lines).replace("np.float64(", "").replace(")", ""))
    filed = squirmers.judge(squirmers.Model.from_file(path), grid=0)
    assert not asked.faultless and asked.faults == filed.faults
    # A file is told that it does not say how it is interpolated.
    assert asked.verdict == [line for line in filed.verdict if not line.startswith("Between its gaps")]
    kinds = {wrong_sign: "wrong sign", wrong_factor: "wrong factor"}
    assert {fault["kind"] for fault in asked.faults} == {kinds[change]}
    if change is wrong_factor:
        assert asked.faults[0]["number"] == pytest.approx(9 / 4)


def test_a_table_is_the_file_of_its_numbers_bit_for_bit(tmp_path):
    pandas = pytest.importorskip("pandas")
    said = named(GAPS)
    header = {"model": "mine", "version": "1", "interpolation": "log-cubic", "mode_units": [2.0, 0.5], "slip_calibration": [0.9, 1.1]}
    lines = [f"#! {key} = {json.dumps(value)}" for key, value in header.items()] + ["gap,name,value"]
    for k in reversed(range(len(GAPS))):
        lines += [f"{float(GAPS[k])!r},{name},{float(values[k])!r}" for name, values in said.items()]
    path = tmp_path / "mine.csv"
    path.write_text("\n".join(lines))
    wide = {"gap": GAPS, **said}
    frame = pandas.DataFrame(wide)
    structured = np.rec.fromarrays(list(wide.values()), names=list(wide))
    cards, loads = [], []
    for model in [
        squirmers.Model.from_file(path),
        squirmers.Model.from_table(wide, name="mine", **header),
        squirmers.Model.from_table(frame.iloc[::-1], name="mine", **header),
        squirmers.Model.from_table(structured, name="mine", **header),
    ]:
        cards.append(squirmers.judge(model, grid=0))
        loads.append(squirmers.loads(model, [0.013, 0.4, 7.0]))
        assert model.name == "mine"

    def lasting(card):
        return [line for line in card.rows.csv.splitlines() if "seconds" not in line and "time" not in line]

    for card, found in zip(cards[1:], loads[1:], strict=True):
        assert lasting(card) == lasting(cards[0]) and card.verdict == cards[0].verdict and card.errors == cards[0].errors
        assert found.csv == loads[0].csv
    some = squirmers.Model.from_table({"gap": [0.1, 38.0], "X11A": [np.nan, 1.0001]}, name="some")
    assert list(squirmers.judge(some, grid=0).errors["gap"]) == [38.0]
    assert any("No collisions: too few gaps (2)" in line for line in squirmers.judge(some, grid=2).verdict)
    with pytest.raises(squirmers.InputError, match="model 'some' is not allowed: too few gaps"):
        squirmers.run(squirmers.Scene.of("opposed", beta=5.0, dx=1.0), some)


def stacks(gaps):
    """The mobility of two spheres that do not feel each other, with slip columns."""
    one = np.diag([1 / (6 * np.pi)] * 6 + [1 / (8 * np.pi)] * 6)
    swims = np.zeros(12)
    swims[2] = 2 / 3
    return {"matrix": np.repeat(one[None], len(gaps), axis=0), "B1_1z": np.repeat(swims[None], len(gaps), axis=0)}


def test_matrices_are_read_from_functions_and_tables():
    asked = squirmers.Model.from_callable(stacks, name="lone", matrix="mobility", range=(0.1, 100))
    table = {"gap": [38.0, 1.0], **stacks([38.0, 1.0])}
    tabled = squirmers.Model.from_table(table, name="lone", matrix="mobility", interpolation="none")
    verdicts = []
    for card in (squirmers.judge(asked, grid=0, gaps=[38.0, 1.0]), squirmers.judge(tabled, grid=0)):
        rows = {row["case"]: row["value"] for row in card.rows if row["measure"] == "error"}
        assert rows["x11a at gap 38"] == pytest.approx(0, abs=3e-3) and "UX1_1 at gap 1" in rows
        verdicts.append([line for line in card.verdict if line.startswith("Fault")])
    assert verdicts[0] == verdicts[1] != []
    bare = squirmers.Model.from_callable(lambda gaps: stacks(gaps)["matrix"], name="bare", matrix="mobility", range=(0.1, 100))
    assert not squirmers.judge(bare, grid=0).faultless


class Mine(Exception):
    pass


def raising(gaps):
    raise Mine("at my own line")


def midway(gaps):
    if gaps.min() < 0.1:
        raise Mine("too close")
    return named(gaps)


@pytest.mark.parametrize("f", [raising, midway])
def test_what_a_function_raises_comes_out_as_it_is(f):
    model = squirmers.Model.from_callable(f, name="raising", range=(1e-2, 1e3))
    scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
    for call in (
        lambda: squirmers.judge(model, grid=0),
        lambda: squirmers.judge(model, grid=2),
        lambda: squirmers.run(scene, model),
        lambda: squirmers.loads(model, [0.05, 1.0]),
        lambda: squirmers.mobility(model, [0.05]),
    ):
        with pytest.raises(Mine) as caught:
            call()
        assert caught.traceback[-1].name == f.__name__


@pytest.mark.parametrize(
    ("said", "message"),
    [
        (lambda gaps: None, "what its function returns, None, is not allowed: give a mapping"),
        (lambda gaps: "X11A", "what its function returns, 'X11A', is not allowed"),
        (lambda gaps: gaps, "is not allowed: give a mapping"),
        (lambda gaps: {"X11A": np.ones((len(gaps), 2))}, r"'X11A' of the shape \(\d+, 2\) is not allowed: give the shape \(\d+,\)"),
        (lambda gaps: {"X11A": np.ones(len(gaps) + 1)}, "of the shape"),
        (lambda gaps: {"X11A": ["one"] * len(gaps)}, "'X11A' .* is not allowed: give numbers"),
        (lambda gaps: {"X11A": None}, "'X11A' None is not allowed: give numbers"),
        (lambda gaps: {"X11A": 1j * gaps}, "give numbers"),
        (lambda gaps: {"X13A": gaps}, "there is no quantity 'X13A': names are X11A"),
        (lambda gaps: {1: gaps}, "name 1 is not allowed"),
        (lambda gaps: {"X11A": np.full(len(gaps), np.nan)}, "it has no answer at the gap|no number that can be judged"),
        (lambda gaps: {}, "no number that can be judged"),
        (lambda gaps: {"gap": 2 * gaps, "X11A": gaps}, "column gap .* is not allowed"),
        (stacks, "say what it is by matrix="),
    ],
)
def test_what_is_no_answer_is_refused_in_one_line(said, message):
    model = squirmers.Model.from_callable(said, name="wrong", range=(1e-2, 1e3))
    with pytest.raises(squirmers.InputError, match=message) as caught:
        squirmers.judge(model, grid=0)
    assert "\n" not in str(caught.value) and "wrong" in str(caught.value)
    with pytest.raises(squirmers.InputError) as caught:
        squirmers.run(squirmers.Scene.of("opposed", beta=5.0, dx=1.0), model)
    assert "\n" not in str(caught.value) and "wrong" in str(caught.value)


def test_arguments_that_are_not_allowed_are_refused_in_one_line():
    good = {"name": "good", "range": (1e-2, 1e3)}
    for change, message in [
        ({"name": "exact"}, "name 'exact' is not allowed: a model has this name already"),
        ({"name": "a b"}, "name 'a b' is not allowed"),
        ({"range": (2.0, 1.0)}, r"range \[2.0, 1.0\] is not allowed"),
        ({"noise": -1.0}, "noise -1.0 is not allowed"),
        ({"radius": float("nan")}, "radius NaN is not allowed"),
        ({"matrix": "grand"}, "matrix 'grand' is not allowed: give mobility, resistance"),
        ({"mode_units": [0.0]}, r"mode_units \[0.0\] is not allowed"),
    ]:
        with pytest.raises(squirmers.InputError, match=message):
            squirmers.Model.from_callable(named, **{**good, **change})
    with pytest.raises(squirmers.InputError, match="give a function"):
        squirmers.Model.from_callable(3, **good)
    with pytest.raises(squirmers.InputError, match="interpolation 'spline' is not allowed: give linear"):
        squirmers.Model.from_table({"gap": [1.0]}, interpolation="spline")
    for table, message in [
        ([1, 2], "give a mapping"),
        ({"X11A": [1.0]}, "one of them must be 'gap'"),
        ({"gap": [1.0, 1.0], "X11A": [1.0, 2.0]}, "the gap 1.0 is there twice"),
        ({"gap": [-1.0], "X11A": [1.0]}, "gap -1.0"),
        ({"gap": [1.0], "X11A": [np.inf]}, "at the gap 1.0: X11A is inf"),
        ({"gap": [], "X11A": []}, "no rows"),
    ]:
        with pytest.raises(squirmers.InputError, match=message):
            squirmers.Model.from_table(table)
    with pytest.raises(squirmers.FileError, match="cannot read"):
        squirmers.Model.from_file("/nowhere/at-all.csv")
    model = squirmers.Model.from_callable(named, **good)
    for arguments, message in [
        ({"gaps": [1e-3]}, "outside the model's range"),
        ({"gaps": []}, "give at least one"),
        ({"grid": 1}, "grid"),
    ]:
        with pytest.raises(squirmers.InputError, match=message):
            squirmers.judge(model, **{"grid": 0, **arguments})


def test_gaps_without_an_answer_are_left_out_of_the_verdict_and_said():
    def f(gaps):
        said = named(gaps)
        said["X11A"] = np.where(gaps < 0.015, np.nan, said["X11A"])
        return said

    model = squirmers.Model.from_callable(f, name="holes", range=(1e-2, 1e3))
    card = squirmers.judge(model, grid=0)
    assert card.faultless and card.errors["gap"].min() == 0.02
    assert any("no answer at 1 of the gaps" in line and "X11A is NaN" in line for line in card.verdict)
    assert any("No collisions: model 'holes': it has no answer at the gap" in line for line in squirmers.judge(model, grid=2).verdict)


def test_a_function_that_asks_its_own_model_is_refused_and_one_that_runs_another_is_not():
    held = []

    def itself(gaps):
        return squirmers.loads(held[0], gaps)

    held.append(squirmers.Model.from_callable(itself, name="itself", range=(0.5, 2)))
    with pytest.raises(squirmers.SquirmersError, match="must not ask its own model"):
        squirmers.judge(held[0], grid=0)

    inner = squirmers.Model.from_callable(named, name="inner", range=(1e-2, 1e3))
    scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)

    def outer(gaps):
        squirmers.run(scene, inner, angles_at=12.0)
        return squirmers.loads(inner, gaps)

    model = squirmers.Model.from_callable(outer, name="outer", range=(1e-2, 1e3))
    found = squirmers.run(scene, model, angles_at=12.0).deflections_deg
    assert found == pytest.approx(squirmers.run(scene, "exact", angles_at=12.0).deflections_deg, abs=1e-3)


def test_a_model_that_is_made_again_is_the_new_one():
    old, new = (squirmers.Model.from_callable(Counting(change), name="again", range=(1e-2, 1e3)) for change in (None, wrong_sign))
    assert squirmers.judge(old, grid=0).faultless and not squirmers.judge(new, grid=0).faultless
    scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
    first, second = (squirmers.run(scene, model, angles_at=12.0).deflections_deg for model in (old, new))
    assert abs(first - second).max() > 1


def test_a_scorecard_comes_back_from_a_pickle_and_is_shown(exact):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    card = squirmers.judge(exact[1], grid=0)
    again = pickle.loads(pickle.dumps(card))
    assert again == card and again.verdict == card.verdict and again.trusted_down_to == card.trusted_down_to
    assert again.errors == card.errors and again.rows.names == ["model", "measure", "case", "value", "unit"]
    assert repr(card).startswith("<Scorecard of copy: no fault found>\ncopy is within 1 % at all its gaps")
    html = card._repr_html_()
    assert "no fault found" in html and all(f"<li>{line}</li>" in html for line in card.verdict)
    from matplotlib import pyplot

    axes = card.plot()
    assert axes.get_xscale() == "log" and len(axes.get_legend().get_texts()) == len(set(card.errors["group"]))
    pyplot.close(axes.figure)


def test_val_models_of_the_library_are_judged_as_on_the_leaderboard():
    for name, kind in [("lt", False), ("exact", True)]:
        assert squirmers.judge(name, grid=0).faultless == kind
    card = squirmers.judge("lt", grid=0, gaps=[0.1, 38.0])
    assert sorted(set(card.errors["gap"])) == [0.1, 38.0]


def test_val_reference_numbers_are_those_of_the_published_package():
    folder = ROOT / "fixtures" / "reference"
    numbers = squirmers.reference()
    published = json.loads((folder / "datapackage.json").read_text())
    assert numbers.version == published["version"] and squirmers.reference(numbers.version).version == numbers.version
    assert list(numbers) == [resource["name"] for resource in published["resources"]] and len(numbers) == 7
    for name, table in numbers.items():
        text = (folder / f"{name}.csv").read_bytes()
        assert table.csv.encode() == text
        assert numbers.checksums[name] == "sha256:" + hashlib.sha256(text).hexdigest()
    loads = numbers["loads"]
    mine = [row for row in loads if row["ratio"] == 1.0 and row["gap"] == 0.01 and row["name"] == "X11A"]
    exact = squirmers.loads("exact", [0.01])["X11A"][0]
    assert mine[0]["value"] == pytest.approx(exact, rel=1e-9)
    assert numbers.version in numbers.citation
    with pytest.raises(squirmers.InputError, match=f"version '99' is not allowed: give {numbers.version}"):
        squirmers.reference("99")
    with pytest.raises(KeyError, match="there are loads, mobilities"):
        numbers["load"]


def test_val_pystokes_asked_live_is_pystokes_on_the_leaderboard():
    pytest.importorskip("pystokes")
    sys.path.insert(0, str(ROOT / "python" / "examples"))
    import pystokes_model

    gaps = [0.005, 0.01, 0.1, 0.5, 2, 38]
    live = squirmers.judge(pystokes_model.model("pystokes-matrix"), grid=0, gaps=gaps)
    filed = squirmers.judge(squirmers.Model.from_file(ROOT / "fixtures" / "peers" / "pystokes-matrix.csv"), grid=0)

    def numbers(card):
        return [(row["measure"], row["case"], row["value"]) for row in card.rows if "seconds" not in row["measure"] and row["measure"] != "time_ratio"]

    assert len(numbers(live)) == len(numbers(filed)) > 300
    for one, other in zip(numbers(live), numbers(filed), strict=True):
        assert one[0] == other[0]
        if "entries" not in one[1]:
            assert one[1] == other[1]
        assert one[2] == pytest.approx(other[2], rel=1e-12, abs=1e-12, nan_ok=True)
    assert live.faults == filed.faults
