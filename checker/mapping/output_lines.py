"""The lines of C that assign to a place of a map: where to look when an output is wrong."""

import re
from functools import cache
from pathlib import Path

from rovercheck.checker.mapping.places import CLeaves
from rovercheck.checker.mapping.source import declarations
from rovercheck.spec_model.lang.place import Place


def assigning_lines(sources: Path, at: str) -> tuple[Place, ...]:
    """The assignments to a place, as a map writes it, in the sources of a folder, or of the folder of a file.

    Without the declaration of the place, as where a header lies elsewhere, those to the same name.  Raises
    ``OSError`` for a source that cannot be read, ``ImportError`` without the extra ``firmware``.
    """
    leaves = _leaves(sources if sources.is_dir() else sources.parent)
    wanted = _bare(at)
    found = next((leaf for leaf in leaves.all if _bare(leaf.at) == wanted), None)
    assigned = leaves.assigned(found) if found is not None else leaves.assigned_at(_path(wanted))
    lines = {(str(one.file), one.line) for one in assigned}
    return tuple(Place(file, line) for file, line in sorted(lines))


@cache
def _leaves(folder: Path) -> CLeaves:
    return CLeaves(declarations(folder))


def _bare(at: str) -> str:
    """An expression without blanks, and without brackets around all of it."""
    text = re.sub(r"\s+", "", at)
    return text[1:-1] if text.startswith("(") and text.endswith(")") else text


def _path(at: str) -> str:
    """The path of an expression in assignments: without indexes, by members alone."""
    return re.sub(r"\[[^\]]*\]", "[]", at.replace("->", "."))


__all__ = ["assigning_lines"]
