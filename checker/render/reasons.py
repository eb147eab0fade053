"""The cause of a violation, for people: which inputs, in which ticks, determine the end of the run."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from rovercheck.checker.render.story import start_values, value
from rovercheck.checker.results.trace import Trace, counted_ticks
from rovercheck.checker.system.wide_cells import MOST_LISTED
from rovercheck.spec_model.lang.domain import Num


@dataclass(frozen=True)
class Reason:
    """An input that had to be so in each tick from ``first`` to ``last``, or in every so many of them.

    ``what`` is ``d1 >= 71 cm``.
    """

    first: int
    last: int
    ends: tuple[int, int]
    what: str
    every: int = 1

    @property
    def when(self) -> str:
        """``ticks 1–7``, ``ticks 6, 13, ... 160``."""
        if self.first == self.last:
            return f"tick {self.first}"
        start = f"{self.first}–" if self.every == 1 else f"{self.first}, {self.first + self.every}, ... "
        return f"ticks {start}{self.last}"

    @property
    def ms(self) -> str:
        """``20–140 ms``: the ends of the first and of the last tick."""
        first = f"{self.ends[0]}–" if self.last > self.first else ""
        return f"{first}{self.ends[1]} ms"


def reasons(trace: Trace, regular: bool = False) -> tuple[Reason, ...]:
    """The inputs that determine the end of the run, neighbouring ticks together, in order of their start.

    With ``regular``, single ticks at one distance from each other are together, too.
    """
    ticks: dict[tuple[str, frozenset[int]], list[int]] = {}
    for one in trace.needed():
        ticks.setdefault((one.name, one.values), []).append(one.number)
    order = {name: i for i, name in enumerate(trace.system.inputs)}
    found = [
        ((first, last, order.get(name, len(order))), Reason(first, last, ends, what, every))
        for (name, values), numbers in ticks.items()
        for what in [_allowed(trace, name, values)]
        for first, last, every in _stretches(sorted(numbers), regular)
        for ends in [(trace.ms(first), trace.ms(last))]
    ]
    return tuple(reason for _, reason in sorted(found, key=lambda pair: pair[0]))


def in_reason(trace: Trace, earlier: Trace) -> str:
    """In what the reason for the end of a run differs from that of another: ``needs rx_update``.

    What is needed a number of ticks before the end is the same in runs of different lengths.
    """
    own, others = _before_the_end(trace), _before_the_end(earlier)
    fixed = set(start_values(trace)) - set(start_values(earlier))
    more, fewer = own.keys() - others.keys(), others.keys() - own.keys()
    changed = {name for name in own.keys() & others.keys() if own[name] != others[name]}
    parts = [
        f"begins with {', '.join(f'{n} = {v}' for n, v in sorted(fixed))}" if fixed else "",
        f"needs {', '.join(sorted(more))}" if more else "",
        f"does not need {', '.join(sorted(fewer))}" if fewer else "",
        f"needs {', '.join(sorted(changed))} in other ticks or with other values" if changed else "",
    ]
    return "; ".join(part for part in parts if part)


def _before_the_end(trace: Trace) -> dict[str, set[tuple[int, frozenset[int]]]]:
    """For each needed input how long before the end it is needed, with which values."""
    found: dict[str, set[tuple[int, frozenset[int]]]] = {}
    for one in trace.needed():
        found.setdefault(one.name, set()).add((len(trace) - one.number, one.values))
    return found


def _stretches(numbers: Sequence[int], regular: bool) -> Iterator[tuple[int, int, int]]:
    """Ascending numbers as first, last and step: neighbours together, then at least three at one distance."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    alone = [run[0] for run in runs if len(run) == 1]
    yield from ((run[0], run[-1], 1) for run in runs if len(run) > 1)
    while alone:
        step = alone[1] - alone[0] if len(alone) > 1 else 0
        count = next((i for i, n in enumerate(alone) if n != alone[0] + i * step), len(alone))
        count = count if count > 2 and regular else 1
        yield alone[0], alone[count - 1], step if count > 1 else 1
        del alone[:count]


def _allowed(trace: Trace, name: str, values: frozenset[int]) -> str:
    """``d1 >= 71 cm``, ``mode = SAFE``, ``cmd != STOP``, ``y in 0.1..0.5``."""
    var = trace.system.variables[name]
    few = len(var.domain) <= MOST_LISTED
    others = [v for v in var.domain.values if v not in values] if few else []
    if len(values) == 1:
        return f"{var.name} = {value(trace, var.name, min(values))}"
    if len(others) == 1:
        return f"{var.name} != {value(trace, var.name, others[0])}"
    spans = list(_spans(var.domain.values, values)) if few and isinstance(var.sort, Num) else []
    if not few:
        spans = [(first, last) for first, last, _ in _stretches(sorted(values), regular=False)]
    if len(spans) == 1 and spans[0][0] == var.domain.low:
        return f"{var.name} <= {value(trace, var.name, spans[0][1])}"
    if len(spans) == 1 and spans[0][1] == var.domain.high:
        return f"{var.name} >= {value(trace, var.name, spans[0][0])}"
    if len(spans) == 1:
        return f"{var.name} in {next(_listed(trace, var.name, values, spans))}"
    return f"{var.name} in {{{', '.join(_listed(trace, var.name, values, spans))}}}"


def _listed(trace: Trace, name: str, values: frozenset[int], spans: list[tuple[int, int]]) -> Iterator[str]:
    if not spans:
        yield from (trace.show(name, v) for v in sorted(values))
    for low, high in spans:
        yield (
            f"{trace.show(name, low)}..{value(trace, name, high)}" if low < high else value(trace, name, low)
        )


def _spans(domain: Sequence[int], values: Collection[int]) -> Iterator[tuple[int, int]]:
    """The longest stretches of a domain that lie in a set of values."""
    start: int | None = None
    last = domain[0]
    for v in domain:
        if v in values:
            start = v if start is None else start
        elif start is not None:
            yield start, last
            start = None
        last = v
    if start is not None:
        yield start, last


def cause(trace: Trace) -> str:
    """The heading above the reasons."""
    return f"Cause: the inputs that determine the {'violation' if trace.breaks() else 'outcome'}"


def meaning(trace: Trace) -> str:
    """What the reasons mean, in one sentence; empty for a run whose inputs were not examined."""
    found = trace.necessary
    if found is None:
        return ""
    fixed = " with what is fixed as here" if start_values(trace) else ""
    runs = f"every run of {counted_ticks(len(trace))}{fixed}"
    if not found.needed:
        return f"Nothing but time: {runs} ends like this, whatever its inputs."
    size = "minimal and smallest" if found.smallest else "minimal"
    least = f"The set is {size}." if found.minimal else "Not minimised: some may not matter."
    return f"Whatever the other inputs are, {runs} ends like this. {least}"


def determined_by(trace: Trace) -> str:
    """Which inputs determine the end of the run, and what that means; empty where nobody examined that."""
    spans = determining(trace)
    return f"Determined by {'; '.join(spans)}. {meaning(trace)}" if spans else meaning(trace)


def determining(trace: Trace) -> list[str]:
    """The inputs that determine the end of the run, those of the same ticks together: ``tick 3: rx, d1 >= 71
    cm``."""
    told = groupby(reasons(trace, regular=True), key=lambda reason: reason.when)
    return [f"{when}: {', '.join(reason.what for reason in group)}" for when, group in told]
