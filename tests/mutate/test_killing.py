"""For each property a fault that it notices: found by recorded runs and random ones, and kept."""

import json
import os
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check.further import noticing
from rovercheck.checker.commands.mutate import kills as killing
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.model.kept_runs import KILLS, file_of, read
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.checker.mutate.kills import kills, noticed, searched, still
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.relevance import as_it_is, changed
from rovercheck.checker.mutate.tries import BACK, COUNT, ON, TICKS, RandomRuns, spread, tried
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.runs.known_runs import reached
from rovercheck.properties.coverage import matrix
from rovercheck.properties.forms import Always, always
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import implies
from rovercheck.spec_model.lang.words import bit
from rovercheck.spec_model.rover import systems
from tests.cli.test_report import EMPTY
from tests.mutate.lamp import LIT, NEVER, QUIET, alarm, lamps, level, lit


def test_every_kill_on_record_is_one() -> None:
    """The run violates the property with the fault, and not without it."""
    model = rover()
    by: dict[str, list[str]] = defaultdict(list)
    kept = read(file_of(model, KILLS), KILLS)
    for id, one in kept.items():
        by[one.system].append(id)
    for name, ids in by.items():
        system = as_it_is(model.systems[name])
        wanted = {kept[id].mutant for id in ids}
        known: dict[str, Mutant] = {
            m.id: m for m in mutants(system, {id.partition("/")[0] for id in wanted}) if m.id in wanted
        }
        for id in ids:
            prop = replace(model.properties[id], on=name)
            assert noticed(known[kept[id].mutant], [prop], [kept[id].run]), f"{id}: record its kill anew"
            assert not reached(system, [prop], [kept[id].run])


def test_what_is_excused_notices_nothing() -> None:
    model = rover()
    kept = read(file_of(model, KILLS), KILLS)
    excused = [id for id in model.properties if model.expected(id).no_fault]
    assert excused and [id for id in excused if id in kept] == []


def test_a_requirement_is_covered_by_a_property_that_notices_something() -> None:
    model = rover()
    known = noticing(model)
    assert known is not None
    rows = matrix(model.properties.values(), model.requirements, known)
    assert [row.requirement.id for row in rows if row.open] == []
    unmeasured = matrix(model.properties.values(), model.requirements)
    none = matrix(model.properties.values(), model.requirements, frozenset())
    assert {row.requirement.id for row in none if row.open} == {
        row.requirement.id for row in unmeasured if row.covered
    }


def test_the_lamp_has_a_kill_for_each_property_that_some_fault_can_break() -> None:
    found = {id: kill for one in kills(lamps, (LIT, QUIET, NEVER), (), 60.0) for id, kill in one.items()}
    assert {"LIT", "QUIET"} <= set(found)
    for id, kill in found.items():
        prop = next(p for p in (LIT, QUIET, NEVER) if p.id == id)
        [mutant] = [m for m in mutants(lamps) if m.id == kill.mutant]
        assert list(noticed(mutant, [prop], [kill.run])) == [id]


LOUD = always(
    "LOUD", "A lit lamp at an odd level has an alarm.", that=implies(lit & bit(level, 0), alarm),
    covers=["R"], on=lamps,
)  # fmt: skip


def test_a_search_takes_away_whole_parts_first() -> None:
    """A property that notices it needs the part."""
    found = {id: kill for one in searched(lamps, (LIT, LOUD), 60.0) for id, kill in one.items()}
    assert found["LOUD"].mutant == "Alarm/block/dead"
    made = {m.id: m for m in mutants(lamps)}
    for prop in (LIT, LOUD):
        kill = found[prop.id]
        assert list(noticed(made[kill.mutant], [prop], [kill.run])) == [prop.id]
        assert not reached(lamps, [prop], [kill.run])


def test_only_faults_that_change_the_slice_of_a_property_are_searched() -> None:
    whole = lowered(lamps)
    by_id = {m.id: m for m in mutants(lamps)}
    dead = lowered(by_id["Alarm/block/dead"].system)
    assert list(changed(whole, dead, (LIT, QUIET, LOUD))) == [QUIET, LOUD]


def test_a_kill_that_is_none_any_more_is_dropped() -> None:
    """A property that was weakened to nothing kept its kill."""
    found = {id: kill for one in searched(lamps, (LIT, QUIET), 60.0) for id, kill in one.items()}
    assert still(lamps, (LIT, QUIET), found) == found
    idle = replace(LIT, form=Always(lit | ~lit))
    assert still(lamps, (idle, QUIET), found) == {"QUIET": found["QUIET"]}
    gone = {"LIT": replace(found["LIT"], mutant="Lamp/chart/gone")}
    assert still(lamps, (LIT,), gone) == {}


class Dying:
    """A child that ends itself where kills are looked for."""

    def __call__(self, *_: object) -> None:
        os._exit(3)


def test_a_child_that_dies_is_no_success(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was told, and the exit code was 0; what is recorded of its system stays."""
    file = tmp_path / "hall.py"
    file.write_text(EMPTY, encoding="utf-8")
    assert run(["mutate", "--model", str(file), "--record-kills"]) == Exit.AS_EXPECTED
    before = (tmp_path / "kills.json").read_bytes()
    monkeypatch.setattr(killing, "_Killing", Dying)
    assert run(["mutate", "--model", str(file), "--record-kills"]) == Exit.INCONCLUSIVE
    assert "hall: not looked at whole: " in capsys.readouterr().err
    assert (tmp_path / "kills.json").read_bytes() == before


def test_runs_on_record_go_on_for_a_while_the_shortest_first() -> None:
    short, long = Run({}, ({"a": 1},)), Run({}, ({"a": 0}, {"a": 2}))
    assert list(tried([long, short, Run({}, ())])) == [
        Run({}, ({"a": 1},) * (1 + ON)),
        Run({}, ({"a": 0}, *({"a": 2},) * (1 + ON))),
    ]


def test_every_mutant_is_tried_once() -> None:
    found = mutants(lamps)
    assert sorted(m.id for m in spread(found)) == sorted(m.id for m in found)


@pytest.mark.parametrize("name", ["relay", "references", "handover_fine", "links"])
def test_random_runs_are_runs_of_the_system(name: str) -> None:
    """Every step is admissible, and they are the same ones each time."""
    system, drawn = lowered(systems()[name]), RandomRuns(systems()[name])
    runs = drawn.from_the_start()
    assert runs == RandomRuns(systems()[name]).from_the_start()
    assert len(runs) == COUNT
    assert any(len(run) == TICKS for run in runs)
    around = list(drawn.around(runs[0]))
    assert all(one.inputs[: TICKS - max(BACK)] == runs[0].inputs[: TICKS - max(BACK)] for one in around)
    assert len(set(map(repr, around))) > 1
    for one in (*runs, *around):
        at = {**system.init, **one.frozen}
        for inputs in one.inputs:
            assert admissible(system, at, inputs)
            at = {n: v for n, v in step(system, at, inputs).items() if n not in inputs}


def test_kills_are_kept_beside_a_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "hall.py"
    file.write_text(EMPTY, encoding="utf-8")
    assert noticing(load(file)) is None
    assert run(["mutate", "--model", str(file), "--record-kills"]) == Exit.AS_EXPECTED
    assert "2 of 2 proved demands kill a mutant" in capsys.readouterr().out
    assert set(json.loads((tmp_path / "kills.json").read_text(encoding="utf-8"))["runs"]) == {"EMPTY", "FULL"}
    assert noticing(load(file)) == frozenset({"EMPTY", "FULL"})
    assert run(["requirements", "--model", str(file)]) == Exit.AS_EXPECTED
    assert "must kill a mutant of the charts" in " ".join(capsys.readouterr().out.split())
