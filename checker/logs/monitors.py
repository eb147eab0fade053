"""Every property that speaks of logged signals as a monitor of the log, block by block."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np

from rovercheck.checker.conformance.cones import measured
from rovercheck.checker.conformance.mismatch import shown
from rovercheck.checker.conformance.recording import Cells, LogBlock
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs.form_monitors import Judge
from rovercheck.checker.logs.formula import Array, FormulaRows
from rovercheck.checker.logs.selection import MonitoredProperty, PropertySelection, Wires
from rovercheck.properties.forms import Form, Never, Property, Reachable
from rovercheck.properties.pasttime import Bounded
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.walk import outermost, variables


@dataclass(frozen=True)
class FirstViolation:
    """Where a property was first broken (or reached): its parts that are false, and the values there."""

    tick: int
    line: int
    parts: tuple[str, ...]
    values: Mapping[str, str]


LogWord = Literal["satisfied", "violated", "never triggered", "reached", "not reached"]


@dataclass
class LogVerdict:
    """What a log says of a property.

    ``count``: the ticks in which it is broken; ``tested``: those in which it was put to the test at all;
    ``expected``: the expected verdict.
    """

    prop: Property
    first: FirstViolation | None = None
    count: int = 0
    tested: int = 0
    judged: int = 0
    expected: str = "proved"

    @property
    def word(self) -> LogWord:
        """``violated``, ``satisfied`` or ``never triggered``; ``reached`` or ``not reached``."""
        if isinstance(self.prop.form, Reachable):
            return "reached" if self.count else "not reached"
        return "violated" if self.count else "satisfied" if self.tested else "never triggered"


class LogMonitors:
    """All monitors of one log."""

    def __init__(
        self, vocabulary: Vocabulary, choice: PropertySelection, known: frozenset[str], from_power_up: bool
    ) -> None:
        self._judges = [(c, Judge(c.property), LogVerdict(c.property)) for c in choice.monitored]
        self._wires = Wires(vocabulary).of(known)
        self._outputs = {o.name: o for o in vocabulary.board.outputs if o.var.name in known}
        self._rounded = frozenset(o.var.name for o in self._outputs.values() if measured(o))
        if not from_power_up:
            for _, judge, _ in self._judges:
                judge.gap()

    def verdicts(self) -> tuple[LogVerdict, ...]:
        return tuple(verdict for _, _, verdict in self._judges)

    def columns(self, block: LogBlock, seen: Mapping[str, Cells]) -> dict[str, Array]:
        """The values of all variables that are known, as numbers; not a number where a cell is empty."""
        found = {name: np.array(cells, dtype=np.float64) for name, cells in seen.items()}
        for name, output in self._outputs.items():
            found[output.var.name] = np.array(block.values[name], dtype=np.float64)
        rows = FormulaRows(found, len(block), self._rounded)
        past = Judge(_NOTHING).past
        for wire in self._wires:
            value = np.broadcast_to(rows.value(wire.value, past), (len(block),)).astype(np.float64)
            unknown = [np.isnan(found[name]) for name in variables(wire.value)]
            found[wire.var.name] = (
                np.where(np.logical_or.reduce(unknown), np.nan, value) if unknown else value
            )
        self._leave_open(found, rows)
        return found

    def _leave_open(self, found: dict[str, Array], rows: FormulaRows) -> None:
        """What the charts give up says nothing."""
        past = Judge(_NOTHING).past
        for output in self._outputs.values():
            if output.unless is not FALSE and set(variables(output.unless)) <= found.keys():
                given_up = rows.truth(output.unless, past)
                found[output.var.name] = np.where(given_up, np.nan, found[output.var.name])

    def block(self, block: LogBlock, columns: Mapping[str, Array]) -> None:
        """Judge the rows of a block."""
        unknown = {name: missing for name, values in columns.items() if (missing := np.isnan(values)).any()}
        gaps = [i for i, missing in enumerate(block.missing) if missing]
        for start, end in zip([0, *gaps], [*gaps, len(block)], strict=True):
            if start < end or not start:
                self._stretch(
                    _Stretch(block, columns, unknown, self._rounded, start, end), bool(block.missing[start])
                )

    def _stretch(self, stretch: "_Stretch", after_gap: bool) -> None:
        for chosen, judge, verdict in self._judges:
            if after_gap:
                judge.gap()
            for after_hole, rows, places in stretch.runs(chosen):
                if after_hole:
                    judge.gap()
                if rows.count:
                    self._judge(judge, verdict, rows, places, stretch)

    def _judge(
        self, judge: Judge, verdict: LogVerdict, rows: FormulaRows, places: Array, stretch: "_Stretch"
    ) -> None:
        bad, tested = judge.advance(rows)
        verdict.judged += rows.count
        verdict.tested += int(np.count_nonzero(np.broadcast_to(tested, (rows.count,))))
        broken = int(np.count_nonzero(bad))
        if broken and verdict.first is None:
            row = int(np.argmax(bad))
            verdict.first = _broken(judge, rows, row, stretch.block, int(places[row]))
        verdict.count += broken


class _Stretch:
    """Rows of a block without a missing step between them."""

    def __init__(
        self,
        block: LogBlock,
        columns: Mapping[str, Array],
        unknown: Mapping[str, Array],
        rounded: frozenset[str],
        start: int,
        end: int,
    ) -> None:
        self._rounded = rounded
        self.block, self.start, self.end = block, start, end
        self._columns, self._unknown = columns, unknown
        self._rows: dict[int, tuple[FormulaRows, Array]] = {}

    def runs(self, chosen: MonitoredProperty) -> list[tuple[bool, FormulaRows, Array]]:
        """The steps in which the charts of a property execute, cut where something it reads is not known.

        Each run tells whether there is such a hole in front of it; the last may be empty.
        """
        holes = [self._unknown[name][self.start : self.end] for name in chosen.names if name in self._unknown]
        hole = np.logical_or.reduce(holes) if holes else None
        if hole is None or not hole.any():
            return [(False, *self._all(chosen.gate))]
        gate = self._gate(chosen.gate)
        edges = np.flatnonzero(np.diff(np.concatenate(([True], hole, [True])))).tolist()
        known = list(zip(edges[::2], edges[1::2], strict=True))
        if hole[-1]:
            known.append((len(hole), len(hole)))
        return [(a > 0, *self._taken(gate, a, b)) for a, b in known]

    def _all(self, gate: Expr | None) -> tuple[FormulaRows, Array]:
        key = 0 if gate is None else id(gate)
        if key not in self._rows:
            self._rows[key] = self._taken(self._gate(gate), 0, self.end - self.start)
        return self._rows[key]

    def _gate(self, gate: Expr | None) -> Array:
        count = self.end - self.start
        if gate is None:
            return np.ones(count, dtype=np.bool_)
        here = {name: self._columns[name][self.start : self.end] for name in variables(gate)}
        return FormulaRows(here, count).truth(gate, Judge(_NOTHING).past)

    def _taken(self, gate: Array, start: int, end: int) -> tuple[FormulaRows, Array]:
        places = np.flatnonzero(gate[start:end]) + start + self.start
        if len(places) == self.end - self.start:
            taken = {name: values[self.start : self.end] for name, values in self._columns.items()}
        else:
            taken = _Taken(self._columns, places)
        return FormulaRows(taken, len(places), self._rounded), places


class _Taken(dict[str, Array]):
    """Some rows of the columns, each taken when first read."""

    def __init__(self, columns: Mapping[str, Array], places: Array) -> None:
        super().__init__()
        self._columns, self._places = columns, places

    def __missing__(self, name: str) -> Array:
        self[name] = found = self._columns[name][self._places]
        return found


_NOTHING = Property("", "", Never(FALSE), (), "")


# --- what is false ---------------------------------------------------------------------------------


def _broken(judge: Judge, rows: FormulaRows, row: int, block: LogBlock, place: int) -> FirstViolation:
    wanted, negated = required(judge.property.form)
    false = [p for p in outermost(wanted) if bool(rows.truth(p, judge.past)[row]) == negated]
    read = variables(wanted)
    values = {name: _shown(var, rows.columns[name][row]) for name, var in read.items()}
    return FirstViolation(block.ticks[place], block.lines[place], tuple(text(p) for p in false), values)


def required(form: Form) -> tuple[Expr, bool]:
    """What must be true where the property is broken, and whether it must be false instead."""
    if isinstance(form, Never | Reachable):
        return form.that, True
    assert isinstance(form, Bounded) and form.wanted is not None, "no finite run breaks it"
    return form.wanted, False


def _shown(var: Var, value: float) -> str:
    return (
        "?" if np.isnan(value) else shown(var.domain, int(value) if value == int(value) else Fraction(value))
    )
