"""What a check says at its end: true counts, the gravest findings, and commands that show the others."""

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from rovercheck.checker.cli import app, run
from rovercheck.checker.commands.check import findings
from rovercheck.checker.commands.check.findings import SHOWN, Guide, listed, program, read_on, totals
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.text_wrap import plain
from rovercheck.checker.commands.shared.told import ToldVerdict, told
from rovercheck.checker.model.rover import rover
from rovercheck.checker.results.gravity import gravest_first
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Proved, Unknown, Verdict, Violated
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.finding_order import FindingOrder
from rovercheck.checker.verify.result import Result
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, Reachable, always, reachable
from rovercheck.properties.requirements import PROMISES, requirements
from rovercheck.spec_model.lang.expr import flag
from tests.render.exits_zoo import told as noted
from tests.render.zoo import long_trace

LIFT = str(Path(__file__).parents[2] / "examples/models/lift")
ALL = Proved(Exhausted(2, 2, 1, ()), "explicit")
NONE = Violated(Exhausted(2, 2, 1, ()), "explicit")
OPEN = Unknown("late", 0, "bmc")


def demand(id: str, *covers: str) -> Property:
    return always(id, f"{id} is kept.", that=flag("kept"), covers=covers or ["R-1"], on="toy")


def situation(id: str, *covers: str) -> Property:
    return reachable(id, f"{id} can be reached.", that=flag("there"), covers=covers or ["R-1"], on="toy")


def run_of(ticks: int) -> Trace:
    """Some run of so many ticks."""
    return noted(long_trace(ticks - 3))


BY_SIZE = {"toy": rover().systems["relay"], "whole": rover().systems["rover"]}
ORDER = FindingOrder({}, ["R-1", "R-2"], BY_SIZE)


def on(prop: Property, verdict: Verdict, in_part: bool = False) -> ToldVerdict:
    return told(CheckedProperty(Result(prop, verdict, "toy", in_part), Expected(verdict.word)), ORDER)


def broken(id: str, *covers: str, ticks: int = 8, system: str = "toy") -> ToldVerdict:
    result = Result(demand(id, *covers), Violated(run_of(ticks), "bmc"), system)
    return told(CheckedProperty(result, Expected("violated")), ORDER)


def violated(found: Sequence[ToldVerdict]) -> list[ToldVerdict]:
    return [one for one in found if one.word == "violated"]


def ids(found: Sequence[ToldVerdict]) -> list[str]:
    return [one.id for one in found]


REACHED = on(situation("S-1"), Proved(run_of(5), "bmc"))


@pytest.mark.parametrize(
    ("found", "said"),
    [
        ([on(demand("D-1"), ALL)], "1 demand: proved."),
        ([on(demand("D-1"), ALL), on(demand("D-2"), ALL)], "2 demands: all proved."),
        ([on(demand("D-1"), ALL), broken("D-2")], "2 demands: 1 proved, 1 violated."),
        ([REACHED], "1 situation: reached."),
        ([broken("D-1"), REACHED, on(situation("S-2"), NONE)],
         "1 demand: violated; 2 situations: 1 reached, 1 out of reach."),
        ([on(demand("D-1"), ALL, True), on(demand("D-2"), OPEN), on(situation("S-1"), OPEN)],
         "2 demands: 1 proved for a restricted model, 1 unknown; 1 situation: unknown."),
    ],
)  # fmt: skip
def test_demands_and_situations_are_counted_apart(found: list[ToldVerdict], said: str) -> None:
    assert totals(found) == said


def test_the_gravest_finding_of_each_requirement_comes_first() -> None:
    found = [
        broken("D-1", "R-2", ticks=5),
        broken("D-2", "R-2", ticks=4),
        on(situation("S-1", "R-1"), NONE),
        broken("D-3", "R-1", ticks=9),
        broken("D-4", "R-1", ticks=99, system="whole"),
        broken("D-5", "R-9"),
        on(demand("D-6", "R-1"), ALL),
        broken("D-7", "R-2", "R-1", ticks=10),
    ]
    assert ids(gravest_first(violated(found), lambda one: one.gravity)) == [
        "D-4", "D-2", "D-5", "D-3", "D-1", "D-7", "S-1",
    ]  # fmt: skip


def test_no_finding_is_left_out_without_a_word() -> None:
    found = [broken(f"D-{n}", f"Q-{n}", ticks=8 + n) for n in range(SHOWN + 3)]
    guide = Guide(causes="causes.md")
    blank, head, *lines = read_on([*found, REACHED], guide)
    assert blank == "" and head.endswith(f"({SHOWN} of {SHOWN + 3}):")
    assert lines[:SHOWN] == [f"  D-{n}, toy: D-{n} is kept." for n in range(SHOWN)]
    assert lines[SHOWN] == "" and plain(lines[SHOWN + 1]).endswith("rovercheck trace D-0")
    assert lines[SHOWN + 2].startswith(f"All {SHOWN + 3} on one page: ")
    assert lines[SHOWN + 3] == "Causes and proposed repairs: causes.md"
    assert next(listed(found[:SHOWN])) == "Violated, the gravest first:"
    assert next(listed(found[:1])) == "Violated:"
    assert list(read_on([REACHED], Guide())) == []


def test_the_promises_of_the_rover_come_first() -> None:
    assert set(PROMISES) <= requirements().keys()
    assert rover().by_gravity[: len(PROMISES)] == PROMISES
    assert sorted(rover().by_gravity) == sorted(requirements())
    demands = [p for p in rover().properties.values() if not isinstance(p.form, Reachable)]
    assert [id for id in PROMISES if not any(id in p.covers for p in demands)] == []


@pytest.mark.parametrize(
    ("arguments", "same"),
    [
        ([], ["--model", LIFT]),
        (["PB1-15"], []),
        (["PB1-15", "--system", "relay"], ["--interpret", "S43=AND"]),
    ],
)
def test_the_commands_that_show_more_can_be_typed(
    arguments: list[str],
    same: list[str],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    """About the same charts, all of them."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(findings, "which", lambda name: name)
    assert run(["check", *arguments, *same]) in (Exit.AS_EXPECTED, Exit.FAILED)
    said = capsys.readouterr().out.splitlines()
    shown = [line.partition(": ")[2] for line in said if line.startswith(("Tick by tick: ", "On a page: "))]
    assert len(shown) == 2
    for command in shown:
        _, verb, *words = shlex.split(command)
        with app.commands[verb].make_context(verb, [*words]) as context:
            assert not context.args
        assert words[len(words) - len(same) :] == same


def test_with_quiet_and_for_machines_nothing_is_added(capsys: pytest.CaptureFixture[str]) -> None:
    run(["check", "LIFT-3", "--model", LIFT, "--quiet"])
    assert capsys.readouterr().out == ""
    run(["check", "LIFT-3", "--model", LIFT, "--json"])
    assert capsys.readouterr().out.rstrip().endswith("}")


def test_what_is_not_on_record_is_explained_and_not_listed_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run(["init", str(tmp_path / "h")])
    (tmp_path / "h/baseline.toml").write_text("", encoding="utf-8")
    capsys.readouterr()
    assert run(["check", "--model", str(tmp_path / "h/heater.py")]) is Exit.FAILED
    said = capsys.readouterr().out
    assert said.count("See it whole:") == 1 and "Violated" not in said and "On a page:" in said


def test_the_program_is_named_as_it_is_found_here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    place = tmp_path / "my env" / "bin"
    place.mkdir(parents=True)
    monkeypatch.setattr(sys, "executable", str(place / "python"))
    monkeypatch.setattr(findings, "which", lambda name: None)
    assert program() == "rovercheck"
    (place / "rovercheck").touch()
    assert program() == f"'{place}/rovercheck'"
    monkeypatch.chdir(tmp_path)
    assert program() == "'my env/bin/rovercheck'"
    monkeypatch.setattr(findings, "which", lambda name: "/usr/bin/rovercheck")
    assert program() == "rovercheck"
