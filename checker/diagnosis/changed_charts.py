"""The systems of a model with the changes of a variant: what flies, to be checked."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from shlex import quote

from rovercheck.checker.conformance.numbers import is_number
from rovercheck.checker.diagnosis.change import KINDS, ChartChange, place_text
from rovercheck.checker.diagnosis.hypotheses import written_changes
from rovercheck.checker.diagnosis.variant import BoardVariant, WrittenChange, applied, found_change
from rovercheck.checker.diagnosis.wider_inputs import widened
from rovercheck.checker.mutate.places import formula_places
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.edit import in_block, in_expressions, in_system
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, Temporal
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import nodes, structure

WHOLE = ("interpretation", "repair")
"""Kinds that may concern several charts, and name the first of a system."""
FINE = "_ms"
"""What the name of an age ends with where it is counted to the ms."""


@dataclass(frozen=True)
class ChartChanges:
    """The changes of a variant, read from a file; ``board`` is the one that they are of, as drawn."""

    file: Path
    variant: BoardVariant
    board: Board

    @property
    def name(self) -> str:
        """``with variant.toml``; what no system shows is left out."""
        if not self.of_stamps:
            return self.board_name
        numbers = ", ".join(str(number) for number, _ in self.of_stamps)
        return f"{self.board_name} but for change{'s' * (len(self.of_stamps) > 1)} {numbers}"

    @property
    def board_name(self) -> str:
        """``with variant.toml``: a whole board has every change."""
        return f"with {self.file.name}"

    @property
    def options(self) -> str:
        """The option that makes a command be about the same charts."""
        return f"--variant {quote(str(self.file))}"

    @property
    def rows(self) -> tuple[tuple[str, ...], ...]:
        """What the file says: the board, then each change."""
        return (self.variant.board,), *(change.key for change in self.variant.changes)

    @cached_property
    def of_stamps(self) -> tuple[tuple[int, WrittenChange], ...]:
        """Changes of how stamps are taken, which the charts see as ages only, by their numbers."""
        return tuple((n, c) for n, c in self._numbered() if _is_of_stamp(c))

    def notes(self) -> Iterator[str]:
        """What verdicts on the changed charts do not show, and where the changes come from."""
        if self.variant.evidence:
            yield f"{self.file.name}: {self.variant.evidence}"
        for number, change in self.of_stamps:
            yield (
                f"{self.file.name}, change {number} ({KINDS[change.kind]} {place_text(change.at)}): verdicts "
                "leave it out, as the charts see ages and no stamps. compare and check-log follow it."
            )

    def applied(self, board: Board) -> Board:
        """A board with all changes that are of it.  Raises ``VariantError`` for one that does not fit."""
        return applied(board, self.variant, str(self.file)) if board.name == self.variant.board else board

    def touches(self, system: System) -> bool:
        """Whether a change concerns the system."""
        return any(self._concerns(change, system) for _, change in self._of_charts())

    def changed(self, system: System) -> System:
        """The system with the changes of its charts, its inputs wide enough for their limits.

        Raises ``ModelError`` for a change that cannot be made there.
        """
        made = system
        for number, change in self._of_charts():
            if self._concerns(change, made):
                try:
                    made = self._made(change, made)
                except ModelError as error:
                    where = f"{self.file.name}, change {number} ({change.kind} in {change.chart})"
                    raise ModelError(f"{where} cannot be made in {system.name}: {error}") from error
        return system if made is system else widened(_without_old_names(made, system), system, self._measured)

    @cached_property
    def _measured(self) -> frozenset[str]:
        """The inputs of which the board may hold any number."""
        return frozenset(v.var.name for v in self.board.interface.views if not v.signal.whole)

    def _made(self, change: WrittenChange, system: System) -> System:
        made = self._found(change, system).make()
        more = sorted(made.inputs.keys() - system.inputs.keys())
        if more and change.kind not in WHOLE:  # another interpretation may read more
            if all(map(is_number, more)):
                raise ModelError(f"{change.new} lies between the steps in which its charts count.")
            raise ModelError(f"it reads {', '.join(more)}, which the system does not have.")
        return made

    def _found(self, change: WrittenChange, system: System) -> ChartChange:
        if change.kind in WHOLE:
            for one in written_changes(self.board, system):
                if (one.kind, one.at, one.new) == (change.kind, change.at, change.new):
                    return one
        return found_change(self.board, system, _as_named(change, self.board, system))

    def _concerns(self, change: WrittenChange, system: System) -> bool:
        if change.kind in WHOLE:
            alike = written_changes(self.board, system)
            return any((one.kind, one.at, one.new) == (change.kind, change.at, change.new) for one in alike)
        here, drawn = (_part(of, change.chart) for of in (system, self.board.system))
        return here is not None and not (drawn is not None and _is_elsewhere(change, here, drawn))

    def _numbered(self) -> Iterator[tuple[int, WrittenChange]]:
        return enumerate(self.variant.changes, 1)

    def _of_charts(self) -> Iterator[tuple[int, WrittenChange]]:
        return ((n, c) for n, c in self._numbered() if not _is_of_stamp(c))


def _without_old_names(changed: System, drawn: System) -> System:
    """The changed system in which no formula has a name any more that says something else."""
    as_drawn = {part.name: part for part in parts(drawn.components)}
    for part in parts(changed.components):
        old = as_drawn.get(part.name)
        if old is not None and old is not part:
            changed = in_system(changed, part.name, partial(_unnamed, named=_named(old)))
    return changed


def _named(part: Chart | Block) -> dict[str, object]:
    formulas = (place.formula for place in formula_places(part))
    return {n.name: structure(n) for f in formulas for n in nodes(f) if isinstance(n, Named)}


def _unnamed(part: Chart | Block, named: Mapping[str, object]) -> Chart | Block:
    def walk(expr: Expr) -> Expr:
        match expr:
            case Named(name, body):
                same = name not in named or structure(body) == named[name]
                return expr if same else walk(body)
            case Apply(op, args, sort):
                return Apply(op, tuple(map(walk, args)), sort)
            case Temporal(_, arg, _, _) if arg is not None:
                return replace(expr, arg=walk(arg))
        return expr

    return in_block(part, walk) if isinstance(part, Block) else in_expressions(part, walk)


def _part(system: System, name: str) -> Chart | Block | None:
    return next((part for part in parts(system.components) if part.name == name), None)


def _is_elsewhere(change: WrittenChange, here: Chart | Block, drawn: Chart | Block) -> bool:
    """Whether a change is one of the parallel states that the chart of a system has not got."""
    if not (isinstance(here, Chart) and isinstance(drawn, Chart) and drawn.root.parallel):
        return False
    left = {state.name for state in drawn.root.states} - {state.name for state in here.root.states}
    if not left:
        return False
    kind, _, at = change.at.partition("/")
    if kind == "signal":
        staying = tuple(state for state in drawn.root.states if state.name not in left)
        return at not in drawn.with_root(replace(drawn.root, states=staying)).read
    return at.partition(".")[0].partition("/")[0] in left


def _as_named(change: WrittenChange, board: Board, system: System) -> WrittenChange:
    """The change as a system writes it whose ages are counted to the ms, under names of their own."""
    part = _part(system, change.chart)
    assert part is not None, "it is concerned"
    fine = {name for name in (*part.read, *part.written) if name.endswith(FINE)}
    known = {**board.system.inputs, **board.system.written}
    at, old, new = change.at, change.old, change.new
    for name in fine - known.keys():
        coarse = re.compile(rf"\b{re.escape(name.removesuffix(FINE))}\b")
        at, old, new = (coarse.sub(name, text) for text in (at, old, new))
    return replace(change, at=at, old=old, new=new)


def _is_of_stamp(change: WrittenChange) -> bool:
    return change.at.startswith("stamp/")


__all__ = ["ChartChanges"]
