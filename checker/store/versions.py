"""What decides, as one short key: rovercheck's own code and the versions of the packages that it uses.

A verdict is kept for the code that found it.  Charts and properties are no part of it: they are the question.
"""

import os
import platform
import sys
from functools import cache
from hashlib import sha256
from pathlib import Path
from time import time

_ROOT = Path(__file__).parents[2]
_LOADED = time()
"""When this module was loaded, in seconds of the clock that files are dated by."""
SOURCES = (
    "checker/cache",
    "checker/certify",
    "checker/encode",
    "checker/engines",
    "checker/io",
    "checker/model/kept_runs.py",
    "checker/process",
    "checker/results",
    "checker/search",
    "checker/store",
    "checker/system",
    "checker/verify",
    "properties/forms.py",
    "properties/pasttime.py",
    "properties/reduce.py",
    "spec_model/lang",
)
"""Files and folders of modules that take part in a verdict."""
PACKAGES = ("bitwuzla", "llvmlite", "networkx", "numpy", "oxidd", "python_sat", "z3_solver")
"""Packages of others that do, as their folders of metadata are called."""
BEGINNINGS = tuple(f"{name}-" for name in PACKAGES)


class ChangedMeanwhile(OSError):
    """A module that decides is no longer what was loaded."""


@cache
def deciding() -> str:
    """The key.  Raises ``OSError`` without the sources, and where one has changed since it was loaded."""
    digest = sha256()
    for path in sources():
        if changed(str(path)):
            raise ChangedMeanwhile(f"{path} has changed since it was loaded.")
        digest.update(f"{path.relative_to(_ROOT).as_posix()}\0".encode())
        digest.update(sha256(path.read_bytes()).digest())
    digest.update(repr((sys.version, platform.machine(), sys.platform, installed())).encode())
    return digest.hexdigest()


@cache
def everything() -> str:
    """The key of all that rovercheck is made of, charts and properties, too.  Raises ``OSError``."""
    digest = sha256(deciding().encode())
    for name in ("checker", "properties", "spec_model"):
        for path in sorted(p for p in (_ROOT / name).rglob("*") if p.suffix in (".py", ".toml", ".json")):
            if changed(str(path)):
                raise ChangedMeanwhile(f"{path} has changed since it was loaded.")
            digest.update(f"{path.relative_to(_ROOT).as_posix()}\0".encode())
            digest.update(sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def as_loaded() -> bool:
    """Whether no source has changed up to now: processes that were started meanwhile may have loaded it."""
    try:
        return not any(map(changed, _paths(_ROOT)))
    except OSError:
        return False


def changed(path: str) -> bool:
    """Whether a file has changed since this process was started.  Raises ``OSError`` if it is gone."""
    status = os.stat(path)
    return max(status.st_mtime, status.st_ctime) > _LOADED  # also what was put there with an older date


@cache
def _paths(root: Path) -> tuple[str, ...]:
    assert root == _ROOT, "the sources are those below the root"
    return tuple(map(str, sources()))


def sources() -> list[Path]:
    """The files of the modules that take part in a verdict, in order."""
    found: list[Path] = []
    for name in SOURCES:
        path = _ROOT / name
        found += path.rglob("*.py") if path.is_dir() else [path]
    return sorted(found)


def installed() -> list[str]:
    """The packages that take part in a verdict, each with its version, as their folders are called."""
    found = set[str]()
    for place in map(Path, filter(None, sys.path)):
        if place.is_dir():
            named = (path.name for path in place.glob("*.dist-info"))
            found |= {name for name in named if name.lower().startswith(BEGINNINGS)}
    return sorted(found)
