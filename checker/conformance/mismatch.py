"""A tick that no behaviour of a chart explains: what the charts require there, and what is logged."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.estimator import BeliefOutcome
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.conformance.recording import Raw
from rovercheck.spec_model.abstraction import Output
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Domain, Num
from rovercheck.spec_model.lang.label import text

MOST_EXPECTED = 8


@dataclass(frozen=True)
class LogDifference:
    """An output that is none of the values that the charts allow."""

    output: Output
    expected: tuple[Raw, ...]
    logged: Raw

    @property
    def key(self) -> tuple[object, ...]:
        """What makes it another difference: values of measured numbers do not, of masks the bits do."""
        sort = self.output.var.domain.sort
        if not isinstance(sort, Num):
            return (self.output.name, self.expected, self.logged)
        if "mask" in self.output.name and len(self.expected) == 1:
            wanted, got = int(self.expected[0]), int(self.logged)
            return (self.output.name, wanted & ~got, got & ~wanted)
        return (self.output.name,)

    def values(self) -> tuple[list[str], str]:
        """What was expected and what was logged, as a person writes it."""
        domain = self.output.var.domain
        return [shown(domain, v) for v in self.expected], shown(domain, self.logged)


@dataclass(frozen=True)
class LogMismatch:
    """One tick of one part of the board that no behaviour explains.

    ``moves``: the transitions that the charts took or the states they stayed in, where they leave no choice.
    ``inputs``: what the part read, ``None`` where it is not logged.
    """

    tick: int
    line: int
    part: str
    differences: tuple[LogDifference, ...]
    moves: tuple[str, ...]
    inputs: Mapping[str, str]
    late: bool = False
    stuck: bool = False

    @property
    def key(self) -> tuple[object, ...]:
        return tuple(d.key for d in self.differences)

    @property
    def outputs(self) -> tuple[str, ...]:
        return tuple(d.output.name for d in self.differences)


def differences(
    cone: LogCone, best: Sequence[BeliefOutcome], logged: Known, places: Sequence[int]
) -> tuple[LogDifference, ...]:
    """The outputs at these places, with every value that the best outcomes allow."""
    found = []
    for i in places:
        allowed = dict.fromkeys(o.outputs[i] for o in best)
        expected = sorted(v for v in allowed if v is not None)[:MOST_EXPECTED]
        got = logged[i]
        assert got is not None, "what is not logged differs from nothing"
        found.append(LogDifference(cone.outputs[i], tuple(expected), got))
    return tuple(found)


def shown(domain: Domain, raw: Raw) -> str:
    """A raw value as a person writes it, also one outside its domain."""
    if isinstance(domain.sort, Num):
        return f"{float(raw * domain.sort.resolution):g}"
    return domain.show(int(raw)) if raw in domain.values else str(raw)


# --- what the charts did --------------------------------------------------------------------------


def moves(cone: LogCone, best: Sequence[BeliefOutcome]) -> tuple[str, ...]:
    """The moves of each chart of the part, if every best outcome agrees on them."""
    names = [v.name for v in cone.system.variables]
    told = {tuple(_moves(cone, names, outcome)) for outcome in best}
    return told.pop() if len(told) == 1 else ()


def _moves(cone: LogCone, names: Sequence[str], outcome: BeliefOutcome) -> Iterator[str]:
    before = dict(zip(names, outcome.before, strict=True))
    after = dict(zip(names, outcome.after, strict=True))
    for chart in cone.charts:
        for place in chart.locations:
            if place.name in before and after[place.name] is not None:
                yield _move(chart, place.name, place.domain, before[place.name], after[place.name])


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
