"""Wheels of this repository, and installations that have exactly what they are said to have."""

import re
import subprocess
import sys
import tomllib
import venv
import zipfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
FOLDERS = ("checker", "properties", "spec_model", "supervisor")


def run_in(at: Path, *command: str, env: Mapping[str, str] | None = None, code: int = 0) -> str:
    """What a program prints that ends with this exit code; where that is none of success, its messages."""
    done = subprocess.run(command, cwd=at, env=env, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stderr if code else done.stdout


def wheel_of(source: Path, folder: Path) -> Path:
    """The wheel that is built of the sources in a folder."""
    run_in(source, sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder))
    [built] = folder.glob("*.whl")
    return built


def project() -> dict[str, Any]:
    """The table ``project`` of pyproject.toml."""
    found: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return found


def pinned(lock: str) -> dict[str, str]:
    """The packages of a list, each with its version, that are installed on this system."""
    lines = (ROOT / lock).read_text(encoding="utf-8").splitlines()
    found = [re.match(r"([a-z0-9-]+)==([^ ;]+)(?: ; (.*?))? *\\$", line) for line in lines]
    return {one[1]: one[2] for one in found if one and "win32" not in (one[3] or "")}


def core_environment(wheel: Path, folder: Path) -> Path:
    """The Python of an environment with the wheel and what requirements-core.lock names, and nothing else.

    What is installed here is linked, so that it needs no network.
    """
    venv.create(folder, with_pip=False)
    python = folder / "bin" / "python"
    [site] = run_in(folder, str(python), "-c", "import site; print(*site.getsitepackages())").splitlines()
    for package in pinned("requirements-core.lock"):
        for name, place in _tops(package):
            target = Path(site, name)
            if not target.exists():
                target.symlink_to(place)
    with zipfile.ZipFile(wheel) as files:
        files.extractall(site)
    return python


def _tops(package: str) -> Iterator[tuple[str, Path]]:
    """What a package has at the top of the folder in which it is installed."""
    found = distribution(package)
    names = {file.parts[0] for file in found.files or ()} - {"..", "__pycache__"}
    yield from ((name, Path(str(found.locate_file(name))).resolve()) for name in names)
