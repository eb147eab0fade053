"""How a review page was made: the command, the versions, and what was checked."""

import sys
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from rovercheck.checker.commands.report import PageOptions
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.revisions import commit_of
from rovercheck.checker.model import Model
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render.review.model import ReviewOrigin

PACKAGES = ("rovercheck", "z3-solver", "bitwuzla", "llvmlite", "python-sat", "oxidd", "numpy", "networkx")
"""The tool, its solvers, and what else a verdict may rest on."""
MEANINGS = {
    Exit.AS_EXPECTED: "every verdict is as expected",
    Exit.FAILED: "a verdict is not as expected",
    Exit.INCONCLUSIVE: "a limit was reached",
    Exit.INTERNAL: "the proof of a verdict was rejected",
}


def origin(model: Model, variant: Variant, code: Exit, options: PageOptions) -> ReviewOrigin:
    """How the page is made; nothing about the machine or the time, unless the user gave a date."""
    meaning = MEANINGS[code]
    return ReviewOrigin(
        options.command,
        int(code),
        meaning,
        tuple(versions()),
        digests(model),
        options.date,
        variant.name,
        options.document,
        commit_of(model.path) if model.path else commit_of_rover(),
        options.reviewer,
        model.options,
        options.at_once,
    )


def commit_of_rover() -> str:
    """The commit of the rover's charts, as far as it is known."""
    return commit_of(_folder("spec_model"))


def versions() -> list[tuple[str, str]]:
    """The versions of Python and of each package that is installed."""
    found = [("Python", ".".join(map(str, sys.version_info[:3])))]
    for name in PACKAGES:
        try:
            found.append((name, version(name)))
        except PackageNotFoundError:
            found.append((name, "not installed"))
    return found


def digests(model: Model) -> tuple[tuple[str, str], ...]:
    """What was checked, as SHA-256 of its sources: each name and content, in the order of the names."""
    if model.path is not None:
        return ((str(model.name), digest(model.path)),)
    return tuple((name, digest(_folder(name))) for name in ("spec_model", "properties"))


def _folder(package: str) -> Path:
    found = find_spec(f"rovercheck.{package}")
    assert found is not None and found.submodule_search_locations
    return Path(next(iter(found.submodule_search_locations)))


def digest(place: Path) -> str:
    """SHA-256 of a file, or of all sources in a folder."""
    if place.is_file():
        return sha256(place.read_bytes()).hexdigest()
    whole = sha256()
    for file in sorted(f for f in place.rglob("*") if f.suffix in (".py", ".toml")):
        whole.update(f"{file.relative_to(place).as_posix()}\0".encode())
        whole.update(sha256(file.read_bytes()).digest())
    return whole.hexdigest()
