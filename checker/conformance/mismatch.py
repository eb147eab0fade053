"""A tick that no behaviour of a chart explains: what the charts require there, and what is logged."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.conformance.cones import LogCone, measured
from rovercheck.checker.conformance.deciders import deciders
from rovercheck.checker.conformance.program import BeliefOutcome, Known
from rovercheck.checker.conformance.recording import Raw
from rovercheck.spec_model.abstraction import Output
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Domain, Num
from rovercheck.spec_model.lang.label import text

MOST_EXPECTED = 8

MOST_TOLD_APART = 16
"""Values of a number of which each is another case, such as a decision."""


@dataclass(frozen=True)
class LogDifference:
    """An output that is none of the values that the charts allow.

    ``moves``: what the charts that decide it did, the transitions taken or the states kept, where they leave
    no choice; of a measured number the states after the step.  ``decided_by``: these charts, in words.
    ``late``: it is what was required in the tick before; ``stuck``: it is what it was then.  ``bit``: of a
    mask, the bit that is meant.  ``text``: what was given instead of a value; ``logged`` is then ``None``.
    ``ambiguous``: several moves of the charts are as near.
    """

    output: Output
    expected: tuple[Raw, ...]
    logged: Raw | None
    moves: tuple[str, ...] = ()
    decided_by: str = ""
    late: bool = False
    stuck: bool = False
    bit: int = 0
    text: str = ""
    ambiguous: bool = False

    @property
    def is_mask(self) -> bool:
        """Whether its bits are told apart."""
        named = "mask" in self.output.name and len(self.expected) == 1
        return named and self.logged is not None and self.logged == int(self.logged)

    @property
    def is_number(self) -> bool:
        """Whether its value is that of a computation: it says nothing of what is wrong."""
        return measured(self.output)

    @property
    def key(self) -> tuple[str, str, str]:
        """What makes it another difference, in words: the output, what it must be, what it is.

        Values of measured numbers make none, of masks the bits do.
        """
        name = self.output.name
        if self.text:
            return (name, "a value", self.text)
        domain = self.output.var.domain
        if isinstance(domain.sort, Num) and not self.is_mask and len(domain) > MOST_TOLD_APART:
            return (name, "", "")
        if self.is_mask:
            assert self.logged is not None
            wanted, got = int(self.expected[0]), int(self.logged)
            bits = self.bit or wanted ^ got
            return (name, _bits(wanted & bits), _bits(got & bits))
        expected, logged = self.values()
        return (name, " or ".join(expected), logged)

    def values(self) -> tuple[list[str], str]:
        """What was expected and what was logged, as a person writes it."""
        domain = self.output.var.domain
        logged = self.text if self.logged is None else shown(domain, self.logged)
        return [shown(domain, v) for v in self.expected], logged

    def each_bit(self) -> "list[LogDifference]":
        """Of a mask, the difference of each bit by itself."""
        if not self.is_mask:
            return [self]
        assert self.logged is not None
        wrong = int(self.expected[0]) ^ int(self.logged)
        return [replace(self, bit=1 << i) for i in range(wrong.bit_length()) if wrong >> i & 1]


def _bits(mask: int) -> str:
    return f"0x{mask:x}"


@dataclass(frozen=True)
class LogMismatch:
    """One tick of one part of the board that no behaviour explains.

    ``inputs``: what the part read, ``None`` where it is not logged.
    """

    tick: int
    line: int
    part: str
    differences: tuple[LogDifference, ...]
    inputs: Mapping[str, str]

    @property
    def moves(self) -> tuple[str, ...]:
        """The transitions that the charts took or the states they stayed in, where they leave no choice."""
        return tuple(dict.fromkeys(move for d in self.differences for move in d.moves))

    @property
    def decided_by(self) -> str:
        """The charts that decide the outputs, in words; the part where it holds none."""
        return "; ".join(dict.fromkeys(d.decided_by for d in self.differences if d.decided_by)) or self.part

    @property
    def late(self) -> bool:
        """Whether the outputs are what was required in the tick before."""
        return all(d.late for d in self.differences)

    @property
    def stuck(self) -> bool:
        """Whether the outputs are what they were in the tick before."""
        return all(d.stuck for d in self.differences)

    @property
    def key(self) -> tuple[object, ...]:
        return tuple(d.key for d in self.differences)

    @property
    def outputs(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(d.output.name for d in self.differences))

    def pieces(self) -> "list[LogMismatch]":
        """What may have causes of its own: outputs that others decide, bits of masks, numbers.

        A number that differs together with a discrete output of the same charts follows from it, and is
        told with it.
        """
        groups: dict[object, list[LogDifference]] = {}
        numbers: list[LogDifference] = []
        for difference in (one for d in self.differences for one in d.each_bit()):
            if difference.is_number and not difference.text:
                numbers.append(difference)
            else:
                groups.setdefault(_together(difference), []).append(difference)
        for number in numbers:
            leader = next((g for g in groups.values() if _follows(number, g)), None)
            if leader is not None:
                leader.append(number)
        alone = [n for n in numbers if not any(n in g for g in groups.values())]
        return [replace(self, differences=tuple(g)) for g in [*groups.values(), *([n] for n in alone)]]


def _together(difference: LogDifference) -> object:
    """Differences for which this is the same are one: the same bit, or the same charts decide them."""
    if difference.bit:
        return difference.bit
    return difference.decided_by, difference.moves or difference.output.name, bool(difference.text)


def _follows(number: LogDifference, leaders: Sequence[LogDifference]) -> bool:
    """Whether one of the discrete outputs is decided by the same charts as a number."""
    return any(d.decided_by == number.decided_by and d.decided_by and not d.text for d in leaders)


class Differences:
    """Tells what differs in the outputs of one part."""

    def __init__(self, cone: LogCone) -> None:
        self._cone = cone
        self._deciders = [deciders(cone.components, o.var.name) for o in cone.outputs]
        self._names = [v.name for v in cone.system.variables]

    def told(
        self, best: Sequence[BeliefOutcome], logged: Known, places: Sequence[int], before: Known, last: Known
    ) -> tuple[LogDifference, ...]:
        """The outputs at these places, with every value that the best outcomes allow.

        ``before``: what was required in the tick before; ``last``: what was logged then.
        """
        found = []
        for i in places:
            allowed = dict.fromkeys(o.outputs[i] for o in best)
            expected = sorted(v for v in allowed if v is not None)[:MOST_EXPECTED]
            got = logged[i]
            assert got is not None, "what is not logged differs from nothing"
            late, stuck = bool(before) and got == before[i], got == last[i]
            one = LogDifference(self._cone.outputs[i], tuple(expected), got, late=late, stuck=stuck)
            moves, told = self.moves(i, best), self._deciders[i].told
            ambiguous = not moves and len(best) > 1 and bool(self._deciders[i].charts)
            found.append(replace(one, moves=moves, decided_by=told, ambiguous=ambiguous))
        return tuple(found)

    def meaningless(self, name: str, text: str, outcome: BeliefOutcome | None) -> LogDifference:
        """An output, by its variable, that was given as what is no value; ``outcome`` is what is required."""
        [i] = [i for i, o in enumerate(self._cone.outputs) if o.var.name == name]
        wanted = None if outcome is None else outcome.outputs[i]
        return LogDifference(
            self._cone.outputs[i],
            () if wanted is None else (wanted,),
            None,
            () if outcome is None else self.moves(i, [outcome]),
            self._deciders[i].told,
            text=text,
        )

    def moves(self, output: int, best: Sequence[BeliefOutcome]) -> tuple[str, ...]:
        """The moves of the charts that decide an output, if every best outcome agrees on them."""
        places = self._deciders[output].places
        number = measured(self._cone.outputs[output])
        told = {tuple(_moves(self._cone, self._names, places, number, outcome)) for outcome in best}
        return told.pop() if len(told) == 1 else ()


def shown(domain: Domain, raw: Raw) -> str:
    """A raw value as a person writes it, also one outside its domain."""
    if isinstance(domain.sort, Num):
        return f"{float(raw * domain.sort.resolution):g}"
    return domain.show(int(raw)) if raw in domain.values else str(raw)


# --- what the charts did --------------------------------------------------------------------------


def _moves(
    cone: LogCone, names: Sequence[str], places: frozenset[str], after_only: bool, outcome: BeliefOutcome
) -> Iterator[str]:
    before = dict(zip(names, outcome.before, strict=True))
    after = dict(zip(names, outcome.after, strict=True))
    for chart in cone.charts:
        for place in chart.locations:
            now = after.get(place.name) if place.name in places else None
            was = now if after_only else before.get(place.name)
            if now is not None and (now != place.init or was != now):
                yield _move(chart, place.name, place.domain, was, now)


def _move(chart: Chart, name: str, domain: Domain, before: Raw | None, after: Raw | None) -> str:
    assert after is not None
    target = shown(domain, after)
    if before is None or before == after:
        return f"{name}: in {target}"
    source = shown(domain, before)
    return f"{name}: {source} → {target}{_label(chart, source, target)}"


def _label(chart: Chart, source: str, target: str) -> str:
    """The label of the transition, if only one leads from state to state."""
    transitions = [
        (order, transition)
        for path, state in chart.states.items()
        if path and path[-1] == source
        for order, transition in enumerate(state.transitions, 1)
        if transition.target.rpartition(".")[2] == target
    ]
    if len(transitions) != 1:
        return ""
    order, transition = transitions[0]
    guard = f" [{text(transition.guard)}]" if transition.guard is not None else ""
    return f" (transition {order}){guard}"
