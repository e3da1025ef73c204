"""What the README and the pages claim of the Python package."""

import re
import subprocess
import sys

import pytest
import squirmers


def blocks(text):
    return re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)


def test_readme_the_example_prints_the_deflections_of_the_readme_s_table(project, capsys):
    text = (project / "README.md").read_text()
    (example,) = blocks(text.split("## From Python")[1].split("\n## ")[0])
    assert len([line for line in example.splitlines() if line]) <= 10
    exec(compile(example, "README.md", "exec"), {})
    lubrication, exact = capsys.readouterr().out.splitlines()
    row = next(line for line in text.splitlines() if line.startswith("| opposed, β = 5, δx = 1 |"))
    published, _, _, referee = [cell.strip() for cell in row.split("|")[2:-1]]
    assert f"scattered, {published} and {published} degrees" in lubrication
    assert f"scattered, {referee} and {referee} degrees" in exact


def test_readme_the_example_of_the_package_runs(project, capsys):
    (example,) = blocks((project / "python" / "README.md").read_text())
    exec(compile(example, "README.md", "exec"), {})
    assert capsys.readouterr().out.startswith("scattered [-11.698")


def test_readme_what_the_page_on_python_shows_runs(project, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = (project / "fixtures" / "scenes" / "fig6-head-on-dx1.toml").read_text()
    (tmp_path / "scene.toml").write_text(scene)
    names = {}
    shown = blocks((project / "docs" / "PYTHON.md").read_text())
    for block in shown:
        exec(compile(block, "PYTHON.md", "exec"), names)
    assert len(shown) == 4
    assert len(names["table"]) == 18 and names["model"].name == "mine"


def test_readme_the_function_of_the_page_on_judging_is_judged(project, capsys):
    page = (project / "docs" / "JUDGE.md").read_text()
    section = page.split("### A function in Python")[1].split("\n## ")[0]
    for block in blocks(section):
        exec(compile(block, "JUDGE.md", "exec"), {})
    # Right far apart, and no lubrication: that is what a far field is.
    said = capsys.readouterr().out
    assert said.startswith("far is within 1 % down to a gap of") and "Fault (missing lubrication)" in said


def test_importing_the_package_imports_nothing_large():
    large = ("numpy", "pandas", "matplotlib", "xarray", "tqdm", "typing", "dask", "logging")
    code = f"import sys; before = set(sys.modules); import squirmers; print([m for m in {large} if m in set(sys.modules) - before])"
    found = subprocess.run([sys.executable, "-S", "-c", code], capture_output=True, text=True, env={"PYTHONPATH": ":".join(sys.path)})
    assert found.stdout.strip() == "[]", found.stderr


def test_all_names_are_there_and_have_pages(project):
    page = (project / "docs" / "API.md").read_text()
    for name in squirmers.__all__:
        assert getattr(squirmers, name) is not None
        if name != "__version__":
            assert re.search(rf":: {name}$", page, flags=re.MULTILINE), f"docs/API.md lacks {name}"
            assert getattr(squirmers, name).__doc__, name


@pytest.mark.parametrize("name", [name for name in squirmers.__all__ if name != "__version__"])
def test_examples_in_the_documentation_give_what_they_say(name):
    import doctest

    finder = doctest.DocTestFinder(recurse=True)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in finder.find(getattr(squirmers, name), name, module=False):
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0


