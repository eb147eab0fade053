"""Replay: a run becomes a trace only after the lowered system and the chart interpreter agree on it.

The engines read the lowered system; the interpreter reads the charts.  They share no code, so a
trace that both produce is evidence about the charts.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate

from rovercheck.checker.results.trace import TakenTransition, Tick, Trace, TracedProperty, TracedSystem
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.runs.domains import leaves, stayed, stray
from rovercheck.properties.reduce import Goal
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.interpret import FiredTransition, Interpreter
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables


class ReplayError(Exception):
    """Two parts of the checker disagree about a run: an internal error, never a verdict."""


def replay(system: TransitionSystem, goal: Goal, run: Run) -> Trace:
    """The trace of a run that reaches the goal in its last tick.

    Raises ``ReplayError`` when the run is not admissible, does not reach the goal, or when the
    interpreter of the charts computes another state or refuses a step; ``LeavesDomain`` when the run
    leaves a domain, which is an error of the model.
    """
    ticks, _ = followed(system, run, goal.var.name)
    return traced(system, goal, run, ticks)


def traced(system: TransitionSystem, goal: Goal, run: Run, ticks: tuple[Tick, ...]) -> Trace:
    """The trace of a run whose ticks are known.  Raises ``ReplayError`` unless it reaches the goal."""
    if not ticks or not ticks[-1].after[goal.var.name]:
        raise ReplayError(f"{goal.var.name}: the run of {len(ticks)} ticks does not reach the goal.")
    shown, truths = tuple(part for part, _ in goal.parts), tuple(_truths(goal, ticks))
    false = tuple(part for part, true in zip(shown, truths, strict=True) if not true[-1])
    of, prop, relevant = TracedSystem.of(system), goal.property, _relevant(system, goal)
    charts = frozenset(name for name, chart in of.statecharts.items() if _of(chart) & relevant)
    stated = TracedProperty(
        prop.id, prop.text, relevant, charts, false, shown, truths, not goal.reach, prop.place
    )
    return Trace(of, {**system.init, **run.frozen}, ticks, stated, ends(system, ticks))


def ends(system: TransitionSystem, ticks: Sequence[Tick]) -> tuple[int, ...]:
    """The time in ms at the end of each tick, where ticks last unlike times; else nothing."""
    if system.elapsed is None:
        return ()
    name = system.elapsed.name
    return tuple(accumulate({**t.inputs, **t.after}[name] for t in ticks))


def followed(
    system: TransitionSystem, run: Run, what: str, until: str = ""
) -> tuple[tuple[Tick, ...], Mapping[str, int]]:
    """The ticks of a run, ``what`` it shows being named in errors, and the state after the last.

    With ``until``, the name of a truth value, only those up to the first after which it is true.

    Raises ``ReplayError`` when the run is not admissible, or the interpreter of the charts disagrees, and
    ``LeavesDomain`` when a tick leaves a domain.
    """
    interpreter = Interpreter(system.source, run.frozen) if system.source is not None else None
    at: Mapping[str, int] = {**system.init, **run.frozen}
    ticks: list[Tick] = []
    for number, inputs in enumerate(run.inputs, start=1):
        if not admissible(system, at, inputs):
            raise ReplayError(f"{what}: the inputs of tick {number} are not admissible.")
        after = step(system, at, inputs)
        if not stayed(system, after) and (found := stray(system, run)) is not None:
            raise leaves(system, found)
        fired = _interpreted(interpreter, inputs, after, number) if interpreter else ()
        ticks.append(Tick(number, dict(inputs), _visible(system, after), tuple(map(transition_of, fired))))
        if until and after[until]:
            break
        at = {n: v for n, v in after.items() if n not in inputs}
    return tuple(ticks), after if ticks else at


def _truths(goal: Goal, ticks: Sequence[Tick]) -> Iterator[tuple[bool, ...]]:
    """For each conjunct of the property, whether it is true after each tick."""
    for _, formula in goal.parts:
        yield tuple(bool(evaluate(formula, {**tick.after, **tick.inputs})) for tick in ticks)


def _relevant(system: TransitionSystem, goal: Goal) -> frozenset[str]:
    """The variables that the goal, or a part of the property, depends on."""
    part = sliced(system, [goal.var, *goal.recurs])
    inside = {v.name for v in (*part.inputs, *part.frozen, *part.variables, *part.temps)}
    return frozenset(inside | set(variables(*(formula for _, formula in goal.parts))))


def _of(chart: Chart) -> frozenset[str]:
    return frozenset([*chart.written, *(v.name for v in chart.locations)])


def _visible(system: TransitionSystem, after: Mapping[str, int]) -> dict[str, int]:
    kept = {v.name for v in (*system.variables, *system.frozen)}
    return {name: value for name, value in after.items() if name in kept}


def _interpreted(
    interpreter: Interpreter, inputs: Mapping[str, int], after: Mapping[str, int], number: int
) -> tuple[FiredTransition, ...]:
    try:
        fired = interpreter.step(inputs)
    except ModelError as error:
        raise ReplayError(f"tick {number}: the interpreter refuses the step: {error}") from error
    for name, value in interpreter.valuation().items():
        if name in after and after[name] != value:
            raise ReplayError(
                f"tick {number}: {name} is {value} in the interpreter and {after[name]} when lowered."
            )
    return fired


def transition_of(fired: FiredTransition) -> TakenTransition:
    """A transition taken by the interpreter, as traces hold it."""
    return TakenTransition(
        fired.chart,
        _dotted(fired.source),
        _dotted(fired.target),
        fired.label,
        fired.order,
        fired.event,
        fired.place,
    )


def _dotted(path: Path) -> str:
    return ".".join(path)
