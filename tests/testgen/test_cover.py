"""Goals, searches and the choice of tests, on a toy board and on the boards as drawn."""

import json
from dataclasses import replace
from random import Random

import pytest

from rovercheck.checker.system.instrument.goals import CoverGoal, GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.coverage import NOT_TRIED, GenerationEffort, GoalCoverage, chosen, cover
from rovercheck.checker.testgen.explore import (
    RandomInputs,
    RandomMachine,
    TriedRun,
    explored,
    first_reached,
    shortened,
)
from rovercheck.checker.testgen.fingerprint import fingerprint
from rovercheck.checker.testgen.keep import KeptTests, kept_of, written
from rovercheck.checker.testgen.replay import first_reached as replayed
from rovercheck.checker.testgen.replay import played
from rovercheck.checker.testgen.scripts import Script, blocks, script, steps, unfolded
from rovercheck.checker.testgen.search import CoverFound, Uncoverable
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.rover import systems
from tests.testgen.cover_toys import AFTER_NEVER, NEVER, SYSTEM, TOY, lamp, lit, press

LOOKED = watched(TOY.system)
BOTH = ["board1", "board2"]


def random_script(name: str, ticks: int, seed: int = 0) -> Script:
    return tuple(RandomInputs(boards()[name]).run(Random(seed), ticks, lambda: {}))


def texts(*kinds: GoalKind) -> list[str]:
    return [g.text for g in LOOKED.of(*kinds)]


def toy(presses: str, light: int = 9) -> Script:
    return tuple({"press": c == "1", "light_lx": light} for c in presses)


def reached(moments: Script) -> dict[str, int]:
    found = replayed(TOY, LOOKED, steps(TOY, moments))
    by_text = {g.id: g.text for g in LOOKED.goals}
    return {by_text[id]: step for id, step in found.items()}


# --- goals ---------------------------------------------------------------------------------------------


def test_every_transition_of_the_chart_is_a_goal() -> None:
    assert len(LOOKED.of(GoalKind.TRANSITIONS)) == 4
    assert [t for t in texts(GoalKind.TRANSITIONS) if t.startswith("Off -> Broken")]


def test_every_transition_into_a_state_is_paired_with_every_transition_out_of_it() -> None:
    ids = {g.id for g in LOOKED.of(GoalKind.PAIRS)}
    assert ids == {"Lamp.pair.1-2", "Lamp.pair.4-2", AFTER_NEVER, "Lamp.pair.4-3", "Lamp.pair.2-4"}


def test_a_comparison_has_both_nearest_values_beside_its_limit_as_goals() -> None:
    for light, side in ((9, "just below"), (10, "at it"), (11, "just above")):
        sides = [t for t in reached(toy("01", light)) if t.startswith("light_lx < 10")]
        assert [t for t in sides if side in t] == sides != []
    assert not [t for t in reached(toy("01", 100)) if t.startswith("light_lx < 10")]


def test_a_timer_is_asked_a_step_early_in_time_and_a_step_late() -> None:
    found = reached(toy("01111110"))
    lit_at = found["Off -> On (transition 1) [rising(press) && light_lx < 10]"]
    early, due, late = (
        found[next(t for t in found if t.startswith(f"after(3 ticks) {side}"))]
        for side in ("one step early", "just run out", "one step late")
    )
    assert (early, due, late) == (lit_at + 2, lit_at + 3, lit_at + 4)


@pytest.mark.parametrize("name", BOTH)
def test_goals_have_ids_of_their_own_and_transitions_are_the_same_in_the_model_of_the_board(
    name: str,
) -> None:
    goals = watched(boards()[name].system).goals
    assert len({g.id for g in goals}) == len(goals) > 500
    assert len({g.flag.name for g in goals}) == len(goals)
    transitions = {(g.id, g.text) for g in goals if g.kind is GoalKind.TRANSITIONS}
    assert transitions <= {(g.id, g.text) for g in watched(systems()[name], [GoalKind.TRANSITIONS]).goals}


@pytest.mark.parametrize("name", BOTH)
def test_looking_changes_nothing(name: str) -> None:
    board = boards()[name]
    plain, looking = (
        Interpreter(board.system, measured=True),
        Interpreter(watched(board.system).system, measured=True),
    )
    one, two = board.reader(), board.reader()
    for inputs in steps(board, random_script(name, 150)):
        fired = plain.step(one.step(inputs))
        again = looking.step(two.step(inputs))
        assert [(f.chart, f.source, f.target, f.event) for f in fired] == [
            (f.chart, f.source, f.target, f.event) for f in again
        ]
        assert plain.valuation().items() <= looking.valuation().items()


@pytest.mark.parametrize("name", BOTH)
def test_compiled_charts_reach_what_the_interpreter_reaches(name: str) -> None:
    board, looked = boards()[name], watched(boards()[name].system)
    machine, moments = RandomMachine(board, looked), random_script(name, 120, seed=1)
    place = TriedRun.power_up(machine)
    for moment, step in zip(moments, played(board, looked, steps(board, moments)), strict=True):
        assert set(place.step(moment)) == step.reached
        assert board.expected(place.at) == step.outputs


# --- scripts -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", BOTH)
def test_scripts_and_rows_stand_for_the_same_inputs(name: str) -> None:
    board, moments = boards()[name], random_script(name, 80)
    assert unfolded(board, blocks(board, moments)) == moments
    assert script(board, steps(board, moments)) == moments
    assert len(blocks(board, moments)) < len(moments)


def test_a_clock_that_jumps_is_no_test() -> None:
    inputs = [dict(s) for s in steps(TOY, toy("00"))]
    inputs[1]["now_ms"] = 60
    with pytest.raises(ModelError, match="Step 2 is at 60 ms"):
        script(TOY, inputs)


def test_a_script_is_shortened_to_the_steps_it_needs() -> None:
    machine = RandomMachine(TOY, LOOKED)
    long = toy("0" * 40 + "1" + "0" * 40)
    short = shortened(machine, long, ["Lamp.arrow.4"])
    assert len(short) == 5  # power-up, the press, and three steps lit
    assert first_reached(machine, short)["Lamp.arrow.4"] == 5


def test_random_runs_are_reproducible() -> None:
    machine = RandomMachine(TOY, LOOKED)
    one, two = (list(explored(machine, [g.id for g in LOOKED.goals], Random(5), 500)) for _ in range(2))
    assert one == two != []


# --- coverage ------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def covered() -> GoalCoverage:
    coverage = GoalCoverage(TOY, LOOKED.goals)
    cover(coverage, SYSTEM, GenerationEffort(seconds=60, ticks=400, jobs=1), lambda line: None)
    return coverage


def test_every_goal_of_the_toy_is_covered_or_proved_uncoverable(covered: GoalCoverage) -> None:
    assert not covered.unknown
    assert covered.covered.keys() | covered.uncoverable.keys() == covered.wanted
    assert not covered.covered.keys() & covered.uncoverable.keys()


def test_a_transition_that_is_never_taken_is_proved_uncoverable(covered: GoalCoverage) -> None:
    answer = covered.answers[NEVER]
    assert isinstance(answer, Uncoverable) and answer.because


def test_a_pair_that_cannot_follow_is_proved_uncoverable(covered: GoalCoverage) -> None:
    assert AFTER_NEVER in covered.uncoverable and "Lamp.pair.4-3" in covered.uncoverable


def test_runs_to_transitions_are_as_short_as_any(covered: GoalCoverage) -> None:
    lengths = {g: covered.covered[g] for g in ("Lamp.arrow.1", "Lamp.arrow.2", "Lamp.arrow.4")}
    assert lengths == {"Lamp.arrow.1": 1, "Lamp.arrow.2": 2, "Lamp.arrow.4": 5}
    assert lengths.keys() <= covered.shortest


def test_few_tests_reach_all_that_is_covered(covered: GoalCoverage) -> None:
    kept = covered.kept()
    claimed = [goal for _, goals, _ in kept.tests for goal in goals]
    assert sorted(claimed) == sorted(covered.covered)
    assert len(kept.tests) < len(covered.scripts)
    assert kept_of(TOY, written(TOY, kept)) == kept


def test_a_false_claim_is_not_kept() -> None:
    from rovercheck.checker.verify.runs.replay import ReplayError

    coverage = GoalCoverage(TOY, LOOKED.goals)
    coverage.scripts.append((toy("00"), {NEVER: 2}))
    with pytest.raises(ReplayError, match=NEVER):
        coverage.kept()


def test_without_a_search_all_is_unknown() -> None:
    goals: tuple[CoverGoal, ...] = LOOKED.goals
    assert GoalCoverage(TOY, goals).unknown.keys() == {g.id for g in goals}


def test_a_test_takes_the_shortest_run_where_one_is_known(covered: GoalCoverage) -> None:
    tests = covered.kept().tests
    for goal in covered.shortest:
        (script,) = [script for _, goals, script in tests if goal in goals]
        assert first_reached(covered.machine, script)[goal] == covered.covered[goal]


def test_a_goal_reached_sooner_by_another_run_is_left_to_that_one() -> None:
    coverage = GoalCoverage(TOY, LOOKED.goals)
    both, soon = toy("0001111"), toy("01")
    on = "Lamp.arrow.2"
    coverage.scripts += [(both, {on: 4, "Lamp.arrow.4": 7}), (soon, {on: 2})]
    coverage.answers[on] = CoverFound(on, soon, "bmc", shortest=True)
    assert {goals for _, goals, _ in chosen(coverage)} == {("Lamp.arrow.4",), (on,)}


# --- going on from what is kept -------------------------------------------------------------------------


def test_going_on_asks_for_nothing_that_is_settled(
    covered: GoalCoverage, monkeypatch: pytest.MonkeyPatch
) -> None:
    again = GoalCoverage(TOY, LOOKED.goals)
    again.go_on(covered.kept("as drawn"), "as drawn")
    assert again.settled == again.wanted
    asked: list[CoverGoal] = []

    def search(board: Board, model: System, goals: list[CoverGoal], *limits: object) -> tuple[()]:
        asked.extend(goals)
        return ()

    monkeypatch.setattr("rovercheck.checker.testgen.coverage.searched", search)
    cover(again, SYSTEM, GenerationEffort(ticks=0), lambda line: None)
    assert asked == [] and again.kept("as drawn") == covered.kept("as drawn")


def test_proofs_and_shortest_runs_of_other_charts_are_not_taken_over(covered: GoalCoverage) -> None:
    again = GoalCoverage(TOY, LOOKED.goals)
    again.go_on(covered.kept("as drawn"), "drawn anew")
    assert again.covered.keys() == covered.covered.keys()
    assert not again.uncoverable and not again.shortest and NEVER in again.unknown


def test_why_a_goal_is_unknown_is_remembered_until_something_else_is_known() -> None:
    again = GoalCoverage(TOY, LOOKED.goals)
    again.go_on(KeptTests((), unknown={NEVER: "too long"}), "")
    assert again.unknown[NEVER] == "too long" and again.unknown[AFTER_NEVER] == NOT_TRIED
    again.answers[NEVER] = Uncoverable.of(NEVER, "Lamp alone: explicit, all 5 reachable states, twice")
    assert NEVER not in again.unknown
    assert again.uncoverable[NEVER].because == "all 5 reachable states, twice"
    assert again.kept().uncoverable[NEVER] == "Lamp alone: explicit, all 5 reachable states, twice"


def test_a_fingerprint_is_of_the_charts_and_of_nothing_else() -> None:
    told, more = (
        replace(SYSTEM, text="In other words"),
        in_order("toy", lamp, Block("More", [assign(lit, False)])),
    )
    assert fingerprint(TOY, SYSTEM) == fingerprint(TOY, told)
    assert fingerprint(TOY, SYSTEM) != fingerprint(TOY, more)
    assert fingerprint(TOY, SYSTEM) != fingerprint(replace(TOY, system=more), SYSTEM)
    assert fingerprint(TOY, SYSTEM) != fingerprint(TOY, replace(SYSTEM, assume=~press))


def test_answers_say_where_runs_come_from(covered: GoalCoverage) -> None:
    runs = [a for a in covered.answers.values() if isinstance(a, CoverFound)]
    assert runs and all(a.engine for a in runs)


def test_a_file_of_the_format_before_is_read() -> None:
    """In it a stamp is true where its datum is new."""
    board = boards()["board1"]
    made = written(board, KeptTests((("one", ("goal",), random_script("board1", 5)),)))
    rows = '[[2, {"temp_last_valid_ms": true, "cmd": 1}], [1, {"temp_last_valid_ms": false}]]'
    held = json.loads(made) | {"format": 1}
    held["tests"][0]["held"] = json.loads(rows)
    [(_, _, found)] = kept_of(board, json.dumps(held)).tests
    assert [inputs["temp_last_valid_ms"] for inputs in steps(board, found)] == [20, 40, 40]
    assert [moment["cmd"] for moment in found] == [1, 1, 1]


def test_a_file_of_another_board_is_refused() -> None:
    with pytest.raises(ModelError, match="no tests of board1"):
        kept_of(boards()["board1"], written(TOY, GoalCoverage(TOY, ()).kept()))
