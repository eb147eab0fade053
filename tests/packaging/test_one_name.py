"""Installed, everything lives under one name: packages of others come and go beside it."""

import re
import subprocess
import sys
import venv
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDERS = ("checker", "properties", "spec_model", "supervisor")
USE = (
    "import checker, properties, spec_model, supervisor; "
    "assert checker.mine and properties.mine and spec_model.mine and supervisor.mine"
)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of this repository, built as an index would get it: from its sdist."""
    folder = tmp_path_factory.mktemp("dist")
    _run(sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", str(folder), at=ROOT)
    [archive] = folder.glob("*.tar.gz")
    _run("tar", "-xzf", str(archive), at=folder)
    [source] = (p for p in folder.iterdir() if p.is_dir())
    _run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder), at=source)
    [built] = folder.glob("*.whl")
    return built


def _run(*command: str, at: Path, env: Mapping[str, str] | None = None) -> str:
    done = subprocess.run(command, cwd=at, env=env, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_wheel_has_one_name_at_its_top(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {n.partition("/")[0] for n in names if ".dist-info/" not in n} == {"rovercheck"}
    assert {f"rovercheck/{f}/__init__.py" for f in FOLDERS} <= set(names)


def test_a_wheel_holds_every_file_of_the_folders_once(wheel: Path) -> None:
    """Also what no import names: tables, templates, kept runs, the script of the pages."""
    names = [n for n in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in n]
    listed = _run("git", "ls-files", "rovercheck", *FOLDERS, at=ROOT).split()
    here = {f if f.startswith("rovercheck/") else f"rovercheck/{f}" for f in listed}
    assert sorted(names) == sorted(here - {f"rovercheck/{f}" for f in FOLDERS})


def test_packages_of_others_come_and_go_beside_it(wheel: Path, tmp_path: Path) -> None:
    """One whose name is ``supervisor`` is a folder beside ours, and is removed without ours."""
    venv.create(tmp_path / "env", with_pip=False)
    python = str(tmp_path / "env" / "bin" / "python")
    [site] = _run(python, "-c", "import site; print(site.getsitepackages()[0])", at=tmp_path).splitlines()
    pip = (sys.executable, "-m", "pip", "--python", python, "--disable-pip-version-check")
    install = (*pip, "install", "-qq", "--no-deps", "--no-index")
    theirs = _of_others(tmp_path)
    _run(*install, str(theirs), at=tmp_path)
    _run(*install, str(wheel), at=tmp_path)
    needed = Path(pytest.__file__).parents[1]
    Path(site, "needed.pth").write_text(f"{needed}\n")  # click and the others, which an index would bring
    work = tmp_path / "work"
    work.mkdir()
    _run(python, "-c", USE, at=work)
    _run(python, "-m", "rovercheck", "init", "heater", at=work)
    heat = (python, "-m", "rovercheck", "check", "HEAT-1", "--model", "heater/heater.py")
    proved = _run(*heat, at=work)
    assert re.search(r"HEAT-1 +proved", proved)
    _run(*pip, "uninstall", "-qq", "-y", "other", at=tmp_path)
    assert _run(*heat, at=work) == proved
    _run(*install, str(theirs), at=tmp_path)
    _run(*pip, "uninstall", "-qq", "-y", "rovercheck", at=tmp_path)
    assert not Path(site, "rovercheck").exists()
    _run(python, "-c", USE, at=work)


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
    _run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder), at=source)
    [built] = folder.glob("other-*.whl")
    return built
