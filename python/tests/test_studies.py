"""Sweeps and studies: the bytes of the command line, shares, interrupts, and what is refused."""

import contextlib
import inspect
import os
import pickle
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import squirmers

EXAMPLES = Path(__file__).parents[1] / "examples"
AXES = {"beta": [-5.0, 0.0, 5.0], "dx": [0.5, 1.0, 2.0, 3.0]}
VARY = ["--vary", "beta=-5,0,5", "--vary", "dx=0.5,1,2,3"]


@pytest.fixture
def command_line(program, tmp_path):
    """Runs the command line and returns the folder of its results, or else what it prints."""

    def run(*arguments, status=0):
        out = tmp_path / "command-line"
        done = subprocess.run([program, *arguments, "--out", out], capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return done.stdout if "--help" in arguments else out

    return run


def _same_bytes(table, folder, name):
    assert table.csv.encode() == (folder / name).read_bytes()


def test_a_sweep_has_the_bytes_of_the_command_line(command_line, tmp_path):
    out = tmp_path / "python"
    table = squirmers.sweep("opposed", AXES, out=out)
    theirs = command_line("sweep", "opposed", *VARY)
    _same_bytes(table, theirs, "sweep.csv")
    assert sorted(file.name for file in out.iterdir()) == ["sweep.csv", "sweep.json"]
    # The manifests differ in how long it took alone.
    ours, theirs = ((folder / "sweep.json").read_text() for folder in (out, theirs))
    timed = re.compile(r'"seconds": [^\n]*')
    assert timed.sub("", ours) == timed.sub("", theirs)
    assert table.dims == ("method", "beta", "dx")
    assert table.to_xarray()["tau"].shape == (2, 3, 4)
    assert squirmers.sweep("opposed", AXES) == table
    close = squirmers.sweep("opposed", AXES, "exact", angles_at=12, tolerance=1e-6)
    theirs = command_line("sweep", "opposed", *VARY, "--method", "exact", "--departure", "12", "--tol", "1e-6")
    _same_bytes(close, theirs, "sweep.csv")


def test_a_family_of_a_file_names_its_model(command_line, tmp_path):
    family = tmp_path / "chase.toml"
    family.write_text(
        """
        hydrodynamics = "lubrication"
        [parameters]
        dx = 3.0
        dy = 0.0
        [[squirmer]]
        position = [0, 0]
        orientation = 90
        beta = 1
        [[squirmer]]
        position = ["dx", "dy"]
        orientation = 90
        beta = 1
        [run]
        end_time = 5
        """
    )
    table = squirmers.sweep(family, {"dx": [3, 4], "dy": 1})
    assert set(table["method"]) == {"lt"}
    _same_bytes(table, command_line("sweep", str(family), "--vary", "dx=3,4", "--vary", "dy=1"), "sweep.csv")


def test_maps_have_the_bytes_of_the_command_line(command_line, tmp_path):
    table = squirmers.scatter(grid=4)
    _same_bytes(table, command_line("scatter", "--grid", "4"), "scatter.csv")
    assert table.to_xarray()["tau"].dims == ("method", "beta", "g", "sigma", "delta")
    heavy = squirmers.scatter([1, 5], "lt", g=[0, 10], grid=4, tolerance=1e-6, angles_at=12, out=tmp_path / "maps")
    arguments = ["--beta", "1,5", "--method", "lt", "--g", "0,10", "--grid", "4", "--tol", "1e-6", "--departure", "12"]
    _same_bytes(heavy, command_line("scatter", *arguments), "scatter.csv")
    _same_bytes(heavy, tmp_path / "maps", "scatter.csv")
    shares = squirmers.fates(grid=2)
    _same_bytes(shares, command_line("fates", "--grid", "2"), "fates.csv")
    assert shares["points"].tolist() == [4] * 42


def test_bound_states_have_the_bytes_of_the_command_line(command_line):
    table = squirmers.bound_states(["lt", "exact"], [5.0, -5.0])
    theirs = command_line("growth", "--beta", "5,-5", "--method", "lt,exact", "--grid", "2")
    _same_bytes(table, theirs, "bound-states.csv")
    assert set(table["stable_in_plane"]) <= {"yes", "no", "neutral", "unknown"}
    assert table["one_of_a_line"].dtype == bool
    assert table.csv.splitlines()[1].endswith(",true") == table["one_of_a_line"][0]


def test_sensitivities_have_the_bytes_of_the_command_line(command_line):
    table = squirmers.sensitivity(models="lt")
    theirs = command_line("sensitivity", "--method", "lt")
    _same_bytes(table, theirs, "sensitivity.csv")
    _same_bytes(table.derivatives, theirs, "sensitivity-derivatives.csv")
    assert table.dims == ("method", "case", "beta", "dx")
    assert table.columns[0].meaning == "Name of the family."
    one = squirmers.sensitivity("right-angles", {"beta": [1], "dx": [1]}, "exact", tolerance=1e-9)
    theirs = command_line("sensitivity", "right-angles", "--vary", "beta=1", "--vary", "dx=1", "--method", "exact", "--tol", "1e-9")
    _same_bytes(one.derivatives, theirs, "sensitivity-derivatives.csv")
    by = one.derivatives.to_xarray()["value"].sel(by="offset dz", of="tilt1").item()
    assert by == one["tilt1_per_a"][0]


def test_collision_integrals_have_the_bytes_of_the_command_line(command_line, tmp_path):
    table = squirmers.kinetics(count=2, replications=2, out=tmp_path / "kinetics")
    theirs = command_line("kinetics", "--count", "2", "--replications", "2")
    _same_bytes(table, theirs, "kinetics.csv")
    _same_bytes(table.ratios, theirs, "kinetics-ratios.csv")
    _same_bytes(table.ratios, tmp_path / "kinetics", "kinetics-ratios.csv")
    assert table.to_xarray()["rotation"].shape == (3, 11, 1)
    assert len(squirmers.kinetics(5.0, "lt", count=1, replications=2).ratios) == 0


@pytest.mark.parametrize(
    ("study", "options"),
    [
        ("scatter", {"grid": "grid", "tolerance": "tol", "models": "method"}),
        ("fates", {"grid": "grid", "tolerance": "tol", "models": "method"}),
        ("kinetics", {"count": "count", "replications": "replications", "tolerance": "tol", "models": "method"}),
        ("sensitivity", {"models": "method"}),
    ],
)
def test_defaults_are_those_of_the_command_line(study, options, command_line):
    # However wide its lines are.
    text = " ".join(command_line(study, "--help").split())
    parameters = inspect.signature(getattr(squirmers, study)).parameters
    for name, option in options.items():
        told = re.search(rf"--{option} <.*?\[default: (.*?)\]", text, re.DOTALL)[1]
        default = parameters[name].default
        assert (",".join(default) if name == "models" else default) == (told if name == "models" else float(told))


def test_shares_merge_to_the_bytes_of_the_whole(tmp_path):
    whole = squirmers.sweep("opposed", AXES, ["lt", "lt-corrected"])
    folders = [tmp_path / f"share-{number}" for number in (1, 2, 3)]
    partitions = ["1/3", (2, 3), (3, 3)]
    parts = [
        squirmers.sweep("opposed", AXES, ["lt", "lt-corrected"], out=folder, partition=partition)
        for folder, partition in zip(folders, partitions, strict=True)
    ]
    assert sum(len(part) for part in parts) == len(whole)
    merged = squirmers.merge(reversed(folders), tmp_path / "merged")
    assert merged == whole and squirmers.merge(folders) == whole
    assert (tmp_path / "merged" / "sweep.csv").read_text() == whole.csv
    with pytest.raises(squirmers.FileError, match="missing: 2/3"):
        squirmers.merge([folders[0], folders[2]])
    with pytest.raises(squirmers.FileError, match="is also in"):
        squirmers.merge([*folders, folders[0]])
    with pytest.raises(squirmers.InputError, match="out '.*share-1' is not allowed"):
        squirmers.merge(folders, folders[0])
    with pytest.raises(squirmers.InputError, match="merge"):
        squirmers.merge([])


def test_shares_have_one_arithmetic_whatever_the_tables_held_before(tmp_path):
    squirmers.sweep("opposed", {"dx": [1.0, 2.0]}, "exact", out=tmp_path / "1", partition=(1, 2))
    # A model of its own, with tables of more loads.
    model = squirmers.Model("exact")
    squirmers.mobility(model, [1.0], modes=3)
    squirmers.run(squirmers.Scene(squirmers.Squirmer(modes=[1.5, 1, 1]), [(0, 0), (4, 1)], angles_deg=(0, 180)), model)
    squirmers.sweep("opposed", {"dx": [1.0, 2.0]}, model, out=tmp_path / "2", partition=(2, 2))
    squirmers.merge([tmp_path / "1", tmp_path / "2"], tmp_path / "merged")
    manifest = (tmp_path / "merged" / "sweep.json").read_text()
    assert manifest.count('"machine"') == 1


def test_a_time_limit_leaves_rows_out_and_the_same_call_goes_on(tmp_path, caplog):
    axes = {"dx": np.linspace(0.5, 3.0, 6)}
    table = squirmers.sweep("opposed", axes, "lt", out=tmp_path, time_limit=0)
    assert set(table["outcome"]) == {"skipped"} and np.isnan(table["tau"]).all()
    assert "6 of 6 rows are left; the same command continues from sweep.csv.part" in caplog.text
    assert squirmers.sweep("opposed", axes, "lt", out=tmp_path) == squirmers.sweep("opposed", axes, "lt")
    with pytest.raises(squirmers.ComputationError, match="stopped by time_limit: 4 of the runs or lines"):
        squirmers.scatter(5.0, "lt", grid=4, out=tmp_path, time_limit=0)
    for study in (squirmers.scatter, squirmers.fates, squirmers.kinetics):
        with pytest.raises(squirmers.ComputationError, match="stopped by time_limit"):
            study(5.0, "lt", out=tmp_path / study.__name__, time_limit=0)
    with pytest.raises(squirmers.ComputationError, match="stopped by time_limit"):
        squirmers.sensitivity("opposed", {"dx": [1.0]}, "lt", out=tmp_path, time_limit=0)
    with pytest.raises(squirmers.InputError, match="time_limit '3.0' is not allowed: give out too"):
        squirmers.sweep("opposed", axes, "lt", time_limit=3)


@pytest.mark.parametrize(
    ("study", "given", "arguments"),
    [
        ("sweep", ["opposed", AXES], ["opposed", *VARY]),
        ("scatter", [], []),
        ("fates", [], []),
        ("kinetics", [], []),
        ("sensitivity", ["opposed", AXES, "lt"], ["opposed", *VARY, "--method", "lt"]),
    ],
)
def test_what_python_has_begun_the_command_line_goes_on_with(study, given, arguments, command_line, tmp_path):
    with contextlib.suppress(squirmers.ComputationError):
        getattr(squirmers, study)(*given, out=tmp_path / "python", time_limit=0)
    theirs = command_line(study, *arguments, "--time-limit", "0", status=75)
    # The first line says what is swept and how; the defaults are in it too.
    kept = f"{study}.csv.part"
    assert (tmp_path / "python" / kept).read_text() == (theirs / kept).read_text()


def test_a_run_that_fails_is_a_row_and_a_reason(tmp_path, caplog):
    family = tmp_path / "near.toml"
    squirmer = "[[squirmer]]\nposition = [{}]\norientation = 90\nbeta = 1\n"
    family.write_text(
        "[parameters]\nx = 3.0\ny = 3.0\n" + squirmer.format("0, 0") + squirmer.format('"x", "y"') + "[run]\nend_time = 0.01\n"
    )
    # So many points are not all looked at before they run; spheres in the middle overlap.
    places = np.linspace(-5, 5, 110)
    table = squirmers.sweep(family, {"x": places, "y": places}, "lt")
    overlap = np.hypot(table["x"], table["y"]) <= 2
    assert set(table["outcome"][overlap]) == {"failed"} and np.isnan(table["tau"][overlap]).all()
    assert "failed" not in table["outcome"][~overlap]
    assert "lt, x = " in caplog.text and f"{overlap.sum()} runs of 12100 rows failed" in caplog.text
    with pytest.raises(squirmers.InputError, match="mistakes"):
        squirmers.sweep(squirmers.__file__, {})


def test_tables_and_rows_come_back_from_pickles():
    table = squirmers.sweep("opposed", AXES, "lt")
    again = pickle.loads(pickle.dumps(table))
    assert again == table and again["outcome"].tolist() == table["outcome"].tolist()
    rows = table.to_structured()
    assert pickle.loads(pickle.dumps(rows[0])) == rows[0]
    row = next(iter(table))
    assert pickle.loads(pickle.dumps(row)) == row
    of = squirmers.sensitivity("opposed", {"dx": [1.0]}, "lt")
    again = pickle.loads(pickle.dumps(of))
    assert type(again) is squirmers.Sensitivity and again == of and again.derivatives == of.derivatives
    loads = squirmers.loads("lt", [0.1])
    assert pickle.loads(pickle.dumps(loads)).errors.names == loads.errors.names


@pytest.mark.parametrize(
    ("told", "arguments"),
    [
        ("axes 'gamma' is not allowed: the family has the parameters", {"axes": {"gamma": [1]}}),
        ("axes 'dx' is not allowed: NaN is in the list", {"axes": {"dx": [1, float("nan")]}}),
        ("axes 'dx' is not allowed: inf is in the list", {"axes": {"dx": float("inf")}}),
        ("axes 'dx' is not allowed: the list is empty", {"axes": {"dx": []}}),
        ("axes 'dx' is not allowed: 1.0 is in the list twice", {"axes": {"dx": [1, 1]}}),
        ("axes 'of the shape \\[1, 2\\]' is not allowed", {"axes": {"dx": [[1, 2]]}}),
        ("'3/2' is not a share", {"partition": "3/2"}),
        ("'3/2' is not a share", {"partition": (3, 2)}),
        ("'1/2/3' is not a share", {"partition": (1, 2, 3)}),
        ("partition '1/9' is not allowed: there are 2 rows", {"partition": "1/9"}),
        ("model 'stokes' is not allowed: give lt", {"models": "stokes"}),
        ("models 'none' is not allowed: give one model", {"models": []}),
        ("models 'lt' is not allowed: two models", {"models": ["lt", squirmers.Model("lt")]}),
        ("tolerance '1.0' is not allowed", {"tolerance": 1}),
        ("tolerance 'NaN' is not allowed", {"tolerance": float("nan")}),
        ("angles_at '2.0' is not allowed", {"angles_at": 2}),
        ("time_limit '-1' is not allowed: give a number of seconds", {"time_limit": -1, "out": "."}),
        ("a point of the family is not a valid scene", {"axes": {"dx": [1e300], "beta": [1e300]}}),
    ],
)
def test_what_is_not_allowed_is_named_in_one_line(told, arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    given = {"axes": {"dx": [1.0, 2.0]}, "models": "lt", **arguments}
    with pytest.raises(squirmers.InputError, match=told):
        squirmers.sweep("opposed", **given)
    assert not list(tmp_path.glob("*.csv*"))


def test_what_other_studies_refuse(tmp_path):
    for told, call in [
        ("grid '1' is not allowed", lambda: squirmers.scatter(5, grid=1)),
        ("beta 'list' is not allowed: NaN", lambda: squirmers.scatter(float("nan"))),
        ("g 'list' is not allowed: the list is empty", lambda: squirmers.fates(5, g=[])),
        ("beta 'list' is not allowed: inf", lambda: squirmers.bound_states("lt", float("inf"))),
        ("count '0' is not allowed", lambda: squirmers.kinetics(5, count=0)),
        ("count '-1' is not allowed", lambda: squirmers.kinetics(5, count=-1)),
        ("replications '1' is not allowed", lambda: squirmers.kinetics(5, replications=1)),
        ("impact '-1' is not allowed", lambda: squirmers.kinetics(5, impact=-1)),
        ("axes without family", lambda: squirmers.sensitivity(axes={"dx": [1]})),
    ]:
        with pytest.raises(squirmers.InputError, match=told):
            call()
    with pytest.raises(squirmers.FileError, match="cannot read 'nowhere.toml'"):
        squirmers.sweep("nowhere.toml", {})
    (tmp_path / "file").write_text("")
    with pytest.raises(squirmers.FileError, match="cannot write"):
        squirmers.sweep("opposed", {"dx": [1.0]}, "lt", out=tmp_path / "file" / "folder")


def test_what_another_sweep_kept_is_not_deleted_unless_asked(tmp_path):
    part = tmp_path / "sweep.csv.part"
    part.write_text("another sweep\n1,2\ndone 0 00000000\n")
    with pytest.raises(squirmers.FileError, match="keeps 1 finished pieces of another sweep.*or delete the file by fresh"):
        squirmers.sweep("opposed", {"dx": [1.0]}, "lt", out=tmp_path)
    assert part.exists()
    squirmers.sweep("opposed", {"dx": [1.0]}, "lt", out=tmp_path, fresh=True)
    assert not part.exists()


def _started(script, *arguments):
    """A process of Python that has told that it has begun."""
    # Shells ignore interrupts for commands in the background, and so would what these start.
    heard = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    process = subprocess.Popen(
        [sys.executable, "-u", "-c", heard + script, *map(str, arguments)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "begun\n"
    return process


def _interrupted(process, seconds):
    """What a process tells after an interrupt, which it has to answer in so many seconds."""
    process.send_signal(signal.SIGINT)
    began = time.monotonic()
    told = process.stdout.readline()
    assert time.monotonic() - began < seconds, told
    return told


SWEPT = """
import sys
import numpy, squirmers
squirmers.set_threads(1)
print("begun")
axes = {"sigma": numpy.linspace(0.01, 1.99, 200), "delta": numpy.linspace(0.01, 1.99, 200)}
try:
    squirmers.sweep("incoming-angles", axes, "lt", out=sys.argv[1], progress=False)
except KeyboardInterrupt as stop:
    print(stop)
else:
    print("not interrupted")
"""


def test_an_interrupted_sweep_says_what_it_keeps_and_the_same_call_goes_on(tmp_path):
    out = tmp_path / "swept"
    process = _started(SWEPT, out)
    part = out / "sweep.csv.part"
    while not (part.exists() and part.read_text().count("done ") > 3):
        time.sleep(0.01)
    told = _interrupted(process, 3)
    assert re.match(r"interrupted: \d+ of 1000 parts of the sweep are left; the same command continues from '.*sweep.csv.part'", told)
    assert process.wait(10) == 0
    process.stdout.close()
    kept = part.read_text()
    axes = {"sigma": np.linspace(0.01, 1.99, 200), "delta": np.linspace(0.01, 1.99, 200)}
    table = squirmers.sweep("incoming-angles", axes, "lt", out=out)
    assert len(table) == 40_000 and not part.exists()
    rows = [line for line in kept.splitlines()[1:] if not line.startswith("done ")]
    assert set(rows) <= set(table.csv.splitlines())


DIRECT = """
import sys
import squirmers
solved = squirmers.Model("bem", direct=True)
scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
calls = [
    lambda: squirmers.run(scene, solved),
    lambda: squirmers.sweep("opposed", {"dx": [1.0, 2.0]}, solved),
    lambda: squirmers.sweep("opposed", {"dx": [1.0, 2.0]}, solved, out=sys.argv[1]),
]
for call in calls:
    print("begun")
    try:
        call()
    except KeyboardInterrupt as stop:
        print("stopped", stop)
    print(squirmers.run(scene, "lt").outcome, len(squirmers.sweep("opposed", {"dx": [1.0]}, "lt")))
"""


def test_long_work_ends_at_an_interrupt_keeps_nothing_unfinished_and_the_interpreter_lives_on(tmp_path):
    process = _started(DIRECT, tmp_path)
    for number in range(3):
        if number > 0:
            assert process.stdout.readline() == "begun\n"
        time.sleep(0.5)
        if number == 2:
            # A sweep that keeps its pieces finishes them first; the second interrupt ends it.
            process.send_signal(signal.SIGINT)
            time.sleep(0.5)
        told = _interrupted(process, 3)
        assert told.startswith("stopped"), told
        assert process.stdout.readline() == "scattered 1\n"
    assert "2 of 2 parts of the sweep are left" in told
    assert process.wait(10) == 0
    process.stdout.close()
    kept = (tmp_path / "sweep.csv.part").read_text()
    assert kept.count("\n") == 1, kept


FORKED = """
import multiprocessing
import squirmers

def swept(dx):
    try:
        return len(squirmers.sweep("opposed", {"dx": dx}, "lt"))
    except squirmers.ComputationError as error:
        return str(error)

for work in range(2):
    with multiprocessing.get_context("fork").Pool(1) as pool:
        print(pool.apply(swept, ([1.0, 2.0],)))
    swept([1.0])
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="nothing forks")
def test_a_process_that_is_forked_after_work_began_is_refused_and_does_not_hang():
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", FORKED], capture_output=True, text=True, timeout=60, check=True
    )
    before, after = done.stdout.splitlines()
    assert before == "2" and "was forked" in after and "spawn" in after


def test_shares_on_workers_of_dask_merge_to_the_bytes_of_one_process(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(EXAMPLES)
    from dask_sweep import dask_sweep
    from distributed import Client, LocalCluster

    whole = squirmers.sweep("opposed", AXES)
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        assert dask_sweep(client, "opposed", AXES, out=tmp_path, shares=3) == whole
        processes = client.run(os.getpid)
    assert len(set(processes.values()) | {os.getpid()}) == 3
    assert (tmp_path / "sweep.csv").read_text() == whole.csv


def test_shares_on_processes_of_joblib_merge_to_the_bytes_of_one_process(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(EXAMPLES)
    from joblib.externals.loky import get_reusable_executor
    from joblib_sweep import joblib_sweep

    whole = squirmers.sweep("opposed", AXES)
    try:
        assert joblib_sweep("opposed", AXES, out=tmp_path, jobs=2) == whole
    finally:
        get_reusable_executor().shutdown(wait=True)
    assert (tmp_path / "sweep.csv").read_text() == whole.csv


def test_the_package_is_imported_without_what_it_does_not_need_yet():
    script = "import sys, squirmers; print([of for of in ('numpy', 'pandas', 'logging', 'typing') if of in sys.modules])"
    told = subprocess.run([sys.executable, "-I", "-c", script], capture_output=True, text=True, check=True)
    assert told.stdout == "[]\n"
