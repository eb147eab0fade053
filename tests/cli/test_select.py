"""Which properties a command line names."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import SelectionOptions
from rovercheck.checker.commands.shared.select import pick_properties
from rovercheck.properties.catalogue import catalogue


def test_several_systems_are_all_looked_at() -> None:
    """Only the last ``--system`` counted."""
    known = catalogue()
    each = [pick_properties((), (name,), known) for name in ("relay", "obstacles")]
    both = pick_properties((), ("obstacles", "relay"), known)
    assert all(each) and sorted(p.id for p in both) == sorted(p.id for part in each for p in part)
    assert pick_properties(("PB1-15",), ("relay", "obstacles"), known) == [known["PB1-15"]]


def test_a_system_that_is_not_there_is_refused_among_others() -> None:
    with pytest.raises(UsageError, match=r"There is no system 'realy'.*relay"):
        pick_properties((), ("relay", "realy"), catalogue())


def test_the_command_shown_again_has_every_system() -> None:
    assert SelectionOptions(("A",), ("relay", "b c"), True).again == "A --system relay --system 'b c' --full"


def test_check_and_export_take_several_systems(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["--system", "obstacles", "--system", "relay"]
    assert run(["check", "PB1-11", *asked, "--json"]) == Exit.AS_EXPECTED
    assert [row["id"] for row in json.loads(capsys.readouterr().out)["results"]] == ["PB1-11"]
    assert run(["export", "PB1-11", *asked, "-o", str(tmp_path / "one.aig")]) == Exit.AS_EXPECTED
