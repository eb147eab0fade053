"""What sources in C declare, as far as a mapping file needs it: types, variables, functions, assignments."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class CDeclared:
    """A name with its type as it is written: a variable, a member, a parameter, what a typedef stands for.

    ``type`` is ``double``, ``struct sensors``, a name of a typedef, or the key of an unnamed type;
    ``dimensions`` are as written.
    """

    name: str
    type: str
    dimensions: tuple[str, ...] = ()
    pointer: bool = False
    bits: str = ""
    const: bool = False
    comment: str = ""


@dataclass(frozen=True)
class CVariable:
    """A variable outside functions."""

    declared: CDeclared
    file: Path
    line: int
    static: bool
    extern: bool

    @property
    def in_header(self) -> bool:
        return self.file.suffix == ".h"


@dataclass(frozen=True)
class CAssignment:
    """An assignment in a function.

    Both sides are paths without their indexes, ``rtY.wheel_status[]``; what is reached by a pointer begins
    with its type, ``DW_Age_T::Stamp``.  ``source`` is "" unless it is a path, too.
    """

    target: str
    source: str
    function: str
    file: Path
    line: int
    conditional: bool


@dataclass(frozen=True)
class CFunction:
    """A function, declared or defined."""

    declared: CDeclared
    parameters: tuple[CDeclared, ...]
    file: Path
    line: int
    static: bool
    defined: bool
    calls: frozenset[str] = frozenset()

    @property
    def name(self) -> str:
        return self.declared.name

    @property
    def in_header(self) -> bool:
        return self.file.suffix == ".h"


@dataclass
class CDeclarations:
    """All that a folder of sources declares."""

    folder: Path
    sources: list[Path] = field(default_factory=list)
    headers: list[Path] = field(default_factory=list)
    members: dict[str, tuple[CDeclared, ...]] = field(default_factory=dict)
    typedefs: dict[str, CDeclared] = field(default_factory=dict)
    enumerators: dict[str, tuple[str, ...]] = field(default_factory=dict)
    macros: dict[str, str] = field(default_factory=dict)
    variables: list[CVariable] = field(default_factory=list)
    functions: list[CFunction] = field(default_factory=list)
    assignments: list[CAssignment] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)
    """Places that are no C by themselves, as ``file, line``: macros that stand for more than a value."""

    def resolved(self, type: str) -> tuple[str, tuple[str, ...], bool]:
        """A type without typedefs: what it is in the end, dimensions, whether it is a pointer."""
        dimensions: tuple[str, ...] = ()
        pointer = False
        for _ in range(len(self.typedefs) + 1):  # a typedef may name itself in code that is no C
            if type not in self.typedefs:
                break
            one = self.typedefs[type]
            dimensions, pointer = one.dimensions + dimensions, pointer or one.pointer
            type = one.type
        return type, dimensions, pointer

    def number(self, written: str) -> int | None:
        """The value of a dimension: a literal, or a macro or enumerator that stands for one."""
        for _ in range(8):
            text = written.strip().strip("()").rstrip("uUlL")
            try:
                return int(text, 0)
            except ValueError:
                if text not in self.macros:
                    break
                written = self.macros[text]
        return None

    def constants_of(self, type: str) -> tuple[str, ...]:
        """The constants that are values of a type: its enumerators, or macros that cast to it."""
        names: list[str] = [type]
        while names[-1] in self.typedefs:
            names.append(self.typedefs[names[-1]].type)
            if len(names) > len(self.typedefs) + 1:
                break
        for name in names:
            if name in self.enumerators:
                return self.enumerators[name]
            cast = tuple(m for m, body in self.macros.items() if f"({name})" in body.replace(" ", ""))
            if cast:
                return cast
        return ()


Files = Mapping[Path, bytes]
