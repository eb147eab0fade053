"""What became of mutants, for people: survivors with the runs that no property forbids, then counts."""

from collections import Counter
from collections.abc import Iterator, Mapping

from rovercheck.checker.commands.mutate.results import MutationResults, One
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.mutate.fate import Fate
from rovercheck.checker.mutate.observation import MutantDifference
from rovercheck.checker.results.trace import counted_ticks

Line = tuple[str, int]
"""A line, and the blanks in front of what is wrapped."""

MANY = 4
"""Inputs of a tick that are named in a sketch; of more, only those that change."""
HEADS = {
    Fate.SURVIVOR: "Survived: no property kills the mutant, and a run shows in what it differs",
    Fate.UNKNOWN: "Unknown: neither killed nor shown to survive",
    Fate.NOTICED: "Only an expected violation is gone: a property expected to be violated is proved",
}


def report(found: MutationResults) -> Iterator[Line]:
    """The lines of the report."""
    for fate, head in HEADS.items():
        some = found.of(fate)
        if some:
            yield f"{head} ({len(some)}):", 2
            for one in some:
                yield from _one(one)
            yield "", 0
    if found.undecided:
        ids = ", ".join(found.undecided)
        yield f"Not used, since they are not decided on the original: {ids}.", 2
    yield from _counts(found)


def _one(one: One) -> Iterator[Line]:
    system, mutant, judged = one
    yield f"  {mutant.id}", 4
    place = f"{mutant.place}: " if mutant.place else ""
    yield f"    {place}{mutant.text}", 6
    if judged.fate is Fate.NOTICED:
        yield f"    {judged.killer} of {judged.on} is proved of it", 6
    elif judged.why:
        yield f"    {judged.why}", 6
    if judged.difference is not None:
        yield from _difference(system, judged.difference)
        yield f"    {sketch(judged.difference)}", 6


def _difference(system: str, found: MutantDifference) -> Iterator[Line]:
    length = "the shortest distinguishing run" if found.shortest else "a distinguishing run"
    yield f"    {length}, {counted_ticks(len(found))} of {system}:", 6
    if found.frozen:
        yield f"      always  {_pairs(found.frozen)}", 14
    before: Mapping[str, str] = {}
    waited = 0
    for number, inputs in enumerate(found.inputs, start=1):
        new = {n: v for n, v in inputs.items() if before.get(n) != v}
        if not new and number not in (1, len(found)):
            waited += 1
        else:
            if waited:
                yield f"      {counted_ticks(waited)} more with the same inputs", 14
            waited, said = 0, _pairs(new) if new else "the same inputs" if inputs else "no input"
            yield f"      tick {number}  {said}", 14
        before = inputs
    if found.allowed_by:
        yield f"      only {found.allowed_by} allows the inputs of the last tick", 8
    for name, value in found.original.items():
        yield f"      then {name} is {value}, in the mutant {found.mutant[name]}", 8


def _pairs(values: Mapping[str, str]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in values.items())


def sketch(found: MutantDifference) -> str:
    """The sentence of a property that would kill the mutant."""
    if found.allowed_by:
        return f"No property requires it: these inputs are possible only as {found.allowed_by} allows them."
    last = dict(found.inputs[-1])
    if len(last) > MANY and len(found) > 1:
        last = {n: v for n, v in last.items() if found.inputs[-2][n] != v} or last
    when = [f"{chart} {_where(state)}" for chart, state in found.places.items()]
    when += [f"{name} = {value}" for name, value in last.items()]
    then = " and ".join(f"{name} is {value}" for name, value in found.original.items())
    return (
        f"No property requires: when {', '.join(when)}, then {then}."
        if when
        else f"No property requires: {then}."
    )


def _where(state: str) -> str:
    return "has not begun" if state == "-" else f"was in {state}"


def _counts(found: MutationResults) -> Iterator[Line]:
    by = Counter(judged.fate for _, _, judged in found.judged)
    names = ", ".join(found.systems) if len(found.systems) <= MANY else f"{len(found.systems)} systems"
    judged = f"{counted(len(found.judged), 'mutant', 'mutants')} of {names}"
    if found.chosen < found.made:
        judged += f", drawn from {found.made:,} with seed {found.seed}"
    if len(found.judged) < found.chosen:
        judged += f", {found.chosen - len(found.judged):,} more not judged"
    yield f"{judged}:", 2
    shown = [
        (Fate.KILLED, "killed"),
        (Fate.NOTICED, "only an expected violation is gone"),
        (Fate.EQUIVALENT, "equivalent, proved: nothing observable ever differs"),
        (Fate.SURVIVOR, "survived"),
        (Fate.UNKNOWN, "unknown"),
        (Fate.NO_CHART, "not a chart: refused as ill-formed"),
        (Fate.NO_CHANGE, "no change: the same step"),
    ]
    for fate, text in shown:
        yield f"  {by[fate]:>6,}  {text}", 10
    killers = Counter(judged.killer for _, _, judged in found.of(Fate.KILLED))
    if killers:
        yield "Killers: " + ", ".join(f"{id} {n}" for id, n in killers.most_common()) + ".", 2


__all__ = ["report", "sketch"]
