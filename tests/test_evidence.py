"""The evidence under ``reports/`` is what the charts and properties of today give, verdict by verdict.

So is what the README shows of ``make check``.

``make test-full`` searches for every answer.  ``make test`` searches where the question has changed since the
report was written (a chart as lowered, a property, an invariant that is tried first), and always in small
systems.  It takes other verdicts from ``reports/verdicts.json``, replays their runs on the charts, and makes
all pages again.  So it shows that the record answers the questions of today and that every page says what is
on record; not that the engines of today find those answers, nor that nobody has forged one with its seal.
"""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.commands.check.findings import Guide, about_cases, about_faults, read_on
from rovercheck.checker.commands.check.further import CheckExtras, noticing
from rovercheck.checker.commands.check.premises import PATIENCE, cases, patient
from rovercheck.checker.commands.check.text import line, summary
from rovercheck.checker.commands.reports.record import VerdictRecord, read
from rovercheck.checker.commands.reports.run import differences, pages
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.text_wrap import plain
from rovercheck.checker.commands.shared.told import told
from rovercheck.checker.engines import Limits
from rovercheck.checker.model import kept_runs
from rovercheck.checker.model.rover import rover
from rovercheck.checker.verify.checked import CheckedProperty, PremiseCase
from rovercheck.checker.verify.finding_order import order_of
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.spec_model.rover import systems
from tests.profiles import full

ROOT = Path(__file__).parent.parent
REPORTS = ROOT / "reports"
SMALL = 12
"""Bits of what a system writes."""


@pytest.mark.long
@pytest.mark.timeout(1800)
def test_verdicts_are_as_on_record_and_the_committed_reports_show_them(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # One test, so that the properties are decided once however many processes run the suite.
    affordable = [prop for prop in catalogue().values() if not prop.costly]
    record = VerdictRecord() if full() else VerdictRecord(read(REPORTS), small)
    decided = [
        CheckedProperty(r, expected(r.property.id)) for r in record.decided(affordable, systems(), Limits())
    ]
    known = cases(decided, systems(), patient(SearchSettings(), PATIENCE), {}, shown=occurring())
    further = CheckExtras(noticing=noticing(rover()))
    verdicts = [
        replace(c, case=known.get(c.result.property.id), noticed=further.noticed(c), strict=True)
        for c in decided
    ]
    assert len(verdicts) == len(affordable)
    every = [told(c, systems()) for c in verdicts]
    assert [line(one) for one in every if one.exit is not Exit.AS_EXPECTED] == []
    guide = Guide(order=order_of(rover()), causes="reports/README.md")
    summary(every, guide)
    said = capsys.readouterr().out.splitlines()
    cases_and_faults = [*about_cases(every), *about_faults(every)]
    ending = [*said, *cases_and_faults, *read_on(every, guide)]
    shown, end = sample()
    assert [s for s in shown if s not in {line(one) for one in every}] == []
    printed = [re.sub(r": \S*rovercheck ", ": .venv/bin/rovercheck ", plain(text)) for text in ending]
    [cut] = [number for number, text in enumerate(end) if text.startswith("  ...")]
    assert end[:cut] == printed[:cut]
    assert end[cut + 1 :] == printed[cut + 1 - len(end) :]
    assert len(printed) > len(end)
    assert list(differences(REPORTS, pages(verdicts, record))) == [], "run `make reports` and commit"


def small(task: Task) -> bool:
    """Whether the answers to a task are searched for in any case."""
    return task.size <= SMALL


def occurring() -> dict[str, PremiseCase]:
    """The cases that runs on record show; that they do is what ``tests/model/test_kept_runs.py`` is about."""
    return {id: PremiseCase(True, "", run) for id, run in kept_runs.read(kept_runs.file_of(rover())).items()}


def sample() -> tuple[list[str], list[str]]:
    """The lines of verdicts that the README shows of ``make check``, and those at its end, unwrapped."""
    text = (ROOT / "README.md").read_text(encoding="utf-8").partition("    $ make check\n")[2]
    block = re.split(r"\n(?=\S)", text)[0].rstrip()
    whole = re.sub(r"\n {8}(?=\S)", " ", block)  # a line that goes on in the next
    lines = [piece.removeprefix("    ") for piece in whole.splitlines()]
    end = lines.index("")
    return [one for one in lines[:end] if not one.startswith("  ...")], lines[end + 1 :]
