"""A short run of inputs that would decide between two causes, or between a cause and the charts."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.estimator import differs
from rovercheck.checker.conformance.mismatch import shown
from rovercheck.checker.conformance.program import Known, NeededInputs
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.trial import NO_VALUE
from rovercheck.checker.system.partition import expressions
from rovercheck.spec_model.abstraction import Output
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Apply, Const, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import nodes, variables

RUNS, STEPS = 150, 300
"""Runs that are tried, and how long one may be."""
HOLDS = (1, 1, 1, 2, 3, 5, 8, 13, 30, 60, 120, 210)
SEED = 18
MOST_VALUES = 400


@dataclass(frozen=True)
class HeldInputs:
    """Inputs that are held for some steps: those that change at its start."""

    steps: int
    changes: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class DecidingRun:
    """Inputs of a part from power-up after whose last step two causes give different outputs."""

    blocks: tuple[HeldInputs, ...]
    output: str
    one: str
    other: str

    @property
    def steps(self) -> int:
        return sum(b.steps for b in self.blocks)


Timed = tuple[int, dict[str, Raw]]


class RunSearch:
    """Looks for runs in which two parts differ: with values at and beside every limit of both.

    ``seen``: an output with the values that the two give it, which would be nothing new; measured ones are.
    """

    def __init__(
        self,
        evidence: PartEvidence,
        one: LogCone,
        other: LogCone,
        seen: frozenset[tuple[object, ...]] = frozenset(),
    ) -> None:
        self._cones, self._seen = (one, other), seen
        self._outputs = [o for o in one.outputs if o.name in {p.name for p in other.outputs}]
        self._vars: dict[str, Var] = {v.name: v for c in self._cones for v in c.system.inputs}
        self._values = {name: self._of(evidence, v) for name, v in self._vars.items()}

    def found(self) -> DecidingRun | None:
        """The shortest of what is found; ``None`` if nothing is."""
        random = Random(SEED)
        for _ in range(RUNS):
            blocks = list(self._drawn(random))
            if (at := self._differs(blocks)) is not None:
                return self._told(self._smaller(_cut(blocks, at)))
        return None

    def _drawn(self, random: Random) -> Iterator[Timed]:
        steps = 0
        held: dict[str, Raw] = {n: v.init for n, v in self._vars.items()}
        while steps < STEPS:
            for name in self._vars:
                if random.random() < 0.4:
                    held[name] = random.choice(self._values[name])
            length = min(random.choice(HOLDS), STEPS - steps)
            steps += length
            yield length, dict(held)

    def _differs(self, blocks: Sequence[Timed]) -> int | None:
        """The number of steps after which the outputs differ."""
        steps = 0
        states: list[Known] = [tuple(v.init for v in c.system.variables) for c in self._cones]
        for length, values in blocks:
            given = [tuple(values[v.name] for v in c.system.inputs) for c in self._cones]
            for _ in range(length):
                steps += 1
                outputs = []
                for k, cone in enumerate(self._cones):
                    try:
                        states[k], out = cone.step(states[k], given[k])
                    except (NeededInputs, *NO_VALUE):
                        return None
                    outputs.append(dict(zip((o.name for o in cone.outputs), out, strict=True)))
                if outputs[0] != outputs[1] and self._apart(*outputs):
                    self._last = outputs
                    return steps
        return None

    def _apart(self, one: dict[str, Raw | None], other: dict[str, Raw | None]) -> str:
        for o in self._outputs:
            sort = o.var.domain.sort
            close = float(Fraction(1, 10**6) / sort.resolution) if isinstance(sort, Num) else None
            if differs(one[o.name], other[o.name], close) and not self._is_seen(o, one, other):
                return o.name
        return ""

    def _is_seen(self, o: Output, one: dict[str, Raw | None], other: dict[str, Raw | None]) -> bool:
        if not self._seen:
            return False
        if isinstance(o.var.domain.sort, Num):
            return any(o.name == name for name, *_ in self._seen)
        return (o.name, one[o.name], other[o.name]) in self._seen

    def _smaller(self, blocks: list[Timed]) -> list[Timed]:
        """Fewer blocks, shorter ones, fewer changes, as long as the outputs differ."""
        best = blocks
        again = True
        while again:
            again = False
            for candidate in self._shorter(best):
                at = self._differs(candidate)
                if at is not None:
                    best, again = _cut(candidate, at), True
                    break
        self._differs(best)
        return best

    @staticmethod
    def _shorter(blocks: list[Timed]) -> Iterator[list[Timed]]:
        for i in range(len(blocks)):
            if len(blocks) > 1:
                yield [*blocks[:i], *blocks[i + 1 :]]
        for i, (length, values) in enumerate(blocks):
            for new in (1, length // 2, length - 1):
                if 0 < new < length:
                    yield [*blocks[:i], (new, values), *blocks[i + 1 :]]
        for i in range(1, len(blocks)):
            before = blocks[i - 1][1]
            for name, value in blocks[i][1].items():
                if value != before[name]:
                    changed = (blocks[i][0], {**blocks[i][1], name: before[name]})
                    yield [*blocks[:i], changed, *blocks[i + 1 :]]

    def _told(self, blocks: list[Timed]) -> DecidingRun:
        one, other = self._last
        name = self._apart(one, other)
        domain = next(o for o in self._outputs if o.name == name).var.domain
        held: list[HeldInputs] = []
        before: dict[str, Raw] = {n: v.init for n, v in self._vars.items()}
        for length, values in blocks:
            changes = tuple(
                (n, shown(self._vars[n].domain, v)) for n, v in values.items() if before.get(n) != v
            )
            held.append(HeldInputs(length, changes))
            before = values

        def text(value: Raw | None) -> str:
            return "anything" if value is None else shown(domain, value)

        return DecidingRun(tuple(held), name, text(one[name]), text(other[name]))

    def _of(self, evidence: PartEvidence, v: Var) -> list[Raw]:
        """Values to draw: at and beside the limits of both, some that were recorded."""
        found: dict[Raw, None] = {}
        for cone in self._cones:
            if any(i.name == v.name for i in cone.system.inputs):
                found.update(dict.fromkeys(cone.values(v.name)[:MOST_VALUES]))
            if isinstance(v.domain.sort, Num):
                for value in _limits(cone, v):
                    found.update(dict.fromkeys((value, value - 1, value + 1)))
        for run in evidence.runs[:5]:
            cells = [c for c in dict.fromkeys(run.columns.get(v.name, ())) if c is not None]
            found.update(dict.fromkeys(cells[:50]))
        if isinstance(v.domain.sort, Num):
            low, high = v.domain.low, v.domain.high
            has_bits = any(v.name in _with_bits(cone) for cone in self._cones)
            found = {x: None for x in found if low <= x <= high and (isinstance(x, int) or not has_bits)}
        return list(found) or [v.init]


def _limits(cone: LogCone, v: Var) -> Iterator[Raw]:
    """Numbers that the variable is compared with, in its own steps."""
    assert isinstance(v.domain.sort, Num)
    for node in nodes(*expressions(cone.system.step)):
        if isinstance(node, Apply) and len(node.args) == 2:
            for number in node.args:
                if isinstance(number, Const) and isinstance(number.sort, Num):
                    raw = number.value * number.sort.resolution / v.domain.sort.resolution
                    yield raw.numerator if raw.denominator == 1 else raw


def _with_bits(cone: LogCone) -> set[str]:
    """The numbers of which single bits are read."""
    bits = (n for n in nodes(*expressions(cone.system.step)) if isinstance(n, Apply) and n.op is Op.BIT)
    return {name for node in bits for name in variables(*node.args)}


def _cut(blocks: Sequence[Timed], steps: int) -> list[Timed]:
    found: list[Timed] = []
    for length, values in blocks:
        if steps <= 0:
            break
        found.append((min(length, steps), values))
        steps -= length
    return found


__all__ = ["DecidingRun", "HeldInputs", "RunSearch"]
