"""Runs chosen for the causes found: they tell a limit, or a time, from others that explained as much."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.adapters import python
from rovercheck.checker.cli import run
from rovercheck.checker.commands.compare import rounds
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare import cross_check, effort, search
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.fixed_runs import fixed
from rovercheck.checker.compare.run_follower import RecordedRun, RunFollower
from rovercheck.checker.compare.strategy import ENVIRONMENTS, environment
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.conformance.deviations import DeviationTally
from rovercheck.checker.conformance.follower import Behaviour
from rovercheck.checker.conformance.tracker import UndecidedRow
from rovercheck.checker.diagnosis.causes import (
    CauseGroups,
    CauseSearch,
    DeviationCause,
    PartChanges,
    cause_groups,
)
from rovercheck.checker.diagnosis.evidence import Evidence
from rovercheck.checker.diagnosis.hypotheses import timer_changes
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.checker.diagnosis.other_limits import between, other_limits
from rovercheck.checker.diagnosis.variant import WrittenChange, with_change
from rovercheck.checker.model.load import load
from rovercheck.spec_model.abstraction import boards
from tests.model_files.files import FIRMWARE, heater_files

OTHERS = """

class Hotter(Heater):
    limit, rest = 28, 260


class Pierced(Heater):
    "Switches off above 28, and at 27."
    limit = 28

    def step(self, given):
        return super().step({**given, "temperature": 40} if given["temperature"] == 27 else given)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("heater")
    return heater_files(made, FIRMWARE + OTHERS)


def asked(folder: Path, firmware: str, *more: str) -> list[str]:
    address = f"python:{folder / 'firmware.py'}:{firmware}"
    return ["compare", "--model", str(folder / "heater.py"), "--impl", address, "--examples", "10",
            "--mismatches", "0", "--output", str(folder / "out"), *more]  # fmt: skip


def told(folder: Path, capsys: pytest.CaptureFixture[str], firmware: str, *more: str) -> Any:
    assert run(asked(folder, firmware, "--json", *more)) is Exit.FAILED
    return json.loads(capsys.readouterr().out)["results"][0]


LIMIT = ("limit", "temperature > 22")
TIME = ("timer", "after(5 s)")


@pytest.mark.parametrize(
    ("firmware", "changes"),
    [
        ("Hot", {(*LIMIT, "temperature > 25"): "any limit between 25 and 26 explains the same"}),
        (
            "Hotter",
            {
                (*LIMIT, "temperature > 28"): "any limit between 28 and 29 explains the same",
                (*TIME, "after(5200 ms)"): "",
            },
        ),
    ],
)
def test_a_cause_is_told_as_what_the_firmware_has(
    firmware: str, changes: dict[tuple[str, ...], str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A limit was the number of the fewest digits between two that the charts as drawn made runs meet."""
    file = folder / f"{firmware}.toml"
    result = told(folder, capsys, firmware, "--write-variant", str(file))
    found = {tuple(one["change"][key] for key in ("kind", "old", "new")): one for one in result["causes"]}
    assert found.keys() == changes.keys()
    for key, note in changes.items():
        assert found[key]["change"].get("note", "") == note
    assert not result["causes_unfit"]
    assert "Nothing else shows in" in file.read_text(encoding="utf-8")
    assert {one["kind"] for one in result["tried"]} == {
        "fixed runs", "random runs", "runs for the causes found",
    }  # fmt: skip
    assert run(asked(folder, firmware, "--variant", str(file))) is Exit.AS_EXPECTED


def test_what_no_cause_explains_in_these_runs_is_said(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The evidence of the variant said nothing of it, or that nothing else shows in these runs."""
    file = folder / "pierced.toml"
    assert run(asked(folder, "Pierced", "--write-variant", str(file))) is Exit.FAILED
    evidence = file.read_text(encoding="utf-8")
    assert "More shows in runs that were tried for them, in Heater." in evidence
    assert "Nothing else" not in evidence
    said = " ".join(capsys.readouterr().out.split())
    assert "Heater: runs that were tried for the causes found show more than these explain" in said
    assert "Causes were looked for without" not in said, "no run was left out"
    assert "cause: Heater behaves as with a limit of 30 °C" in said, "it explains the runs before"


def test_an_interrupted_second_search_keeps_the_causes_of_the_first(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """After Ctrl-C each deviation was told without the change that had been found."""
    searches = []

    def searched(*given: Any, before: CauseSearch | None = None) -> CauseGroups:
        searches.append(before)
        if before is not None:
            raise KeyboardInterrupt
        return cause_groups(*given)

    monkeypatch.setattr(rounds, "cause_groups", searched)
    file = folder / "interrupted.toml"
    result = told(folder, capsys, "Pierced", "--write-variant", str(file))
    assert len(searches) == 2
    assert [one["change"]["old"] for one in result["causes"]] == ["temperature > 22"]
    assert "Nothing else" not in file.read_text(encoding="utf-8")


def test_a_run_that_is_not_decided_beside_the_causes_speaks_against_them(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It differs from the charts with the causes, and was taken for one that they explain."""
    made: list[RunFollower] = []

    class Undecided(RunFollower):
        """All but the first one, which follows the charts as drawn, decides nothing."""

        def behaviour(self, run: RecordedRun) -> Behaviour:
            made.append(self)
            found = super().behaviour(run)
            if self is made[0]:
                return found
            row = UndecidedRow(1, "Heater", "it may be in too many states")
            return replace(found, deviations=(), undecided=(row,), tally=DeviationTally())

    monkeypatch.setattr(search, "RunFollower", Undecided)
    result = told(folder, capsys, "Pierced", "--causes")
    assert result["causes_unfit"] == ["Heater"] and len(set(map(id, made))) > 1


def test_what_is_known_is_met_without_them(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What deviates in these runs alone is no known deviation, which would be gone the next time."""
    known = folder / "known.toml"
    assert run(asked(folder, "Hotter", "--write-known", str(known))) is Exit.FAILED
    capsys.readouterr()
    assert run(asked(folder, "Hotter", "--known", str(known), "--json")) is Exit.AS_EXPECTED
    result = json.loads(capsys.readouterr().out)["results"][0]
    assert {one["verdict"] for one in result["known"]} == {"seen"}


def test_without_causes_none_are_tried(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = told(folder, capsys, "Hot")
    assert [one["kind"] for one in result["tried"]] == ["fixed runs", "random runs"]


@pytest.mark.parametrize(
    ("with_others", "has_change", "further"),
    [(True, True, False), (False, True, True), (False, False, False)],
)
def test_what_only_these_runs_show_is_told_if_it_has_a_cause_of_its_own(
    with_others: bool, has_change: bool, further: bool, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What shares its cause with others is told as these, and what has none is said of the part."""
    board = of_model(load(folder / "heater.py"))
    firmware = python.start(f"{folder / 'firmware.py'}:Brief", board, isolated=False)
    [drawn, *_] = cross_check(board, firmware, effort("ci", 5)).deviations
    alone = replace(drawn, scope=replace(drawn.scope, charts=("Heater: elsewhere",)))
    change = next(timer_changes(board.system, [249], frozenset({"Heater"})))
    every = (drawn, alone) if with_others else (alone,)
    cause = DeviationCause("Heater", change if has_change else None, every)
    made = CauseGroups((cause,), parts=(PartChanges("Heater", (change,), (drawn, alone)),))
    monkeypatch.setattr(rounds, "cause_groups", lambda *_, **__: made)
    searched = rounds.Rounds(chosen=[alone])
    groups = searched.searched(Evidence(board, (), {}), [drawn], ["Heater"], 1, lambda _: None)
    assert searched.further == ([alone] if further else [])
    assert [one.deviations for one in groups.causes] == ([every[:1]] if has_change else [])
    assert groups.parts[0].deviations == ((drawn, alone) if further else (drawn,))


# --- what they are made of --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("low", "high", "step", "number"),
    [
        (200, 300, "10", 11),
        (24, 26, "1/10", 21),
        (-1, 1, "1/10", 21),
        ("54.9", 55, "1/100", 11),
        (5, 5, "1", 0),
    ],
)
def test_numbers_between_two_have_few_digits(low: int | str, high: int, step: str, number: int) -> None:
    assert between(Fraction(low), Fraction(high)) == [
        Fraction(low) + n * Fraction(step) for n in range(number)
    ]


def test_what_was_tried_is_left_out() -> None:
    env = ENVIRONMENTS["board2"]
    assert not list(fixed(env, env))
    key = "limit", "ObstaclesDegraded", "everywhere", "d1, d2, d3 <= 300", "d1, d2, d3 <= 255"
    made = environment(with_change(env.board, WrittenChange(*key)))
    some = list(fixed(made, env))
    assert some and sum(b.steps for _, one in some for b in one.blocks) < sum(
        b.steps for _, one in fixed(made) for b in one.blocks
    )
    new = {value for name in ("d1", "d2", "d3") for value in made.values.aimed[name]}
    assert 255 in new and 255 not in env.values.aimed["d1"]


def test_two_ends_that_read_the_same_are_no_note() -> None:
    """It said "any limit between 54.5 and 54.5 explains the same", of 54.5 and the number next to it."""
    slot = next(one for one in number_slots(boards()["board2"].system, frozenset({"ObstaclesDegraded"})))
    near = Fraction(290) - Fraction(1, 10**6)
    assert slot.change(slot.op, Fraction(290), (near, Fraction(290))).note == ""
    assert "between 289.9 and 290" in slot.change(slot.op, Fraction(290), (near - Fraction(".1"), near)).note


def test_boundaries_of_other_charts_are_aimed_at_too() -> None:
    board = boards()["board2"]
    slot = next(
        one for one in number_slots(board.system, frozenset({"ObstaclesDegraded"})) if one.drawn == 300
    )
    assert slot.op is not None
    found = slot.change(slot.op, Fraction(200), (Fraction(200), Fraction(300)))
    others = tuple(other_limits(board, [found]))
    aimed = Environment(board, {}, also=others).values.aimed
    assert {210, 290} <= {value for name in ("d1", "d2", "d3") for value in aimed[name]}
