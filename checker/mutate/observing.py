"""What can be seen of a part from outside, and the run in which a mutant is seen to differ."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from checker.mutate.product import Product
from checker.mutate.wiring import written_by
from checker.runs.calm import calmed
from checker.runs.replay import ReplayError, followed
from checker.trace import Tick
from checker.verdict import Run
from spec_model.lang.chart import Chart, parts
from spec_model.lang.evaluate import admissible
from spec_model.lang.system import System, TransitionSystem, enabled_in
from spec_model.lang.walk import variables


@dataclass(frozen=True)
class Difference:
    """A run that tells a mutant from the original, both of which were run by the interpreter of the charts.

    ``inputs`` are those of each tick, ``original`` and ``mutant`` the values after the last tick of what
    differs then; ``places`` says in which state each chart was before it.  ``refused``: only this one, the
    original or the mutant, has a last tick with these inputs.  All values are as people write them.
    """

    inputs: tuple[Mapping[str, str], ...]
    frozen: Mapping[str, str]
    original: Mapping[str, str]
    mutant: Mapping[str, str]
    places: Mapping[str, str]
    shortest: bool
    allowed_by: str = ""

    def __len__(self) -> int:
        return len(self.inputs)


def observable(system: System, concerned: Collection[str], named: Collection[str] = ()) -> set[str]:
    """The variables by which others know what some parts do.

    That is what they write for others to read, data that properties speak of (those ``named``), and what they
    write that nobody reads, which is an output.  A part that writes no data is known by its states.
    """
    everything = list(parts(system.components))
    outside = set(variables(system.assumed, *(e.by for e in enabled_in(system.components))))
    found: set[str] = set()
    for part in everything:
        if part.name not in concerned:
            continue
        others = outside.union(*(p.read for p in everything if p is not part))
        own = {data.name for data, _ in part.local_to} if isinstance(part, Chart) else set()
        seen = {n for n in written_by(part) if n in others}
        seen |= {n for n in part.written if n not in own and (n not in part.read or n in named)}
        if not seen and isinstance(part, Chart):
            seen = {v.name for v in part.locations}
        found |= seen or part.written.keys()
    return found


def shown(system: System, seen: Collection[str], named: Collection[str] = ()) -> set[str]:
    """What of ``seen`` shows in the end: what other parts read shows by what they write, and so on.

    What conditions and assumptions read, and what is ``named``, is shown itself.
    """
    everything = list(parts(system.components))
    kept = {*named, *variables(system.assumed, *(e.by for e in enabled_in(system.components)))}
    found, known, todo = set[str](), set(seen), list(seen)
    while todo:
        name = todo.pop()
        readers = [p.name for p in everything if name in p.read and name not in written_by(p)]
        if name in kept or not readers:
            found.add(name)
            continue
        more = observable(system, readers, named) - known
        known |= more
        todo += more
    return found


def difference(
    original: TransitionSystem, mutant: TransitionSystem, both: Product, run: Run, shortest: bool
) -> Difference:
    """What a run of the product shows, when both systems were run again.

    Raises ``ReplayError`` if they do the same, and if the interpreter of the charts does something else.
    """
    run = calmed(both.system, both.goal, run)
    ours, theirs = _own(original, run), _own(mutant, run)
    allowed = [_allows(system, own) for system, own in ((original, ours), (mutant, theirs))]
    if not any(allowed):
        raise ReplayError(f"{both.system.name}: nobody allows the inputs of the run.")
    refused = "" if all(allowed) else "the original" if allowed[0] else "the mutant"
    before = replace(ours, inputs=ours.inputs[:-1]) if refused else ours
    one, _ = followed(original, before, "the original")
    other, _ = followed(mutant, replace(theirs, inputs=theirs.inputs[: len(before)]), "the mutant")
    unlike = [n for n in both.observed if not refused and one[-1].after[n] != other[-1].after[n]]
    if not unlike and not refused:
        raise ReplayError(f"{both.system.name}: the two do the same in the last tick of the run.")
    tables = {v.name: v for v in (*original.variables, *original.inputs, *original.frozen)}

    def shown(values: Mapping[str, int], wanted: Collection[str]) -> dict[str, str]:
        return {n: tables[n].domain.show(values[n]) for n in wanted if n in tables}

    return Difference(
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
    from spec_model.lang.evaluate import step

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


__all__ = ["Difference", "difference", "observable", "shown"]
