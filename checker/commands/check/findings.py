"""What a check found, in a few lines: how many demands hold, the gravest findings, and where to read on."""

import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from os.path import relpath
from pathlib import Path
from shlex import quote
from shutil import which
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.told import ToldVerdict
from rovercheck.checker.results.gravity import gravest_first

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import ChainStatus
    from rovercheck.checker.model.variant import Variant

REPORTS = Path("reports/README.md")

SHOWN = 10
"""Findings that are named; the others are counted, and where all of them are is said."""
RESTRICTED = "for a restricted model"
DEMAND = {"proved": "proved", RESTRICTED: f"proved {RESTRICTED}", "violated": "violated",
          "unknown": "unknown"}  # fmt: skip
SITUATION = {"proved": "reached", RESTRICTED: f"out of reach {RESTRICTED}", "violated": "out of reach",
             "unknown": "unknown"}  # fmt: skip
"""What a verdict on a demand, and on a situation that is to be reached, is called when they are counted."""


@dataclass(frozen=True)
class Guide:
    """Where a user reads on.

    ``options`` make a command be about the same charts, ``chosen`` about the same properties; ``causes`` is a
    page on all findings.
    """

    options: str = ""
    chosen: str = ""
    causes: str = ""

    def command(self, *words: str) -> str:
        """A command about the same charts, as it is typed here."""
        return whole(" ".join(filter(None, (program(), *words, self.options))))


ALONE = Guide()
"""Of properties that are nobody's model."""


def program() -> str:
    """The name of the program, or its path where a shell would not find it by its name."""
    beside = Path(sys.executable).with_name("rovercheck")
    if which("rovercheck") or not beside.is_file():
        return "rovercheck"
    near = beside.is_relative_to(Path.cwd())
    return quote(relpath(beside) if near else str(beside))


def causes(variant: "Variant") -> str:
    """The page that tells the causes of the findings on the rover as specified, where it is at hand."""
    return causes_of_rover() if variant.own is None and not variant.name else ""


def causes_of_rover() -> str:
    """The same page of the rover as specified."""
    return str(REPORTS) if REPORTS.is_file() else ""


def totals(found: Sequence[ToldVerdict]) -> str:
    """``337 demands: 244 proved, 93 violated; 156 situations: all reached.``"""
    demands = [_word(one) for one in found if not one.situation]
    situations = [_word(one) for one in found if one.situation]
    parts = [
        f"{counted(len(words), *names)}: {_shares(words, called)}"
        for words, names, called in (
            (demands, ("demand", "demands"), DEMAND),
            (situations, ("situation", "situations"), SITUATION),
        )
        if words
    ]
    return "; ".join(parts) + "."


def by_area(found: Sequence[ToldVerdict]) -> Iterator[str]:
    """``Violated, by area: motion 12 of 59, ...; none in 22 other areas.``; nothing of a single area."""
    areas = Counter(one.area for one in found)
    violated = Counter(one.area for one in found if one.word == "violated")
    unknown = Counter(one.area for one in found if one.word == "unknown")
    if len(areas) < 2:
        return
    for word, counts in (("Violated", violated), ("Unknown", unknown)):
        if counts:
            some = ", ".join(
                f"{area.replace('_', ' ')} {n} of {areas[area]}" for area, n in counts.most_common()
            )
            rest = len(areas) - len(counts)
            none = f"; none in {counted(rest, 'other area', 'other areas')}" if rest else ""
            yield f"{word}, by area: {some}{none}."


def _word(one: ToldVerdict) -> str:
    return RESTRICTED if one.in_part else one.word


def _shares(words: Sequence[str], called: Mapping[str, str]) -> str:
    counts = Counter(words)
    if len(counts) == 1:
        return f"{'all ' if len(words) > 1 else ''}{called[words[0]]}"
    return ", ".join(f"{counts[word]} {said}" for word, said in called.items() if word in counts)


def about_cases(found: Sequence[ToldVerdict]) -> Iterator[str]:
    """Which proofs have a premise that never occurs, or of which that is unknown."""
    asked = [one for one in found if one.asked]
    empty = [one for one in asked if one.occurs is False]
    unknown = [one.id for one in asked if one.occurs is None]
    if asked and not empty and not unknown and found[0].strict:
        have = counted(len(asked), "proof has", "proofs have")
        yield f"{have} a premise (whenever ..., then ...): it occurs."
    if empty:
        yield "Vacuous proofs, whose premise never occurs:"
        yield from (f"  {one.id}, {one.on}: {one.text}" for one in empty)
        yield (
            "They say nothing about the charts: state a premise that some run meets. With --strict that is "
            "an error; rovercheck docs verdicts"
        )
    if unknown:
        yield f"Proved, unknown whether the premise occurs: {', '.join(unknown)}."


def about_faults(found: Sequence[ToldVerdict]) -> Iterator[str]:
    """Which proofs kill no known mutant."""
    idle = sorted(one.id for one in found if one.idle)
    noticing = sum(one.noticed is True for one in found)
    if noticing and not idle and found[0].strict:
        kill = counted(noticing, "proof kills", "proofs kill")
        yield f"{kill} a mutant of the charts."
    if idle:
        more = f" and {len(idle) - SHOWN} more" if len(idle) > SHOWN else ""
        yield f"Proved, and no mutant of the charts is known that they kill: {', '.join(idle[:SHOWN])}{more}."


def about_chains(told: Sequence["ChainStatus"]) -> Iterator[str]:
    """How many chains across the link hold, and which do not."""
    if told:
        good = sum(one.holds is True for one in told)
        yield f"{good} of {counted(len(told), 'chain', 'chains')} across the link hold, link by link."
        yield from (f"  {one.text}" for one in told if not one.holds)


def about_acceptances(found: Sequence[ToldVerdict]) -> Iterator[str]:
    """Which findings were accepted until a day that is over: nobody accepts them any more."""
    over = [one for one in found if one.lapsed]
    if over:
        yield "No longer accepted, as the time for which they were is over:"
        yield from (f"  {one.id}: accepted {one.lapsed}" for one in over)


def read_on(found: Sequence[ToldVerdict], guide: Guide) -> Iterator[str]:
    """The gravest findings that are not explained already, and where all are; nothing if there is none."""
    broken = [one for one in found if one.word == "violated"]
    known = gravest_first([one for one in broken if one.as_expected or one.variant], lambda one: one.gravity)
    if known:
        yield ""
        yield from listed(known)
    if broken:
        yield ""
        yield from _commands(known, len(broken), guide)


def listed(ordered: Sequence[ToldVerdict]) -> Iterator[str]:
    """The first findings, each in a line, under a line for each hazard if any is known."""
    if len(ordered) > SHOWN:
        yield f"Violated, the gravest first ({SHOWN} of {len(ordered)}):"
    else:
        yield "Violated, the gravest first:" if len(ordered) > 1 else "Violated:"
    rated = any(one.hazards for one in ordered)
    for headline, members in groupby(ordered[:SHOWN], key=lambda one: one.headline):
        if rated:
            yield f"  {headline}"
        for one in members:
            yield f"  {'  ' * rated}{one.id}, {one.system}: {one.says}"


def _commands(known: Sequence[ToldVerdict], number: int, guide: Guide) -> Iterator[str]:
    """What to type, or to read, to see more of so many findings."""
    if runs := [one.id for one in known if one.ticks is not None]:
        yield f"Tick by tick: {guide.command('trace', runs[0])}"
    page = guide.command("report", guide.chosen, "-o review.html")
    yield f"All {number} on one page: {page}" if number > 1 else f"On a page: {page}"
    if guide.causes:
        yield f"Causes and proposed repairs: {guide.causes}"
