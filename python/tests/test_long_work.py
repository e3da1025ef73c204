"""Long work leaves the interpreter to others, and says how far it is."""

import logging
import re
import threading
import time

import pytest
import squirmers


def long_work(**more):
    """About a second: boundary elements at gaps, each solved for."""
    return squirmers.loads("bem", [0.05, 0.1, 0.2, 0.4, 0.8, 1.6], **more)


def test_other_threads_go_on_during_long_work():
    over = threading.Event()
    ticks = []

    def tick():
        while not over.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.005)

    other = threading.Thread(target=tick)
    other.start()
    began = time.perf_counter()
    long_work()
    took = time.perf_counter() - began
    over.set()
    other.join()
    # A thread that waited for the interpreter would have ticked at both ends alone.
    assert sum(began < at < began + took for at in ticks) > min(5, took / 0.05)


def test_several_threads_run_scenes_at_once_with_the_numbers_of_one():
    scenes = [squirmers.Scene.of("opposed", beta=5.0, dx=dx) for dx in (0.5, 1.0, 1.5, 2.0)]
    alone = [squirmers.run(scene).deflections_deg.tobytes() for scene in scenes]
    together = [b""] * len(scenes)

    def work(k):
        together[k] = squirmers.run(scenes[k]).deflections_deg.tobytes()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(len(scenes))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone


def test_progress_is_shown_where_it_is_asked_for(capsys):
    long_work(progress=True)
    shown = capsys.readouterr().err
    assert "gaps" in shown and re.search(r"[1-6]/6", shown)
    long_work(progress=False)
    # Neither a terminal nor a notebook.
    long_work()
    assert capsys.readouterr().err == ""


def test_progress_that_fails_ends_the_work_with_its_own_error(monkeypatch):
    import tqdm.auto

    class Broken:
        def __init__(self, **_):
            raise ZeroDivisionError("no bar")

    monkeypatch.setattr(tqdm.auto, "tqdm", Broken)
    with pytest.raises(ZeroDivisionError, match="no bar"):
        long_work(progress=True)
    assert len(long_work(progress=False)) == 6


def test_what_a_person_should_read_goes_to_the_logger(tmp_path, caplog):
    axes = {"dx": [1.0, 2.0, 3.0]}
    with caplog.at_level(logging.WARNING, logger="squirmers"):
        table = squirmers.sweep("opposed", axes, "lt", out=tmp_path, time_limit=0.0)
    assert set(table["outcome"]) == {"skipped"}
    assert "3 of 3 rows are left" in caplog.text
