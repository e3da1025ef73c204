"""Scenes, runs, loads: the same numbers as the library's, and what a trajectory is."""

import json
import pickle
import subprocess

import numpy as np
import pytest
import squirmers


@pytest.fixture
def opposed():
    return squirmers.Scene.of("opposed", beta=5.0, dx=1.0)


def test_val_the_deflection_of_opposed_pullers_is_that_of_the_paper_table(opposed):
    # README's table: exact -11.698, lubrication as published -19.707 and corrected -20.297 degrees.
    for model, deflection in [("exact", -11.698), ("lt", -19.707), ("lt-corrected", -20.297)]:
        found = squirmers.run(opposed, model).deflections_deg
        assert found == pytest.approx([deflection] * 2, abs=6e-4)


def test_a_trajectory_begins_at_the_start_and_its_arrays_agree(opposed):
    run = squirmers.run(opposed)
    assert run.positions.shape == run.orientations.shape == (len(run), 2, 3)
    assert run.positions[0] == pytest.approx(opposed.positions, abs=1e-14)
    distance = np.linalg.norm(run.positions[:, 1] - run.positions[:, 0], axis=1)
    assert distance - 2 == pytest.approx(run.gap, abs=1e-12)
    assert np.linalg.norm(run.orientations, axis=2) == pytest.approx(1, abs=1e-12)
    angles = np.deg2rad(run.angles_deg)
    assert np.cos(angles) == pytest.approx(run.orientations[:, :, 0], abs=1e-12)
    assert run.min_gap <= run.gap.min() and np.all(np.diff(run.time) >= 0)
    frame = run.to_pandas()
    assert list(frame.columns[:4]) == ["t", "x1", "y1", "z1"] and len(frame) == len(run)


def test_samples_are_as_often_as_asked_and_change_no_number(opposed):
    often, seldom, never = (
        squirmers.run(opposed, sample_interval=0.01),
        squirmers.run(opposed, sample_interval=1.0),
        squirmers.run(opposed, samples=False),
    )
    assert len(often) > 50 * len(seldom) / 2 and len(never) == 0
    for other in (seldom, never):
        assert (other.deflections_deg == often.deflections_deg).all()
        assert (other.min_gap, other.tau, other.outcome) == (often.min_gap, often.tau, often.outcome)


def test_settings_of_a_file_hold_unless_others_are_given():
    text = """
    hydrodynamics = "lubrication"
    [[squirmer]]
    position = [0, 0]
    orientation = 90
    beta = 1
    [[squirmer]]
    position = [5, 0]
    orientation = 90
    beta = 1
    [run]
    end_time = 3.0
    [output]
    sample_interval = 1.0
    """
    scene = squirmers.Scene.from_toml(text)
    run = squirmers.run(scene)
    assert run.model == "lt" and run.end_time == 3.0 and list(run.time) == [0, 1, 2, 3]
    longer = squirmers.run(scene, "exact", end_time=4.0, sample_interval=2.0)
    assert longer.model == "exact" and list(longer.time) == [0, 2, 4]


def test_each_setting_does_what_it_says(opposed):
    usual = squirmers.run(opposed)
    coarse, fine = (squirmers.run(opposed, tolerance=tolerance) for tolerance in (1e-4, 1e-12))
    assert coarse.steps < usual.steps < fine.steps
    assert usual.deflections_deg == pytest.approx(fine.deflections_deg, abs=1e-5)
    # The pair has parted where it recedes at this distance, and no earlier.
    for distance in (9.0, 30.0):
        parted = squirmers.run(opposed, departure_distance=distance)
        assert parted.gap[-1] + 2 == pytest.approx(distance, abs=1e-6)
        assert parted.deflections_deg == pytest.approx(usual.deflections_deg, abs=1e-4)
    # What the far field still turns beyond a distance falls with it.
    missing = [abs(squirmers.run(opposed, angles_at=at).deflections_deg[0] - fine.deflections_deg[0]) for at in (12, 24, 48)]
    assert missing[0] > 3 * missing[1] > 9 * missing[2] > 0
    early = squirmers.run(opposed, end_time=2.5)
    assert early.end_time == 2.5 and early.outcome == "undecided"
    with pytest.raises(squirmers.ComputationError, match="10 steps"):
        squirmers.run(opposed, max_steps=10)


def test_scenes_come_back_from_pickles_with_the_same_bits():
    scenes = [
        squirmers.Scene.of("opposed", beta=5.0, dx=0.1),
        squirmers.Scene(
            (squirmers.Squirmer(1.0), squirmers.Squirmer(modes=[1.5, 0, 2], radius=0.5)),
            [(0.1, 0.2), (4, 1)],
            orientations=[(1, 2, 3), (0, 1, 1)],
            gravity=(1, 2, 3),
            repulsion=(10, 100),
        ),
        squirmers.Scene(squirmers.Squirmer(-3.0, swirl_modes=[0, 1], bottom_heaviness=2.0), [(0, 0), (0, 3)], angles_deg=(33.3, 500)),
    ]
    for scene in scenes:
        again = pickle.loads(pickle.dumps(scene))
        assert again == scene and again.squirmers == scene.squirmers
        for name in ("positions", "orientations", "angles_deg", "gravity"):
            a, b = getattr(again, name), getattr(scene, name)
            assert a is b or np.array_equal(a, b)
        first, second = (squirmers.run(of, "lt") for of in (scene, again))
        assert (first.deflections_deg.tobytes()) == (second.deflections_deg.tobytes())
    assert scenes[0] != scenes[2]


def test_trajectories_come_back_from_pickles(opposed):
    run = squirmers.run(opposed, sample_interval=1.0)
    again = pickle.loads(pickle.dumps(run))
    assert repr(again) == repr(run) and again.scene == opposed
    for name in ("time", "positions", "orientations", "angles_deg", "gap", "deflections_deg"):
        assert np.array_equal(getattr(again, name), getattr(run, name))
    for name in ("truncation_deg", "min_gap", "tau", "end_time", "settled", "steps", "seconds", "outcome"):
        assert getattr(again, name) == getattr(run, name)
    assert again.to_pandas().equals(run.to_pandas())


def test_val_loads_obey_their_laws_and_published_limits():
    gaps = np.geomspace(1e-3, 1e3, 13)
    loads = squirmers.loads("exact", gaps)
    assert np.array_equal(loads["gap"], gaps)
    # A lone sphere's thrust and drag far away, and Faxen's law in between.
    assert loads["XF1_1"][-1] == pytest.approx(4, abs=1e-5)
    distance = 2 + gaps[-1]
    assert loads["X12A"][-1] == pytest.approx(-1.5 / distance, rel=1e-5)
    # Near contact X11A goes as 1/(4 gap) + 9/40 ln(1/gap) + 0.9954 (Jeffrey & Onishi 1984).
    eps = gaps[0]
    assert loads["X11A"][0] == pytest.approx(0.25 / eps + 0.225 * np.log(1 / eps) + 0.9954, abs=2e-3)
    assert np.isnan(squirmers.loads("lt", [0.1]).errors["X11A"]).all()
    assert 0 < squirmers.loads("bem", [0.1]).errors["X11A"][0] < 1e-2
    unlike = squirmers.loads("exact", [0.1], ratio=0.5)
    assert "X21A" in unlike


def test_val_mobilities_are_the_inverse_of_loads_for_a_sphere_that_is_pulled():
    # Two spheres pushed apart by one force: their opening per force is that of X11A - X12A.
    gap = 0.5
    loads, motion = squirmers.loads("exact", [gap]), squirmers.mobility("exact", [gap])
    drag = 6 * (loads["X11A"][0] - loads["X12A"][0])
    assert motion["opening, d(ln eps)/dt by f"][0] == pytest.approx(2 / drag / gap, rel=1e-12)


def test_a_table_is_the_same_in_every_form():
    table = squirmers.loads("exact", [0.1, 1.0])
    rows = table.to_structured()
    frame = table.to_pandas()
    cube = table.to_xarray()
    for name in table.names:
        assert np.array_equal(rows[name], table[name])
        assert np.array_equal(frame[name], table[name])
        assert np.array_equal(cube[name], table[name])
    assert [row["X11A"] for row in table] == list(table["X11A"])
    assert pickle.loads(pickle.dumps(table)) == table
    assert pickle.loads(pickle.dumps(rows[0])) == rows[0]
    with pytest.raises(KeyError, match="no column"):
        table["X13A"]
    with pytest.raises(ValueError):
        table["X11A"][0] = 1


@pytest.mark.parametrize("model", ["lubrication", "exact"])
def test_a_run_has_the_bits_of_the_command_line(program, tmp_path, model):
    text = f"""
    hydrodynamics = "{model}"
    repulsion = "paper"
    [[squirmer]]
    position = [-0.5, 5.0, 0.1]
    orientation = -90.0
    beta = 5.0
    [[squirmer]]
    position = [0.5, -5.0]
    orientation = [0.1, 0.8, 0.2]
    beta = 4.0
    """
    file = tmp_path / "scene.toml"
    file.write_text(text)
    subprocess.run([program, "run", file, "--out", tmp_path], check=True, capture_output=True)
    run = squirmers.run(squirmers.Scene.from_toml(text))
    theirs = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True)
    ours = run.to_pandas()
    assert list(ours.columns) == list(theirs.dtype.names)
    for name in ours.columns:
        # Text holds every bit.
        assert np.array_equal(ours[name].to_numpy(), theirs[name]), name
    summary = json.loads((tmp_path / "run.json").read_text())
    assert [summary["deflection1_deg"], summary["deflection2_deg"]] == list(run.deflections_deg)
    for name, value in [("min_gap", run.min_gap), ("contact_time", run.tau), ("end_time", run.end_time), ("steps", run.steps), ("outcome", run.outcome)]:
        assert summary[name] == value, name
    assert summary["truncation_deg"] == run.truncation_deg


def test_loads_have_the_bits_of_the_command_line(program, tmp_path):
    subprocess.run([program, "loads", "--gap", "0.03,2", "--method", "exact,lt", "--out", tmp_path], check=True, capture_output=True)
    rows = (tmp_path / "loads.csv").read_text().splitlines()
    header = rows[0].split(",")
    for line in rows[1:]:
        row = dict(zip(header, line.split(","), strict=True))
        ours = squirmers.loads(row["method"], [float(row["gap"])])
        assert ours[row["name"]][0] == float(row["value"]), row


@pytest.mark.parametrize(
    "gaps",
    [
        np.array([0.1 + 1j]),
        np.array(["2020-01-01"], dtype="datetime64[D]"),
        np.ma.masked_equal([0.1, 0.2], 0.2),
        ["0.1 a"],
        [None],
        [0.1, float("nan")],
        [[0.1]],
    ],
)
def test_what_is_no_real_number_is_refused_and_not_made_one(gaps):
    with pytest.raises((ValueError, TypeError), match="."):
        squirmers.loads("lt", gaps)
    assert squirmers.loads("lt", np.array([1, 2], dtype=np.int8))["gap"].tolist() == [1, 2]
    assert squirmers.loads("lt", 1)["gap"].tolist() == [1]
