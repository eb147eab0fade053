"""Installed, everything lives under one name: packages of others come and go beside it."""

import re
import sys
import venv
import zipfile
from pathlib import Path

import pytest

from tests.packaging.builds import FOLDERS, ROOT, run_in, wheel_of

USE = (
    "import checker, properties, spec_model, supervisor; "
    "assert checker.mine and properties.mine and spec_model.mine and supervisor.mine"
)


def test_a_wheel_has_one_name_at_its_top(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {n.partition("/")[0] for n in names if ".dist-info/" not in n} == {"rovercheck"}
    assert {f"rovercheck/{f}/__init__.py" for f in FOLDERS} <= set(names)


def test_a_wheel_holds_every_file_of_the_folders_once(wheel: Path) -> None:
    """Also what no import names: tables, templates, kept runs, the script of the pages, the documentation."""
    names = [n for n in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in n]
    pages = run_in(ROOT, "git", "ls-files", "docs/*.md", "docs/*.svg").split()
    listed = [*run_in(ROOT, "git", "ls-files", "rovercheck", *FOLDERS).split(), *pages]
    here = {f if f.startswith("rovercheck/") else f"rovercheck/{f}" for f in listed}
    assert sorted(names) == sorted(here - {f"rovercheck/{f}" for f in FOLDERS})


def test_packages_of_others_come_and_go_beside_it(wheel: Path, tmp_path: Path) -> None:
    """One whose name is ``supervisor`` is a folder beside ours, and is removed without ours."""
    venv.create(tmp_path / "env", with_pip=False)
    python = str(tmp_path / "env" / "bin" / "python")
    [site] = run_in(tmp_path, python, "-c", "import site; print(site.getsitepackages()[0])").splitlines()
    pip = (sys.executable, "-m", "pip", "--python", python, "--disable-pip-version-check")
    install = (*pip, "install", "-qq", "--no-deps", "--no-index")
    theirs = _of_others(tmp_path)
    run_in(tmp_path, *install, str(theirs))
    run_in(tmp_path, *install, str(wheel))
    needed = Path(pytest.__file__).parents[1]
    Path(site, "needed.pth").write_text(f"{needed}\n")  # click and the others, which an index would bring
    work = tmp_path / "work"
    work.mkdir()
    run_in(work, python, "-c", USE)
    run_in(work, python, "-m", "rovercheck", "init", "heater")
    heat = (python, "-m", "rovercheck", "check", "HEAT-1", "--model", "heater/heater.py")
    proved = run_in(work, *heat)
    assert re.search(r"HEAT-1 +proved", proved)
    run_in(tmp_path, *pip, "uninstall", "-qq", "-y", "other")
    assert run_in(work, *heat) == proved
    run_in(tmp_path, *install, str(theirs))
    run_in(tmp_path, *pip, "uninstall", "-qq", "-y", "rovercheck")
    assert not Path(site, "rovercheck").exists()
    run_in(work, python, "-c", USE)


def _of_others(folder: Path) -> Path:
    """A wheel with a package for each name that our folders have."""
    source = folder / "other"
    for name in FOLDERS:
        (source / name).mkdir(parents=True)
        (source / name / "__init__.py").write_text("mine = True\n")
    (source / "pyproject.toml").write_text(
        '[build-system]\nrequires = ["hatchling"]\nbuild-backend = "hatchling.build"\n'
        '[project]\nname = "other"\nversion = "1"\n'
        f"[tool.hatch.build.targets.wheel]\npackages = {list(FOLDERS)}\n"
    )
    return wheel_of(source, folder)
