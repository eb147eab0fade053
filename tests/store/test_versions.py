"""What decides is in the key: every module that a search imports, or why it need not be."""

import os
import subprocess
import sys
from importlib.metadata import packages_distributions
from pathlib import Path
from time import time

import pytest

from rovercheck.checker.store import versions
from rovercheck.checker.store.tree import FOLDERS, tree_key
from rovercheck.checker.store.versions import (
    PACKAGES,
    SOURCES,
    ChangedMeanwhile,
    as_loaded,
    deciding,
    installed,
    sources,
)

ROOT = Path(__file__).parents[2]
LEFT_OUT = {
    "checker/__init__.py": "a docstring",
    "checker/extras.py": "which package is to be installed, for a message",
    "checker/model": "where models and their files are; a run that is kept there is SOURCES' kept_runs",
    "properties/__init__.py": "a docstring",
    "properties/expected.py": "expected verdicts are compared anew every time",
    "properties/hazards.py": "how grave a finding is, for readers",
    "properties/requirements.py": "texts of requirements, for readers",
    "spec_model/__init__.py": "a docstring",
}
"""Modules that a search imports and that no verdict depends on, and why."""
LOADED = """
import sys
from rovercheck.checker.engines import Limits, engines
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.checker.verify.search_worker import SearchWorker
from rovercheck.properties.forms import always, leads_to, reachable
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import in_order

from rovercheck.checker.certify import solver
from rovercheck.checker.search import runner

def here(work, *args, seconds=None, memory=None, modules=()):
    sent = []
    work(sent.append, *args)
    return iter(sent)

runner.messages = solver.messages = here  # what engines load in children of their own is seen, too
go, lit = flag("go"), flag("lit")
system = in_order("lamp", Block("Lamp", [assign(lit, go)]))
props = (
    always("A", "", that=lit | ~lit, covers=["R"], on="lamp"),
    reachable("B", "", that=lit, covers=["R"], on="lamp"),
    always("C", "", that=~lit, covers=["R"], on="lamp"),
    leads_to("D", "", trigger=go, response=lit, covers=["R"], on="lamp"),
)
said = []
for engine in ("auto", *engines()):
    work = SearchWorker({"lamp": system}, engine, Limits(depth=5), None, VerdictStore(engine))
    work(said.append, "lamp", props[:3])
    work(said.append, "lamp", props[3:])
assert sum(type(one).__name__ == "PropertyDecided" for one in said) >= 4, said
for name, module in sorted(sys.modules.items()):
    if getattr(module, "__file__", None):
        print(module.__file__)
"""


def loaded(tmp_path: Path) -> set[str]:
    """The files that a search in a child has loaded."""
    environment = {**os.environ, "ROVERCHECK_CACHE": str(tmp_path / "cache")}
    run = subprocess.run(
        [sys.executable, "-c", LOADED], capture_output=True, text=True, cwd=ROOT, env=environment, check=False
    )
    assert run.returncode == 0, run.stderr
    paths = (Path(line).resolve() for line in run.stdout.splitlines())
    return {p.as_posix() for p in paths}


def test_every_module_that_a_search_imports_enters_or_it_is_said_why_not(tmp_path: Path) -> None:
    known = {path.resolve().relative_to(ROOT).as_posix() for path in sources()}
    paths = (Path(path) for path in loaded(tmp_path))
    found = {
        p.relative_to(ROOT).as_posix() for p in paths if p.is_relative_to(ROOT) and ".venv" not in p.parts
    }
    assert "checker/verify/search_worker.py" in found and "spec_model/lang/lower/__init__.py" in found
    strange = sorted(
        name
        for name in found - known
        if not any(name == left or name.startswith(f"{left}/") for left in LEFT_OUT)
        and not name.startswith("rovercheck/")
    )
    assert not strange, "in neither versions.SOURCES nor LEFT_OUT"
    used = [left for left in LEFT_OUT if any(name == left or name.startswith(f"{left}/") for name in found)]
    assert used == [*LEFT_OUT], "some of LEFT_OUT are not imported any more"


NO_PART = {
    "setuptools": "how the library of z3 is found",
    "typing_extensions": "records of JSON documents",
}
"""Packages of others that a search imports and that no verdict depends on, and why."""


def test_every_package_that_a_search_imports_enters_or_it_is_said_why_not(tmp_path: Path) -> None:
    packages = packages_distributions()
    tops = {
        path.partition("site-packages/")[2].partition("/")[0].partition(".")[0] for path in loaded(tmp_path)
    }
    found = {name.lower().replace("-", "_") for top in tops for name in packages.get(top, ())}
    assert {"llvmlite", "numpy", "z3_solver", "python_sat", "oxidd"} <= found
    assert sorted(found - {*PACKAGES} - {*NO_PART}) == []
    named = [name for name in PACKAGES if any(one.lower().startswith(f"{name}-") for one in installed())]
    assert named == [*PACKAGES], "one of them is not seen"


def test_what_is_named_is_there() -> None:
    for name in SOURCES:
        assert (ROOT / name).exists(), name
    for name in FOLDERS:
        assert (ROOT / name).is_dir(), name


def test_charts_and_properties_are_no_part_of_what_decides() -> None:
    """An edit of a chart must not throw away what is kept of the others."""
    names = [path.resolve().relative_to(ROOT).as_posix() for path in sources()]
    assert len(names) > 100
    allowed = ("properties/forms.py", "properties/pasttime.py", "properties/reduce.py", "spec_model/lang/")
    assert [
        n for n in names if n.startswith(("properties/", "spec_model/")) and not n.startswith(allowed)
    ] == []


# --- files that change -------------------------------------------------------------------------------


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A small project in the place of this one."""
    for name in SOURCES:
        place = tmp_path / name if name.endswith(".py") else tmp_path / name / "one.py"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text("x = 1\n", encoding="utf-8")
        os.utime(place, (1_000_000_000, 1_000_000_000))
    monkeypatch.setattr(versions, "_ROOT", tmp_path)
    return tmp_path


def now() -> str:
    return deciding.__wrapped__()


def test_an_edit_of_what_decides_is_another_key_and_its_undoing_the_old_one(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(versions, "_LOADED", 1e12)
    first, file = now(), project / "checker/search/one.py"
    file.write_text("x = 2\n", encoding="utf-8")
    second = now()
    (project / "checker/search/two.py").write_text("", encoding="utf-8")
    third = now()
    (project / "checker/search/two.py").unlink()
    file.write_text("x = 1\n", encoding="utf-8")
    assert len({first, second, third}) == 3 and now() == first
    file.rename(file.with_name("other.py"))
    assert now() != first, "a module of another name is another one"


def test_a_module_edited_after_it_was_loaded_gives_no_key(project: Path) -> None:
    (project / "checker/search/one.py").write_text("x = 2\n", encoding="utf-8")
    os.utime(project / "checker/search/one.py")
    with pytest.raises(ChangedMeanwhile, match=r"one\.py has changed"):
        now()


def test_it_is_seen_that_a_module_was_edited_later(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between the key and the end of a search: a child may have loaded the new one."""
    monkeypatch.setattr(versions, "_LOADED", time() - 60)
    assert not as_loaded(), "these files were made just now"
    monkeypatch.setattr(versions, "_LOADED", time() + 1)
    assert as_loaded()
    later = time() + 5
    os.utime(project / "checker/search/one.py", (later, later))
    assert not as_loaded()
    (project / "checker/search/one.py").unlink()
    assert not as_loaded()


def test_a_module_put_in_its_place_with_an_old_date_gives_no_key(project: Path) -> None:
    """As ``cp -p``, ``rsync -a`` and ``mv`` do: the date of the contents is kept."""
    other = project / "other.py"
    other.write_text("x = 2\n", encoding="utf-8")
    os.utime(other, (1_000_000_000, 1_000_000_000))
    other.replace(project / "checker/search/one.py")
    with pytest.raises(ChangedMeanwhile):
        now()


def test_without_the_sources_there_is_no_key(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(versions, "_LOADED", 1e12)
    (project / "properties/forms.py").unlink()
    with pytest.raises(OSError, match=r"forms\.py"):
        now()


def test_another_package_or_another_python_is_another_key(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = now()
    (tmp_path / "z3_solver-99.0.dist-info").mkdir()
    monkeypatch.syspath_prepend(str(tmp_path))
    second = now()
    monkeypatch.setattr(sys, "version", "3.99.0 (nobody's)")
    assert len({first, second, now()}) == 3


# --- all files ---------------------------------------------------------------------------------------


def small_tree(root: Path) -> Path:
    for name in FOLDERS:
        (root / name / "sub").mkdir(parents=True)
        (root / name / "sub" / "chart.py").write_text("x = 1\n", encoding="utf-8")
        (root / name / "data.json").write_text("{}", encoding="utf-8")
    return root


def test_any_file_of_the_rover_changes_the_key_of_all(tmp_path: Path) -> None:
    root = small_tree(tmp_path)
    first = tree_key(root)
    seen = {first}
    for path in sorted(path for path in root.rglob("*") if path.is_file()):
        before = path.read_bytes()
        for contents in (before + b" ", b""):
            path.write_bytes(contents)
            seen.add(tree_key(root))
        path.write_bytes(before)
        assert tree_key(root) == first, "the old answer is back"
    assert len(seen) == 1 + 2 * 2 * len(FOLDERS)


def test_where_one_file_ends_and_the_next_begins_is_no_choice(tmp_path: Path) -> None:
    one, two = small_tree(tmp_path / "one"), small_tree(tmp_path / "two")
    (one / "checker" / "a").write_bytes(b"12")
    (two / "checker" / "a1").write_bytes(b"2")
    assert tree_key(one) != tree_key(two)
    (one / "checker" / "a").unlink()
    (two / "checker" / "a1").unlink()
    assert tree_key(one) == tree_key(two)
    (one / "checker" / "sub" / "chart.py").rename(one / "checker" / "chart.py")
    assert tree_key(one) != tree_key(two)


def test_what_python_writes_by_itself_does_not_enter(tmp_path: Path) -> None:
    root = small_tree(tmp_path)
    first = tree_key(root)
    (root / "checker" / "__pycache__").mkdir()
    (root / "checker" / "__pycache__" / "chart.pyc").write_bytes(b"1")
    assert tree_key(root) == first


def test_a_folder_that_cannot_be_read_gives_no_key(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="checker"):
        tree_key(tmp_path)
    root = small_tree(tmp_path)
    (root / "checker" / "gone").symlink_to("nowhere")
    with pytest.raises(OSError, match="gone"):
        tree_key(root)


def test_the_tree_of_this_project_is_that_of_the_modules() -> None:
    assert tree_key() == tree_key(ROOT)
