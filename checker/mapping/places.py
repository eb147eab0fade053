"""The places of a firmware that can hold a signal: every number in its variables, member by member."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from rovercheck.checker.mapping.declarations import CAssignment, CDeclarations, CDeclared
from rovercheck.checker.mapping.words import words

DEEPEST = 6
MOST_ELEMENTS = 32
"""Elements of an array that are looked at; longer ones hold no signals by element."""
FLOATING = re.compile(r"float|double|real", re.I)
BOOLEAN = re.compile(r"bool", re.I)
INTEGER = re.compile(r"int|char|short|long|unsigned|signed|size_t|^[us]\d+$|byte|word|^enum ", re.I)
INPUT = frozenset({"u", "in", "input", "inputs", "rx", "sensors", "sensor", "meas", "measured"})
OUTPUT = frozenset({"y", "out", "output", "outputs", "tx", "actuators", "actuator", "result"})
STATE = frozenset({"dw", "state", "states", "rtdw", "ctx", "context", "internal", "priv", "mem"})


@dataclass(frozen=True)
class CLeaf:
    """A number that a variable holds.

    ``path`` is that of assignments, ``reached`` the same by the type of what it is in, from the innermost.
    ``kind``: float, boolean, integer or unknown.  ``array``, ``index``: what it is an element of, and which.
    """

    at: str
    path: str
    reached: tuple[str, ...]
    root: str
    words: tuple[str, ...]
    root_words: tuple[str, ...]
    type: str
    kind: str
    constants: tuple[str, ...] = ()
    comment: str = ""
    array: str = ""
    index: int = 0
    size: int = 0
    bits: str = ""
    hidden: str = ""
    """Why it cannot be named in a map: static, or of a type of one file."""

    @property
    def role(self) -> str:
        """What the names of its variable say: input, output, state or ""."""
        own = set(self.root_words)
        for role, known in (("state", STATE), ("input", INPUT), ("output", OUTPUT)):
            if own & known:
                return role
        return ""


class CLeaves:
    """Every place of a firmware, and who assigns to it."""

    def __init__(self, found: CDeclarations, more: tuple[tuple[CDeclared, str], ...] = ()) -> None:
        """``more``: variables that the map itself declares, with the role that they have."""
        self._found = found
        self.skipped: list[str] = []
        self.all = [*self._variables(), *self._own(more)]
        self._written: dict[str, list[CAssignment]] = {}
        for one in found.assignments:
            self._written.setdefault(one.target, []).append(one)

    def assigned(self, leaf: CLeaf) -> list[CAssignment]:
        """The assignments to a place in the code, also to the whole of what it is in."""
        return self._of(leaf.path, leaf.reached)

    def assigned_at(self, path: str) -> list[CAssignment]:
        """The assignments to a path, whether or not it is declared."""
        return self._of(path, ())

    def copied_from(self, leaf: CLeaf) -> Iterator[tuple[CLeaf, CAssignment]]:
        """Places whose value the code hands on to this one, directly or by way of one variable of its own."""
        by_path = {one.path: one for one in self.all}
        for one in self.assigned(leaf):
            if one.source in by_path:
                source = by_path[one.source]
                if not source.hidden:
                    yield source, one
                    continue
            for before in self._written.get(one.source, []):
                if before.source in by_path and not by_path[before.source].hidden:
                    yield by_path[before.source], before

    def _of(self, path: str, reached: tuple[str, ...]) -> list[CAssignment]:
        wholes = [path[: m.start()] for m in re.finditer(r"[.\[]", path)]
        found = [*self._written.get(path, [])]
        for name in (*reached, *wholes):
            found += self._written.get(name, [])
        return found

    def _variables(self) -> Iterator[CLeaf]:
        seen: set[str] = set()
        # What a header declares can be named; else what a file defines, by a declaration in the map.
        for one in sorted(self._found.variables, key=lambda v: (not v.in_header, v.static)):
            name = one.declared.name
            if name in seen or one.declared.const:
                continue
            seen.add(name)
            hidden = f"static in {one.file.name}" if one.static and not one.in_header else ""
            if not hidden and not one.in_header and "@" in self._found.resolved(one.declared.type)[0]:
                hidden = f"in no header, and of a type that only {one.file.name} has"
            yield from (replace(leaf, hidden=hidden) for leaf in self._below(one.declared, one.declared.name))

    def _own(self, more: tuple[tuple[CDeclared, str], ...]) -> Iterator[CLeaf]:
        for one, role in more:
            for leaf in self._below(one, one.name):
                yield replace(leaf, root_words=(*leaf.root_words, role))

    def _below(self, one: CDeclared, root: str) -> Iterator[CLeaf]:
        root_words = (*words(root), *words(one.type.replace("@", " ")))
        yield from self._leaves(one, root, root, (), (root, root_words, ()), 0)

    def _leaves(
        self,
        one: CDeclared,
        at: str,
        path: str,
        reached: tuple[str, ...],
        of: tuple[str, tuple[str, ...], tuple[str, ...]],
        depth: int,
        element: tuple[str, int, int] = ("", 0, 0),
    ) -> Iterator[CLeaf]:
        type, more, pointer = self._found.resolved(one.type)
        dimensions = (*one.dimensions, *more)
        if dimensions:
            size = self._found.number(dimensions[0])
            if size is None or size > MOST_ELEMENTS:
                self.skipped.append(f"{at}[{dimensions[0]}]")
                return
            inner = replace(one, dimensions=dimensions[1:], type=type)
            for n in range(size):
                below = tuple(f"{r}[]" for r in reached)
                yield from self._leaves(inner, f"{at}[{n}]", f"{path}[]", below, of, depth, (path, n, size))
            return
        root, root_words, name = of
        if type in self._found.members and depth < DEEPEST:
            join = "->" if one.pointer or pointer else "."
            for member in self._found.members[type]:
                deeper = (root, root_words, (*name, *words(member.name)))
                place = (f"{at}{join}{member.name}", f"{path}.{member.name}") if member.name else (at, path)
                below = (f"{type}::{member.name}", *(f"{r}.{member.name}" for r in reached))
                yield from self._leaves(member, *place, below, deeper, depth + 1, element)
        elif not (one.pointer or pointer or type in self._found.members):
            yield CLeaf(
                at, path, reached, root, name or words(one.name), root_words, one.type, _kind(one, type),
                self._found.constants_of(one.type), one.comment, *element, bits=one.bits,
            )  # fmt: skip


def _kind(one: CDeclared, type: str) -> str:
    for text in (one.type, type):
        if BOOLEAN.search(text):
            return "boolean"
    for text in (type, one.type):
        if FLOATING.search(text):
            return "float"
        if INTEGER.search(text):
            return "integer"
    return "unknown"
