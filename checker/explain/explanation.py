"""A trace with the inputs that force its end, found by a solver and checked by replay."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from random import Random
from time import process_time
from typing import TYPE_CHECKING

from rovercheck.checker.engines import Progress, quiet
from rovercheck.checker.explain.cells import cells_of
from rovercheck.checker.explain.necessary_inputs import forcing
from rovercheck.checker.explain.unrolled_run import OutOfTime, Over, never
from rovercheck.checker.results.trace import NecessaryInputs, Trace
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.store.parts import PartStore
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.runs.known_runs import run_in
from rovercheck.checker.verify.runs.replay import ReplayError, followed
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System, TransitionSystem

if TYPE_CHECKING:
    from rovercheck.checker.store.verdicts import VerdictStore

# --- are the needed inputs enough?  Runs with these inputs and any others are replayed, and must end alike

TICKS = 600
"""Ticks that are replayed at most, but two runs in any case."""
RUNS, LEAST = 8, 2
TRIES = 20
"""Times that the inputs of a tick are drawn before a run is given up."""

Choices = Mapping[str, Sequence[int]]


def check(system: TransitionSystem, goal: Var, run: Run, found: NecessaryInputs) -> int:
    """Replay some runs with the inputs that force an end and others drawn at random, from fixed seeds.

    Returns how many were replayed, the given run not among them: fewer than ``RUNS`` where the others
    soon leave no admissible inputs.  Raises ``ReplayError`` if one ends otherwise.
    """
    part = sliced(system, [goal])
    choices = {n: [c.value for c in p.cells] for n, p in cells_of(part, run).items()}
    wanted = max(LEAST, min(RUNS, TICKS // max(1, len(run))))
    drawn = (_completed(part, run, found, choices, seed) for seed in range(wanted))
    replayed = 0
    for inputs in drawn:
        if inputs is None:
            continue
        whole = tuple({**own, **tick} for own, tick in zip(run.inputs, inputs, strict=True))
        _, last = followed(system, Run(run.frozen, whole), goal.name)
        if not last[goal.name]:
            raise ReplayError(
                f"{goal.name}: what is said to force the end of the run does not force it; "
                f"with {_differing(run, whole)} it ends otherwise."
            )
        replayed += 1
    return replayed


def _completed(
    part: TransitionSystem, run: Run, found: NecessaryInputs, choices: Choices, seed: int
) -> list[dict[str, int]] | None:
    """Inputs of a run with what is needed; None if it comes to a tick for which none were found."""
    random, contrariwise = Random(seed), seed == 0
    at = {**part.init, **{v.name: run.frozen[v.name] for v in part.frozen}}
    fixed: dict[int, dict[str, Sequence[int]]] = {}
    for one in found.needed:
        fixed.setdefault(one.number, {})[one.name] = sorted(one.values)
    ticks: list[dict[str, int]] = []
    for number, given in enumerate(run.inputs, 1):
        own = {v.name: given[v.name] for v in part.inputs}
        last = ticks[-1] if ticks else own
        of = {**choices, **fixed.get(number, {})}
        for inputs in _drawn(own, last, of, random, contrariwise):
            if admissible(part, at, inputs):
                break
        else:
            return None
        ticks.append(inputs)
        at = {n: v for n, v in step(part, at, inputs).items() if n not in inputs}
    return ticks


def _drawn(
    own: Mapping[str, int], last: Mapping[str, int], of: Choices, random: Random, contrariwise: bool
) -> Iterator[dict[str, int]]:
    """Inputs to try in a tick: at random, or as in the tick before; at last those of the run itself.

    ``contrariwise``: first other values than those of the run wherever there are any.
    """
    contrary = {n: [v for v in values if v != own[n]] or [own[n]] for n, values in of.items()}
    if contrariwise:
        yield {n: random.choice(contrary[n]) for n in own}
    for attempt in range(TRIES):
        changed = (1 if contrariwise else random.random()) * (1 - attempt / TRIES)
        base = last if all(last[n] in of[n] for n in of) and random.random() < 0.5 else own
        yield {n: random.choice(of[n]) if random.random() < changed else base[n] for n in own}
    yield dict(own)


def _differing(run: Run, inputs: Sequence[Mapping[str, int]]) -> str:
    """The first inputs that differ from those of the run."""
    changes = (
        f"{name} = {value} in tick {number}"
        for number, (old, new) in enumerate(zip(run.inputs, inputs, strict=True), 1)
        for name, value in new.items()
        if old[name] != value
    )
    return next(changes, "the same inputs")


def unexplained(trace: Trace) -> str:
    """Why no inputs that force the end of a trace are looked for; empty if they are."""
    if trace.loop is not None:
        return "the run has no end that inputs could force: its last ticks repeat for ever"
    if trace.trapped is not None:
        return "what is out of reach after a run is no matter of its inputs alone"
    return ""


class NotLookedFor(Exception):
    """Nobody has looked for the cause of a finding yet."""


def explained_once(
    trace: Trace,
    prop: Property,
    system: System,
    store: "VerdictStore | None",
    progress: Progress = quiet,
    seconds: float | None = None,
    kept_only: bool = False,
) -> Trace:
    """As ``explained``; what is in the store is not looked for again, and what is found is kept there.

    At most so many ``seconds`` of computing, which a busy machine does not shorten.  A set of inputs of which
    some may not matter, and that nothing was found, is kept for as many seconds only.  Raises what
    ``explained`` raises, and ``NotLookedFor`` if the cause is not kept and only what is ``kept`` is wanted.
    """
    start = process_time()

    def over() -> bool:
        return seconds is not None and process_time() - start > seconds

    if unexplained(trace) or not len(trace):
        return trace
    if store is None:
        if kept_only:
            raise NotLookedFor(prop.id)
        return explained(trace, prop, system, progress, over)
    name = store.about("cause", prop, system, run_in(trace))
    parts = PartStore(store)
    within = parts.name("cause within", prop, system, run_in(trace), seconds) if seconds is not None else None
    known = store.necessary(name) or store.necessary(within)
    if known is not None:
        return replace(trace, necessary=known)
    if isinstance(late := parts.read(within), str):
        raise OutOfTime(late)
    if kept_only:
        raise NotLookedFor(prop.id)
    try:
        found = explained(trace, prop, system, progress, over)
    except OutOfTime as late:
        parts.write(within, str(late))
        raise
    if found.necessary is not None:
        store.write_necessary(name if found.necessary.minimal else within, found.necessary)
    return found


def explained(
    trace: Trace,
    prop: Property,
    system: System,
    progress: Progress = quiet,
    over: Over = never,
) -> Trace:
    """The trace of a property on a system with the inputs that force its end.

    As it is, if ``unexplained`` says why.  ``over`` tells that the time is over.  Raises ``OutOfTime`` if
    nothing was found by then, and ``ReplayError`` if a run with the needed inputs ends otherwise.
    """
    if unexplained(trace) or not len(trace):
        return trace
    question = reduce(lowered(system), [replace(prop, on=system.name)])
    [goal] = question.goals
    frozen = {v.name: trace.before[v.name] for v in question.system.frozen}
    run = Run(frozen, tuple(tick.inputs for tick in trace.ticks))
    found = forcing(question.system, goal.var, run, progress, over)
    progress("replaying other runs with the same needed inputs")
    check(question.system, goal.var, run, found)
    return replace(trace, necessary=found)
