"""Flow and stresslets: against the surfaces, the equations of the fluid, closed forms and the command line."""

import csv
import pickle
import subprocess
import sys

import numpy as np
import pytest
import squirmers



@pytest.fixture
def opposed():
    return squirmers.Scene.of("opposed", beta=5.0, dx=1.0)


@pytest.fixture
def pair():
    """Unlike squirmers in space, near each other, with a higher mode and swirl."""
    both = squirmers.Squirmer(modes=[1.5, 3.0, -0.7], swirl_modes=[0.2, 0.5]), squirmers.Squirmer(beta=-2.0, radius=0.6)
    return squirmers.Scene(both, [(0.1, -0.2, 0.3), (1.2, 1.1, 0.9)], orientations=[(1, 2, -1), (-1, 0, 2)])


def normals(count):
    """Unit vectors all over the sphere."""
    vectors = np.random.default_rng(7).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def slip(squirmer, p, n):
    """Slip velocity at the unit normals n, as the page of `Squirmer` has it."""
    c = n @ p
    w = [1.0 * c**0, c, (5 * c**2 - 1) / 4]
    along = sum(b * w[k] for k, b in enumerate(squirmer.modes))
    around = sum(b * w[k] for k, b in enumerate(squirmer.swirl_modes))
    return along[:, None] * (c[:, None] * n - p) + np.multiply(around, 1.0).reshape(-1, 1) * np.cross(p, n)


def surface_velocity(of, k, n):
    squirmer = of.scene.squirmers[k]
    rigid = of.velocities[k] + np.cross(of.angular_velocities[k], squirmer.radius * n)
    return rigid + slip(squirmer, of.orientations[k], n)


@pytest.mark.parametrize(("model", "count", "error"), [("exact", 300, 1e-10), ("bem", 20, None)])
def test_val_the_flow_on_a_surface_is_the_velocity_of_the_surface(pair, model, count, error):
    n = normals(count)
    of = squirmers.flow(pair, [pair.positions[k] + pair.squirmers[k].radius * n for k in (0, 1)], model)
    assert 0 < of.error_estimate < (error or 2e-2)
    for k in (0, 1):
        assert of.velocity[k] == pytest.approx(surface_velocity(of, k, n), abs=error or of.error_estimate)


def test_val_the_flow_obeys_the_equations_of_a_viscous_fluid(pair):
    # By central differences of second and of fourth order at points of the fluid.
    h = 2e-3
    points = np.array([[2.5, 0.5, 0.2], [0.3, 2.5, 1.0], [-1.2, -1.1, 0.1]])
    steps = h * np.eye(3)
    stencil = np.concatenate([[0 * steps[0]], *([s * steps[i] for s in (-2, -1, 1, 2)] for i in range(3))])
    of = squirmers.flow(pair, points[:, None, :] + stencil)
    middle = of.velocity[:, :1]
    around = of.velocity[:, 1:].reshape(-1, 3, 4, 3)
    first = np.einsum("s,pisc->pic", np.array([1, -8, 8, -1]) / (12 * h), around)
    assert np.einsum("pii->p", first) == pytest.approx(0, abs=1e-7)
    second = (np.einsum("s,pisc->pic", np.array([-1, 16, 16, -1]), around) - 30 * middle) / (12 * h**2)
    pressure = of.pressure[:, 1:].reshape(-1, 3, 4) @ (np.array([1, -8, 8, -1]) / (12 * h))
    assert second.sum(axis=1) == pytest.approx(pressure, abs=1e-6)
    assert np.abs(pressure).max() > 1e-2


def test_val_far_away_the_flow_is_that_of_the_two_stresslets(pair):
    # u = -3 (x.S.x) x/(8 pi mu r^5) about the pair, and the next terms fall off faster.
    whole = squirmers.stresslet(pair).stresslets.sum(axis=0)
    n = normals(20)
    errors = []
    for r in (100.0, 200.0):
        found = squirmers.flow(pair, pair.positions.mean(axis=0) + r * n).velocity
        expected = -3 * np.einsum("pi,ij,pj->p", n, whole, n)[:, None] * n / (8 * np.pi * r**2)
        errors.append(r**2 * np.abs(found - expected).max())
    assert errors[0] < 0.1 and errors[1] == pytest.approx(errors[0] / 2, rel=0.1)


def test_val_the_stresslet_of_a_squirmer_far_from_the_other_is_its_closed_form():
    for beta in (5.0, -2.0):
        scene = squirmers.Scene(squirmers.Squirmer(beta=beta), [(0, 0), (300, 0)], angles_deg=(30, 200))
        found = squirmers.stresslet(scene)
        for k in (0, 1):
            p = scene.orientations[k]
            expected = 4 * np.pi * 1.5 * beta * (np.outer(p, p) - np.eye(3) / 3)
            assert found.lone[k] == pytest.approx(expected, abs=1e-12)
            assert found.stresslets[k] == pytest.approx(expected, abs=1e-4)
        assert found.efficiencies == pytest.approx(1 / (2 + beta**2), rel=5e-4)


def test_stresslets_have_no_trace_and_power_balances(pair):
    for model, error in [("exact", 1e-10), ("bem", 1e-3)]:
        found = squirmers.stresslet(pair, model)
        assert found.stresslets == pytest.approx(found.stresslets.swapaxes(1, 2), abs=1e-12)
        assert np.trace(found.stresslets, axis1=1, axis2=2) == pytest.approx(0, abs=1e-12)
        assert found.slip_power.sum() + found.external_power == pytest.approx(found.dissipation, rel=error)
        assert found.budget < error


def test_the_instant_is_the_start_a_time_a_gap_or_the_closest_approach(opposed):
    run = squirmers.run(opposed)
    start = squirmers.stresslet(opposed)
    assert start.time == 0 and start.positions == pytest.approx(opposed.positions, abs=1e-14)
    assert start.positions.tobytes() == squirmers.stresslet(opposed, time=0).positions.tobytes()
    later = squirmers.stresslet(opposed, time=2.0)
    at = int(np.flatnonzero(run.time == 2.0)[0])
    assert later.positions == pytest.approx(run.positions[at], abs=1e-6)
    assert squirmers.stresslet(opposed, time="closest").gap == pytest.approx(run.min_gap, rel=1e-6)
    assert squirmers.flow(opposed, [9, 9], gap=0.5).gap == pytest.approx(0.5, rel=1e-9)


def test_points_have_any_shape_and_none_has_a_flow_inside(opposed):
    line = np.zeros((5, 2, 3))
    line[..., 0] = np.linspace(-3, 3, 5)[:, None]
    line[..., 1] = 5.0
    of = squirmers.flow(opposed, line)
    assert of.points.shape == of.velocity.shape == line.shape and of.pressure.shape == (5, 2)
    inside = np.abs(line[..., 0] + 0.5) < 1
    assert np.array_equal(np.isnan(of.pressure), inside) and np.array_equal(np.isnan(of.velocity).any(axis=-1), inside)
    flat = squirmers.flow(opposed, line[..., :2])
    assert np.array_equal(flat.velocity, of.velocity, equal_nan=True) and np.array_equal(flat.points, line)
    one = squirmers.flow(opposed, (3, 0))
    assert one.velocity.shape == (3,) and one.pressure.shape == ()
    assert squirmers.flow(opposed, np.zeros((0, 3))).velocity.shape == (0, 3)
    again = pickle.loads(pickle.dumps(of))
    assert np.array_equal(again.velocity, of.velocity, equal_nan=True) and again.scene == opposed


def test_the_command_line_writes_the_same_flow(opposed, program, project, tmp_path):
    scene = project / "fixtures" / "scenes" / "fig6-head-on-dx1.toml"
    command = [program, "flow", scene, "--method", "exact", "--grid", "20", "--out", tmp_path]
    subprocess.run(command, check=True, capture_output=True)
    with open(tmp_path / "flow.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    theirs = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name not in ("method", "frame")}
    points = np.stack([theirs[name] for name in "xyz"], axis=-1)
    ours = squirmers.flow(squirmers.Scene.of(str(scene)), points, time="closest")
    assert ours.time == pytest.approx(theirs["t"][0], abs=1e-9)
    assert np.array_equal(np.isnan(ours.pressure), theirs["inside"] > 0)
    for k, name in enumerate(("u_x", "u_y", "u_z")):
        assert ours.velocity[:, k] == pytest.approx(theirs[name], abs=1e-9, nan_ok=True)
    assert ours.pressure == pytest.approx(theirs["pressure"], abs=1e-7, nan_ok=True)


def test_stresses_by_gap_are_those_of_lone_squirmers_far_apart():
    table = squirmers.stresses("exact", [0.1, 1e4], modes=2)
    lone = {"XS1_2": 4, "YS1_2": 4, "ZS1_2": 4, "XP1_2_2": 8 / 3, "YP1_2_2": 8, "ZP1_2_2": 2}
    for name, value in lone.items():
        assert table[name][1] == pytest.approx(value, abs=1e-6)
        assert 0 < table.errors[name][0] < 1e-10
    assert table.names[0] == "gap" and table.dims == ("gap",)
    assert "XS21_2" in squirmers.stresses("exact", [0.1], ratio=0.5)


def test_what_is_not_allowed_is_said_in_one_line(opposed):
    refused = [
        (lambda: squirmers.flow(opposed, [[1, 2, 3, 4]]), r"points .*\(\.\.\., 3\)"),
        (lambda: squirmers.flow(opposed, 3.0), "points"),
        (lambda: squirmers.flow(opposed, [[0, 0, 0], [0, np.nan, 0]]), "point 1"),
        (lambda: squirmers.flow(opposed, [1e200, 0]), "1e100"),
        (lambda: squirmers.flow(opposed, [3, 0], time=1e3), "^time '1000' is not allowed: the scene runs from 0 to 200"),
        (lambda: squirmers.flow(opposed, [3, 0], time=150.0), "the run ends at"),
        (lambda: squirmers.flow(opposed, [3, 0], time=-1.0), "time"),
        (lambda: squirmers.flow(opposed, [3, 0], time=np.nan), "time"),
        (lambda: squirmers.flow(opposed, [3, 0], time="last"), "closest"),
        (lambda: squirmers.flow(opposed, [3, 0], gap=1e-4), "smallest gap of the run"),
        (lambda: squirmers.flow(opposed, [3, 0], gap=-1), "gap"),
        (lambda: squirmers.flow(opposed, [3, 0], time=1.0, gap=1.0), "one of the two"),
        (lambda: squirmers.flow(opposed, [3, 0], "lt"), "knows loads, no flow"),
        (lambda: squirmers.stresslet(opposed, "none"), "no flow"),
        (lambda: squirmers.stresses("lt-corrected", [1.0]), "no stresslet"),
        (lambda: squirmers.stresses("exact", [0.0]), "positive"),
        (lambda: squirmers.stresses("exact", [1.0], modes=9), "modes"),
    ]
    for call, text in refused:
        with pytest.raises(squirmers.InputError, match=text) as error:
            call()
        assert "\n" not in str(error.value) and "--" not in str(error.value)


@pytest.fixture
def pyplot():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    yield pyplot
    pyplot.close("all")


def test_pictures_of_paths_say_what_is_there(opposed, pyplot):
    def drawn(run):
        ax = run.plot()
        return ax, [text.get_text() for text in ax.get_legend().get_texts()] if ax.get_legend() else []

    ax, names = drawn(squirmers.run(opposed))
    assert len(ax.patches) == 6 and names[2:] == ["start", "closest,\ngap 0.0174 a", "end"]
    ax, names = drawn(squirmers.run(opposed, samples=False))
    assert names == [] and ax.texts[0].get_text() == "no samples were kept"
    ax, names = drawn(squirmers.run(opposed, end_time=1e-9, sample_interval=1.0))
    assert names[:3] == ["squirmer 1", "squirmer 2", "start"]
    ax, names = drawn(squirmers.run(squirmers.Scene.of("opposed", beta=5.0, dx=1.0, dz=1.0)))
    assert "seen along z" in ax.get_title() and names[0].startswith("squirmer 1,\nz from 0.5 to")
    _, (given, other) = pyplot.subplots(1, 2, sharex=True, sharey=True)
    assert squirmers.run(opposed).plot(given) is given
    squirmers.run(opposed, "lt").plot(other).figure.canvas.draw()


def test_pictures_of_the_flow_need_a_grid(opposed, pyplot):
    x, y = np.linspace(-3, 3, 13), np.linspace(-7, 7, 29)
    for indexing in ("xy", "ij"):
        grid = np.stack(np.meshgrid(x[::-1], y, indexing=indexing), axis=-1)
        ax = squirmers.flow(opposed, grid).plot()
        mesh = ax.collections[0]
        speed = np.ma.masked_invalid(mesh.get_array()).reshape(29, 13)
        assert speed.mask[np.argmin(abs(y - 5)), np.argmin(abs(x + 0.5))] and not speed.mask[14, 6]
        whole = squirmers.flow(opposed, [x[3], y[8]]).velocity
        assert speed[8, 3] == pytest.approx(np.linalg.norm(whole), rel=1e-12)
    rest = squirmers.Scene(squirmers.Squirmer(modes=[]), [(0, 0), (3, 0)], angles_deg=(0, 0))
    ax = squirmers.flow(rest, grid).plot()
    ax.figure.canvas.draw()
    uneven = np.stack(np.meshgrid([0, 1, 3], [0, 1]), axis=-1)
    tilted = np.pad(grid, ((0, 0), (0, 0), (0, 1)))
    tilted[..., 2] = tilted[..., 0]
    for points in ((3, 0), grid[0], uneven, tilted, grid[:1]):
        with pytest.raises(squirmers.InputError, match="regular grid"):
            squirmers.flow(opposed, points).plot()


@pytest.fixture
def sliders(monkeypatch, project):
    pytest.importorskip("matplotlib")
    monkeypatch.syspath_prepend(project / "docs" / "notebooks")
    import sliders

    yield sliders
    del sys.modules["sliders"]


def test_sliders_show_something_wherever_they_are(sliders):
    ends = {"distance": (0, 2, 2.0001, 14), "offset": (-6, 6), "angle1": (-180, 180), "angle2": (-180, 180), "beta1": (-10, 10), "beta2": (-10, 10)}
    for flow_at in ("start", "closest"):
        for name, values in ends.items():
            for value in values:
                shown = sliders.compute(**{**sliders.START, "offset": 3.0, name: value}, flow_at=flow_at)
                assert shown.message == "" and list(shown.runs) == list(sliders.MODELS)
    assert sliders.picture(shown).startswith(b"\x89PNG")
    assert all(f"<td>{model}</td>" in sliders.numbers(shown) for model in sliders.MODELS)
    for distance in (0.0, 1.5, 2.0):
        touching = sliders.compute(**{**sliders.START, "distance": distance, "offset": 0.0})
        assert "move them apart" in touching.message and touching.flow is None
        assert touching.message in sliders.numbers(touching)
    assert sliders.picture(touching).startswith(b"\x89PNG")


def test_the_panel_of_sliders_follows_them(sliders):
    pytest.importorskip("ipywidgets")
    controls, picture, table = sliders.panel().children
    distance, *_ = controls.children
    before = bytes(picture.value)
    assert before.startswith(b"\x89PNG") and "-11.698" in table.value
    distance.value = 1.0
    assert bytes(picture.value) != before and "move them apart" in table.value
