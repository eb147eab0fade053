"""What a check found, in a few lines: how many demands hold, the gravest findings, and where to read on."""

import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from os.path import relpath
from pathlib import Path
from shlex import quote
from shutil import which
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.verify.finding_order import FindingOrder
from rovercheck.properties.forms import Reachable
from rovercheck.properties.hazards import Hazard

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import ChainStatus
    from rovercheck.checker.model.variant import Variant
    from rovercheck.checker.verify.checked import CheckedProperty

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

    ``options`` make a command be about the same charts, ``chosen`` about the same properties.  ``order`` says
    which findings are gravest; ``causes`` is a page on all findings.
    """

    options: str = ""
    chosen: str = ""
    order: FindingOrder = field(default_factory=FindingOrder)
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
    there = variant.own is None and not variant.name and REPORTS.is_file()
    return str(REPORTS) if there else ""


def totals(found: Sequence["CheckedProperty"]) -> str:
    """``337 demands: 244 proved, 93 violated; 156 situations: all reached.``"""
    kinds = [(one, isinstance(one.result.property.form, Reachable)) for one in found]
    demands = [_word(one) for one, situation in kinds if not situation]
    situations = [_word(one) for one, situation in kinds if situation]
    parts = [
        f"{counted(len(words), *names)}: {_shares(words, called)}"
        for words, names, called in (
            (demands, ("demand", "demands"), DEMAND),
            (situations, ("situation", "situations"), SITUATION),
        )
        if words
    ]
    return "; ".join(parts) + "."


def _word(one: "CheckedProperty") -> str:
    return RESTRICTED if one.result.in_part else one.verdict.word


def _shares(words: Sequence[str], called: Mapping[str, str]) -> str:
    counts = Counter(words)
    if len(counts) == 1:
        return f"{'all ' if len(words) > 1 else ''}{called[words[0]]}"
    return ", ".join(f"{counts[word]} {said}" for word, said in called.items() if word in counts)


def about_cases(found: Sequence["CheckedProperty"]) -> Iterator[str]:
    """Which proofs have a premise that never occurs, or of which that is unknown."""
    told = [(one.result.property, one.case.occurs) for one in found if one.case is not None]
    empty = [prop for prop, occurs in told if occurs is False]
    unknown = [prop.id for prop, occurs in told if occurs is None]
    if told and not empty and not unknown and found[0].strict:
        have = counted(len(told), "proof has", "proofs have")
        yield f"{have} a premise (whenever ..., then ...): it occurs."
    if empty:
        yield "Vacuous proofs, whose premise never occurs:"
        yield from (f"  {prop.id}, {prop.on}: {prop.text}" for prop in empty)
    if unknown:
        yield f"Proved, unknown whether the premise occurs: {', '.join(unknown)}."


def about_faults(found: Sequence["CheckedProperty"]) -> Iterator[str]:
    """Which proofs kill no known mutant."""
    idle = sorted(one.result.property.id for one in found if one.idle)
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


def about_acceptances(found: Sequence["CheckedProperty"]) -> Iterator[str]:
    """Which findings were accepted until a day that is over: nobody accepts them any more."""
    over = [(one.result.property.id, ended) for one in found if (ended := one.lapsed) is not None]
    if over:
        yield "No longer accepted, as the time for which they were is over:"
        yield from (f"  {id}: accepted {ended.term}: {ended.because}" for id, ended in over)


def read_on(found: Sequence["CheckedProperty"], guide: Guide) -> Iterator[str]:
    """The gravest findings that are not explained already, and where all are; nothing if there is none."""
    broken = [one for one in found if one.verdict.word == "violated"]
    known = guide.order.ordered([one for one in broken if one.as_expected or one.variant])
    if known:
        yield ""
        yield from listed(known, guide.order)
    if broken:
        yield ""
        yield from _commands(known, len(broken), guide)


def listed(ordered: Sequence["CheckedProperty"], order: FindingOrder) -> Iterator[str]:
    """The first findings, each in a line, under a line for each hazard."""
    if len(ordered) > SHOWN:
        yield f"Violated, the gravest first ({SHOWN} of {len(ordered)}):"
    else:
        yield "Violated, the gravest first:" if len(ordered) > 1 else "Violated:"
    deeper = "  " if order.hazards else ""
    for hazard, members in groupby(ordered[:SHOWN], key=order.hazard):
        if order.hazards:
            yield f"  {headline(hazard)}"
        for one in members:
            yield f"  {deeper}{one.result.property.id}, {one.result.system}: {told(one)}"


def headline(hazard: Hazard) -> str:
    """``catastrophic, H-COLLISION: The rover runs into an obstacle.``"""
    return f"{', '.join(filter(None, (hazard.severity, hazard.id)))}: {hazard.text}"


def told(one: "CheckedProperty") -> str:
    """What goes wrong, as far as that is on record, or what should be true."""
    if one.expected.effect and one.expected.verdict == one.verdict.word and not one.variant:
        return one.expected.effect
    prop = one.result.property
    return f"Cannot be reached: {prop.text}" if isinstance(prop.form, Reachable) else prop.text


def _commands(known: Sequence["CheckedProperty"], number: int, guide: Guide) -> Iterator[str]:
    """What to type, or to read, to see more of so many findings."""
    if runs := [one.result.property.id for one in known if one.length is not None]:
        yield f"Tick by tick: {guide.command('trace', runs[0])}"
    page = guide.command("report", guide.chosen, "-o review.html")
    yield f"All {number} on one page: {page}" if number > 1 else f"On a page: {page}"
    if guide.causes:
        yield f"Causes and proposed repairs: {guide.causes}"
