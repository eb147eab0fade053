"""What can be seen of a part from outside, and the run in which a mutant is seen to differ."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Literal

from rovercheck.checker.mutate.product import Product
from rovercheck.checker.results.trace import Tick
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import ReplayError, followed
from rovercheck.spec_model.lang.chart import Chart, parts
from rovercheck.spec_model.lang.evaluate import admissible
from rovercheck.spec_model.lang.system import System, TransitionSystem

AllowedBy = Literal["the original", "the mutant"]


@dataclass(frozen=True)
class MutantDifference:
    """A run that tells a mutant from the original, both of which were run by the interpreter of the charts.

    ``inputs`` are those of each tick, ``original`` and ``mutant`` the values after the last tick of what
    differs then; ``places`` says in which state each chart was before it.  ``allowed_by``: only this one, the
    original or the mutant, has a last tick with these inputs.  All values are as people write them.
    """

    inputs: tuple[Mapping[str, str], ...]
    frozen: Mapping[str, str]
    original: Mapping[str, str]
    mutant: Mapping[str, str]
    places: Mapping[str, str]
    shortest: bool
    allowed_by: AllowedBy | None = None

    def __len__(self) -> int:
        return len(self.inputs)


def observable(system: System, named: Collection[str] = (), abroad: Collection[str] = ()) -> set[str]:
    """The variables by which anybody outside the system knows what its parts do.

    That is data that properties speak of (those ``named``), data that parts of other systems read (those
    ``abroad``), and what no part of this system reads, which is an output.  What one part tells another
    matters as far as one of these differs in the end.  A part that tells nobody anything is known by all that
    it writes, a chart that writes no data by its states.
    """
    everything = list(parts(system.components))
    inside = set[str]().union(*(p.read for p in everything))
    outside = {*named, *abroad}
    found: set[str] = set()
    for part in everything:
        local = {data.name for data, _ in part.local_to} if isinstance(part, Chart) else set[str]()
        written = part.written.keys() - local
        seen = {n for n in written if n not in inside or n in outside}
        told = any(n in p.read for p in everything if p is not part for n in written)
        found |= seen if seen or told else written
        if isinstance(part, Chart) and not part.written:
            found |= {v.name for v in part.locations}
    return found


def difference(
    original: TransitionSystem, mutant: TransitionSystem, both: Product, run: Run, shortest: bool
) -> MutantDifference:
    """What a run of the product shows, when both systems were run again.

    Raises ``ReplayError`` if they do the same, and if the interpreter of the charts does something else.
    """
    run = minimise_inputs(both.system, both.goal, run)
    ours, theirs = _own(original, run), _own(mutant, run)
    allowed = [_allows(system, own) for system, own in ((original, ours), (mutant, theirs))]
    if not any(allowed):
        raise ReplayError(f"{both.system.name}: nobody allows the inputs of the run.")
    refused: AllowedBy | None = None
    if not all(allowed):
        refused = "the original" if allowed[0] else "the mutant"
    before = replace(ours, inputs=ours.inputs[:-1]) if refused else ours
    one, _ = followed(original, before, "the original")
    other, _ = followed(mutant, replace(theirs, inputs=theirs.inputs[: len(before)]), "the mutant")
    unlike = [n for n in both.observed if not refused and one[-1].after[n] != other[-1].after[n]]
    if not unlike and not refused:
        raise ReplayError(f"{both.system.name}: the two do the same in the last tick of the run.")
    tables = {v.name: v for v in (*original.variables, *original.inputs, *original.frozen)}

    def shown(values: Mapping[str, int], wanted: Collection[str]) -> dict[str, str]:
        return {n: tables[n].domain.show(values[n]) for n in wanted if n in tables}

    return MutantDifference(
        tuple(shown(tick, tick.keys()) for tick in ours.inputs),
        shown(ours.frozen, ours.frozen.keys()),
        shown(one[-1].after, unlike) if unlike else {},
        shown(other[-1].after, unlike) if unlike else {},
        _places(original, one if refused else one[:-1]),
        shortest,
        refused,
    )


def _own(system: TransitionSystem, run: Run) -> Run:
    """The run with the inputs that the system has."""
    known = [v.name for v in system.inputs]
    return Run(
        {v.name: run.frozen[v.name] for v in system.frozen},
        tuple({n: tick[n] for n in known} for tick in run.inputs),
    )


def _allows(system: TransitionSystem, run: Run) -> bool:
    from rovercheck.spec_model.lang.evaluate import step

    at: Mapping[str, int] = {**system.init, **run.frozen}
    for inputs in run.inputs:
        if not admissible(system, at, inputs):
            return False
        at = {n: v for n, v in step(system, at, inputs).items() if n not in inputs}
    return True


def _places(system: TransitionSystem, ticks: tuple[Tick, ...]) -> dict[str, str]:
    """In which state each chart is after some ticks."""
    at = ticks[-1].after if ticks else system.init
    charts = system.source.charts if system.source is not None else ()
    return {v.name: v.domain.show(at[v.name]) for c in charts for v in c.locations if v.name in at}


__all__ = ["MutantDifference", "difference", "observable"]
