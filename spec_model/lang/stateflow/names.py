"""The names that a label may use, and what they stand for: data, formulas, members, functions, charts."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from rovercheck.spec_model.lang.action import Action, call_of, each_action, expressions, writes
from rovercheck.spec_model.lang.array import Array
from rovercheck.spec_model.lang.chart import Chart, Path, State, Transition
from rovercheck.spec_model.lang.domain import Domain, Enum
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean
from rovercheck.spec_model.lang.expr import Const, Expr, Named, Var
from rovercheck.spec_model.lang.function import Function
from rovercheck.spec_model.lang.stateflow.message import Extent, LabelError, UnknownName
from rovercheck.spec_model.lang.walk import nodes, structure

Datum = Var | Named | Const | Array | Function | Chart | Domain
"""What a chart may list as its ``data``."""

_PLAIN = re.compile(r"[^\W\d]\w*(\.\w+)*")
_KEYWORDS = {"if", "else", "elseif", "end", "div", "mod", "true", "false"}
_BEFORE = re.compile(r"(?:^|[\[({,;!~&|?:=/\n]|\bif)\s*$")
"""What may precede a name that is no word, such as ``T in ]-5;55[``; elsewhere it is in parentheses."""
_AFTER = re.compile(r"[ \t]*(?:$|[\])},;&|?:{=!~\n])")
_TIMED = re.compile(r"(after|duration|held|rising)\(")
"""Names that read like a word about time: those of another state are not meant."""
_MASK, _REST = "\ue000", "\ue001"

T = TypeVar("T")


@dataclass(frozen=True)
class LabelNames:
    """What the names of a chart stand for.

    ``unclear`` are the names of several different formulas, of which none can be meant.
    """

    values: dict[str, Expr] = field(default_factory=dict)
    members: dict[str, list[Const]] = field(default_factory=dict)
    arrays: dict[str, Array] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)
    enumerations: dict[str, Enum] = field(default_factory=dict)
    charts: dict[str, Chart] = field(default_factory=dict)
    calls: dict[str, tuple[Action, ...]] = field(default_factory=dict)
    unclear: set[str] = field(default_factory=set)
    own: Chart | None = None

    def known(self) -> list[str]:
        """Every name that a formula may use."""
        return [*self.values, *self.members, *self.arrays, *self.functions, *self.charts]

    def add(self, datum: object) -> None:
        """Let a datum be known.  Raises ``ModelError`` for what is none, and for a name that is taken."""
        match datum:
            case Var(name) | Named(name):
                self._add_value(name, datum)
                self._add_sort(datum)
            case Array():
                self._once(self.arrays, datum.name, datum)
                for one in datum:
                    self.add(one)
            case Function():
                self._once(self.functions, datum.name, datum)
            case Domain(Enum() as enum, _):
                self._add_enum(enum)
            case Chart():
                self.charts[datum.name] = datum
                for place in datum.locations:
                    self.add(place)
            case _:
                raise ModelError(
                    f"data holds {brief(datum)}; write variables, named formulas, arrays, functions, charts "
                    "or enumerations."
                )

    def add_formulas(self, formulas: Iterable[Expr]) -> None:
        """Let everything be known that some formulas use."""
        for node in nodes(*formulas):
            if isinstance(node, Var | Named):
                self._add_value(node.name, node, found=True)
            self._add_sort(node)

    def _add_value(self, name: str, value: Expr, found: bool = False) -> None:
        before = self.values.setdefault(name, value)
        if before is value or _same(before, value):
            return
        if not found:
            raise ModelError(f"two data are named {name}: give each a name of its own.")
        self.unclear.add(name)

    def _once(self, table: dict[str, T], name: str, thing: T) -> None:
        if table.get(name, thing) is not thing:
            raise ModelError(f"two data are named {name}: give each a name of its own.")
        table[name] = thing

    def _add_sort(self, value: Expr) -> None:
        if isinstance(value.sort, Enum):
            self._add_enum(value.sort)

    def _add_enum(self, enum: Enum) -> None:
        if self.enumerations.get(enum.name) is enum:
            return
        self.enumerations.setdefault(enum.name, enum)
        for member, number in enum.members:
            known = self.members.setdefault(member, [])
            if all(one.sort != enum for one in known):
                known.append(Const(number, enum))

    # --- what a name in a text stands for ------------------------------------------------------

    def value(self, name: str, at: Extent) -> Expr | list[Const]:
        """A datum, or the members of that name.  Raises ``LabelError`` for an unknown name."""
        if name in self.unclear:
            raise LabelError(f"`{name}` is the name of two formulas; give each a name of its own.", at)
        if name in self.values:
            return self.values[name]
        enum, _, member = name.rpartition(".")
        if enum in self.enumerations:
            if member not in dict(self.enumerations[enum].members):
                near = did_you_mean(member, [m for m, _ in self.enumerations[enum].members])
                raise LabelError(f"`{member}` is no member of {enum}. {near}", at)
            sort = self.enumerations[enum]
            return Const(sort.number(member), sort)
        if name in self.members:
            return self.members[name]
        if name in self.arrays:
            raise LabelError(f"`{name}` is an array; write one of it, such as `{name}[0]`.", at)
        if name in self.functions:
            raise LabelError(f"`{name}` is a function; write `{self.functions[name].call}`.", at)
        raise UnknownName(name, self.near(name), at)

    def near(self, name: str) -> str:
        """What may have been meant by an unknown name."""
        known = self.known()
        if not known:
            return "Name what labels use in the chart's data=[...]."
        meant = did_you_mean(name, known)
        more = "" if meant.startswith("Did") else " Name what labels use in the chart's data=[...]."
        return f"{meant}{more}"

    def mask(self, text: str) -> tuple[str, dict[int, str]]:
        """The text with signs of as many letters in place of names that are no words, and what these were.

        The longest name counts that stands alone, as charts print it.
        """
        found = dict[int, str]()
        if (pattern := self._strange()) is None or _MASK in text:
            return text, found
        signs, at = list(text), 0
        while match := pattern.search(text, at):
            start, end = match.span()
            name = next(
                (n for n in self._odd() if text.startswith(n, start) and self._alone(text, start, n)), ""
            )
            if name:
                end = start + len(name)
                signs[start:end] = _MASK + _REST * (end - start - 1)
                found[start] = name
            at = end if name else start + 1
        return "".join(signs), found

    def _alone(self, text: str, start: int, name: str) -> bool:
        return (
            _BEFORE.search(text[max(0, start - 40) : start]) is not None
            and _AFTER.match(text, start + len(name)) is not None
        ) or (_CALLED.fullmatch(name) is not None and _bounded(text, start, len(name)))

    def _odd(self) -> list[str]:
        """Names that are no words, the longest first."""
        names = {*self.values, *self.members}
        return sorted((n for n in names if not _PLAIN.fullmatch(n) or n in _KEYWORDS), key=len, reverse=True)

    def _strange(self) -> "re.Pattern[str] | None":
        odd = self._odd()
        return re.compile("|".join(map(re.escape, odd))) if odd else None


_CALLED = re.compile(r"[\w.]+\(.*\)")
"""A name that looks like a call; it stands beside operators without parentheses."""


def _bounded(text: str, start: int, length: int) -> bool:
    before = text[start - 1 : start]
    return not re.match(r"[\w.]", before) and not re.match(r"\w", text[start + length : start + length + 1])


def _same(one: Expr, other: Expr) -> bool:
    if isinstance(one, Var) and isinstance(other, Var):
        return one.name == other.name and one.domain == other.domain
    return structure(one) == structure(other)


def names_of(chart: Chart, path: Path = (), data: Sequence[object] = ()) -> LabelNames:
    """The names that the labels of a chart may use, in the state at ``path`` or at its border.

    What the chart lists as its data, and what its formulas and actions use; of two formulas with one name
    that of the nearest state counts, as in regions that are drawn alike.
    """
    names = LabelNames(own=chart)
    for datum in data:
        names.add(datum)
    levels = [chart.states[path[:depth]] for depth in range(len(path), -1, -1)]
    for outward, level in enumerate(levels):
        near = LabelNames()
        near.add_formulas(_formulas(level))
        names.unclear.update(n for n in near.unclear - names.values.keys() if not _TIMED.match(n))
        for name, value in near.values.items():
            if not (outward and _TIMED.match(name)):
                names.values.setdefault(name, value)
        for enum in near.enumerations.values():
            names._add_enum(enum)
        for call in filter(None, map(call_of, _actions(level))):
            names.calls.setdefault(call.name, call.actions)
    return names


def _formulas(state: State) -> Iterator[Expr]:
    """Every formula in a state and below it, and every variable that is assigned."""
    for _, one in state.walk():
        for transition in one.default + one.transitions:
            yield from _of_transition(transition)
        for junction in one.junctions:
            for transition in junction.transitions:
                yield from _of_transition(transition)
        yield from _of_actions((*one.entry, *one.during, *one.exit))


def _actions(state: State) -> Iterator[Action]:
    """Every action in a state and below it."""
    for _, one in state.walk():
        segments = [*one.default, *one.transitions, *(t for j in one.junctions for t in j.transitions)]
        lists = [one.entry, one.during, one.exit, *(part for t in segments for part in (t.do, t.then))]
        yield from (action for actions in lists for action in each_action(actions))


def _of_transition(transition: Transition) -> Iterator[Expr]:
    if transition.guard is not None:
        yield transition.guard
    yield from _of_actions((*transition.do, *transition.then))


def _of_actions(actions: Sequence[Action]) -> Iterator[Expr]:
    yield from expressions(actions)
    yield from writes(actions).values()
