"""The measured targets, each with the figure that a comparison gives for it."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from statistics import median
from typing import TYPE_CHECKING

from benchmarks.evidence import STANDS
from benchmarks.markdown import number
from benchmarks.measure import Sample, seconds

if TYPE_CHECKING:
    from benchmarks.compare import Measured, Runs

MANY = 1_000_000
"""States from which on bytes per state say something: below, fixed costs are most of it."""
KNOWN = {"P1": None, "P2": None, "P3": None, "P3h": None, "P4": 200, "P5": 406}
"""The length of the shortest run that breaks a property, None where no run does."""


@dataclass(frozen=True)
class Target:
    """What is wanted, what was measured, and whether that meets it (None: not measured)."""

    text: str
    figure: str
    met: bool | None


def targets(found: "Measured") -> list[Target]:
    """Every target that RoverLite can show and that was run for, in the order in which they were set."""
    searches = [_times_as_fast(found, "C factored", 0.5), _times_as_fast(found, "SPIN", 4.0), _bytes(found)]
    decisions = [_start_up, _together, _evidence, _lengths]
    return [
        *(searches if found.searches else []),
        _large(found),
        *(target(found) for target in decisions if found.properties),
        _agreement(found),
    ]


def _judged(text: str, figures: Mapping[str, float | None], good: Callable[[float], bool]) -> Target:
    """A target about each of some figures; one that was not measured leaves it open unless others fail."""
    shown = ", ".join(f"{name} {number(value)}" for name, value in figures.items())
    verdicts = [None if value is None else good(value) for value in figures.values()]
    met = False if False in verdicts else None if None in verdicts or not verdicts else True
    return Target(text, shown, met)


def _times_as_fast(found: "Measured", other: str, least: float) -> Target:
    def ratio(runs: "Runs") -> float | None:
        own, theirs = seconds(runs["ours"]), seconds(runs.get(other, ()))
        return theirs / own if own and theirs else None

    ratios = {name: ratio(runs) for name, runs in found.searches.items()}
    return _judged(f"search at least {least:g} times as fast as {other}", ratios, lambda r: r >= least)


def _bytes(found: "Measured") -> Target:
    each = {name: runs["ours"][0] for name, runs in found.searches.items()}
    figures = {n: s.memory / s.states for n, s in each.items() if s.memory and s.states and s.states >= MANY}
    text = "at most 24 bytes for each state (models above 1 million)"
    return _judged(text, figures, lambda b: b <= 24)


def _large(found: "Measured") -> Target:
    text = "60 million states in under 6 GB"
    if found.large is None or not found.large.memory:
        return Target(text, "run with --large", None)
    figure = f"{found.large.states:,}: {found.large.memory / 1e9:.1f} GB, {found.large.seconds:.0f} s"
    enough = (found.large.states or 0) >= 60e6 and found.large.decided
    return Target(text, figure, enough and found.large.memory < 6e9)


def _start_up(found: "Measured") -> Target:
    wall = median(c.wall for c in found.start_up)
    cpu = median(c.seconds for c in found.start_up)
    return Target(
        "a cached run of the command line in under 1 s",
        f"{wall:.2f} s of wall time, {cpu:.2f} s of the processor",
        wall < 1,
    )


def _together(found: "Measured") -> Target:
    text = "all six properties decided in 5 times ABC's pdr or 3 s"
    own = [s for s in found.together if s.decided]
    if len(own) < len(found.together):
        return Target(text, found.together[-1].note, False)
    rival = [seconds(runs.get("ABC pdr", ())) for runs in found.properties.values()]
    theirs = sum(s for s in rival if s is not None) if None not in rival else None
    most = max(3.0, 5 * (theirs or 0))
    taken, wall = median(s.seconds for s in own), median(s.wall for s in own)
    figure = f"{taken:.1f} s of the processor ({wall:.1f} s of wall time), of {most:.1f} s"
    return Target(text, figure + (f"; ABC {theirs:.1f} s" if theirs else "; without ABC"), taken <= most)


def _evidence(found: "Measured") -> Target:
    """Whether what engines in turn say of each property stands."""
    last = {goal: runs["auto"][-1] for goal, runs in found.properties.items()}
    weak = [f"{goal}: {s.evidence or s.verdict}" for goal, s in last.items() if s.evidence not in STANDS]
    shown = ", ".join(f"{goal} {s.evidence}" for goal, s in last.items())
    return Target("each certified or replayed", "; ".join(weak) or shown, not weak)


def _lengths(found: "Measured") -> Target:
    """Whether some engine of ours says that 200 and 406 are the shortest lengths."""
    text = "P4 and P5 with their shortest length, 200 and 406"
    shown, met = [], True
    for goal in ("P4", "P5"):
        own = [(n, s) for n, s in _ours(found.properties[goal]) if s.note == "shortest"]
        right = [n for n, s in own if s.length == KNOWN[goal]]
        met = met and bool(right) and len(right) == len(own)
        shown.append(f"{goal} {KNOWN[goal]} by {', '.join(dict.fromkeys(right)) or 'none'}")
    return Target(text, "; ".join(shown), met)


def _agreement(found: "Measured") -> Target:
    """Whether every tool that decides a property, ours or not, says what is known of it."""
    text = "every engine and tool agrees on every verdict"
    wrong, agreed = [], 0
    for goal, runs in found.properties.items():
        for name, sample in _each(runs):
            if sample.decided:
                agreed += 1
                if not agrees(goal, sample):
                    wrong.append(f"{name} on {goal}: {sample.verdict} {sample.length or ''}".strip())
    counts = {name: {s.states for s in _decided(runs)} for name, runs in found.searches.items()}
    wrong += [f"{name}: {sorted(map(str, c))} states" for name, c in counts.items() if len(c) > 1]
    figure = f"{agreed} runs" + ", and all counts of states" * bool(counts)
    return Target(text, "; ".join(wrong) or figure, not wrong)


def agrees(goal: str, sample: Sample) -> bool:
    """Whether a decided run has the known verdict; a run may be longer unless it claims to be shortest."""
    length = KNOWN[goal]
    if length is None or sample.verdict != "reached":
        return (sample.verdict == "proved") == (length is None)
    return sample.length is not None and (
        sample.length == length or (sample.note != "shortest" and sample.length > length)
    )


def _decided(runs: "Runs") -> Iterator[Sample]:
    return (s for s in chain.from_iterable(runs.values()) if s.decided)


def _each(runs: "Runs") -> Iterator[tuple[str, Sample]]:
    return ((name, s) for name, samples in runs.items() for s in samples)


def _ours(runs: "Runs") -> Sequence[tuple[str, Sample]]:
    return [(n, s) for n, s in _each(runs) if n != "Z3" and not n.startswith("ABC")]
