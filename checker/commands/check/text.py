"""What ``check`` prints: a line for each verdict, and at the end counts, findings and where to read on."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rovercheck.checker.commands.check.certificates import certificates, certified
from rovercheck.checker.commands.check.findings import (
    ALONE,
    Guide,
    about_acceptances,
    about_cases,
    about_chains,
    about_faults,
    by_area,
    read_on,
    totals,
)
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.output import at_terminal, out, wrapped
from rovercheck.checker.commands.shared.told import ToldVerdict
from rovercheck.checker.io.printable import json_text

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import ChainStatus

EVIDENCE = 33
"""The column in which the evidence of a verdict begins."""
FEW = 20
"""Verdicts that have a line each on every terminal."""
SIGNS = {"proved": "✓", "violated": "✗", "unknown": "?"}


@dataclass(frozen=True)
class CheckText:
    """How verdicts are told: with ``quiet`` only what is not as expected is printed.

    ``guide`` is what helps to read on.  With ``brief``, what is as expected is only counted.
    """

    as_json: bool = False
    quiet: bool = False
    guide: Guide = ALONE
    brief: bool = False

    def each(self, one: ToldVerdict) -> None:
        """Print a verdict as soon as it is there."""
        if not self.as_json and not ((self.quiet or self.brief) and one.exit is Exit.AS_EXPECTED):
            out.print(wrapped(line(one), EVIDENCE), markup=False)

    def end(self, found: Sequence[ToldVerdict], chains: Sequence["ChainStatus"], faulty: bool) -> None:
        """Print what is said of all of them; ``faulty``: an engine failed."""
        if self.as_json:
            from rovercheck.checker.commands.check.document import document

            print(json_text(document(found, chains=chains, faulty=faulty), ascii=True))
        elif not self.quiet:
            if not self.brief:
                out.print()
            summary(found, self.guide)
            if self.brief:
                _say(*by_area(found))
            about = (
                *about_acceptances(found),
                *about_cases(found),
                *about_faults(found),
                *about_chains(chains),
            )
            _say(*about, *read_on(found, self.guide))
            if self.brief:
                _say(
                    f"A line for every verdict: {self.guide.command('check', self.guide.chosen, '--verbose')}"
                )
        else:
            wrong = [one for one in found if one.strict and one.exit is not Exit.AS_EXPECTED]
            _say(*about_acceptances(found), *about_cases(wrong), *about_faults(wrong))


def brief(number: int, verbose: bool) -> bool:
    """Whether so many verdicts are only counted: on a terminal, unless every line is asked for."""
    return not verbose and number > FEW and at_terminal(out)


def _say(*texts: str) -> None:
    for text in texts:
        out.print(wrapped(text, 6), markup=False)


def line(one: ToldVerdict) -> str:
    """One verdict in one line of 80 columns: sign, id, verdict, evidence."""
    sign = "≈" if one.in_part else SIGNS[one.word]
    model = "for a restricted model: " if one.in_part else ""
    text = f"{sign} {one.id:<21} {one.word:<8} {model}{one.short}{certified(one.certificate)}"
    if one.as_expected:
        return text + (", as expected" if one.word != "proved" else "")
    return text + f"\n    {_other(one)} {one.recorded}"


def _other(one: ToldVerdict) -> str:
    """What the verdict is compared with, in front of the expected verdict."""
    return f"{one.variant}; as specified it is" if one.variant else "CHANGED: expected"


def summary(found: Sequence[ToldVerdict], guide: Guide) -> None:
    """Counts, and for each change what to do next."""
    changed = [one for one in found if not one.as_expected]
    out.print(totals(found), markup=False)
    parts = sum(one.in_part for one in found)
    if parts:
        out.print(f"≈ {parts} of them for a restricted model: see the notes of their systems.", markup=False)
    certificates(found)
    if not changed:
        out.print("Every verdict is as expected.")
        return
    if changed[0].variant:
        out.print(f"{len(changed)} of them differ {changed[0].variant}.", markup=False)
        return
    for one in changed:
        _explain(one, guide)


def _explain(one: ToldVerdict, guide: Guide) -> None:
    out.print(f"\n{one.id} is {one.word}; expected: {one.recorded}.", markup=False)
    out.print(f"  {one.text}", markup=False)
    if one.word == "violated" and one.ticks is not None:
        for transition in one.fired:
            out.print(f"  fired: {transition}", markup=False)
        out.print(f"  See it whole: {guide.command('trace', one.id)}", markup=False)
