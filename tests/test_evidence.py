"""The evidence under ``reports/`` is what the charts and properties of today give, verdict by verdict."""

from pathlib import Path

import pytest

from checker.commands.check import Compared, line, results
from checker.commands.reporting import differences, pages
from checker.decide import AUTO
from checker.engine import Limits
from properties.catalogue import catalogue, expected
from spec_model.rover import systems

REPORTS = Path(__file__).parent.parent / "reports"


@pytest.mark.long
@pytest.mark.timeout(1800)
def test_verdicts_are_as_on_record_and_the_committed_reports_show_them() -> None:
    # One test, so that the properties are decided once however many processes run the suite.
    affordable = [prop for prop in catalogue().values() if not prop.costly]
    verdicts = [Compared(r, expected(r.property.id)) for r in results(affordable, systems(), AUTO, Limits())]
    assert len(verdicts) == len(affordable)
    assert [line(c) for c in verdicts if not c.as_expected] == []
    assert list(differences(REPORTS, pages(verdicts))) == [], "run `make reports` and commit"
