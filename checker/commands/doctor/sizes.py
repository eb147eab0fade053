"""How much room packages take on the disk, as they are installed here."""

import re
from contextlib import suppress
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from importlib.util import cache_from_source
from os import stat

NAME = re.compile(r"[\w.-]+")
"""The name at the beginning of a requirement (PEP 508)."""


def size(package: str) -> int:
    """Bytes of the files that were installed with a package; 0 where it, or their list, is missing."""
    try:
        return _size(distribution(package))
    except PackageNotFoundError:
        return 0


def installation(package: str) -> int:
    """Bytes of a package with all that it requires, without extras."""
    found: dict[str, int] = {}
    todo = [package]
    while todo:
        name = todo.pop()
        try:
            one = distribution(name)
        except PackageNotFoundError:  # required on other systems only, or missing, which is told elsewhere
            continue
        key = re.sub(r"[-_.]+", "-", one.name).lower()
        if key not in found:
            found[key] = _size(one)
            todo += [named[0] for needed in one.requires or () if (named := _plain(needed))]
    return sum(found.values())


def shown(count: int) -> str:
    """``31 MB``, ``2.5 MB``, ``40 kB``, in powers of ten."""
    if count < 1e6:
        return f"{count / 1e3:.0f} kB"
    return f"{count / 1e6:.0f} MB" if count >= 1e7 else f"{count / 1e6:.1f} MB"


def _plain(requirement: str) -> re.Match[str] | None:
    """The name in a requirement that is no extra's."""
    return None if re.search(r";.*\bextra\b", requirement) else NAME.match(requirement)


def _size(one: Distribution) -> int:
    """What is listed, and what Python compiled of it, which only some installers list too."""
    listed = {str(one.locate_file(file)) for file in one.files or ()}
    compiled = {cache_from_source(file) for file in listed if file.endswith(".py")}
    total = 0
    for file in listed | compiled:
        with suppress(OSError):  # taken away since, or not compiled
            total += stat(file).st_size
    return total
