"""The firmwares with planted differences: they conform before, and every difference can be planted."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.twins.exposed import differing, outputs, running
from benchmarks.twins.firmware import FIRMWARES, Firmware, Planted, PlantingError, changed
from benchmarks.twins.measure import ALONE, shown_alone
from benchmarks.twins.recordings import DAMAGES, TwinLog, kept, written
from benchmarks.twins.told import ToldGroup, judged, matched
from rovercheck.checker.compare.beside import compared, differences, rerun
from rovercheck.checker.logs import ColumnMap, examine
from rovercheck.checker.testgen import kept as covering_tests
from rovercheck.spec_model.lang.chart import parts

EVERY = pytest.mark.parametrize("firmware", FIRMWARES.values(), ids=FIRMWARES)
RUNS = 6


def steps(firmware: Firmware) -> list[list[dict[str, bool | int | float]]]:
    """The inputs of a few covering tests."""
    return [[dict(given) for given in test.steps] for test in covering_tests(firmware.board_name)[:RUNS]]


@EVERY
def test_every_difference_can_be_planted_alone_and_all_together(firmware: Firmware) -> None:
    texts, every = firmware.sources(), (*firmware.differences, *firmware.further)
    for one in every:
        assert changed(texts, [one]) != texts
    together = changed(texts, every)
    for name, text in together.items():
        if name.endswith(".py"):
            compile(text, name, "exec")


@EVERY
def test_differences_are_of_parts_and_outputs_of_their_board(firmware: Firmware) -> None:
    every = (*firmware.differences, *firmware.further)
    names = {part.name for part in parts(firmware.board.system.components)}
    assert 10 <= len(firmware.differences) <= 20 and len(firmware.further) == 15
    assert len({one.id for one in every}) == len(every)
    for one in every:
        assert set(one.parts) <= names
        assert one.own_outputs(firmware.board)
        assert one.own_outputs(firmware.board) <= {o.name for o in firmware.board.outputs}


def test_some_are_in_the_first_step_mask_others_or_are_in_shared_memory_or_the_task() -> None:
    for firmware in FIRMWARES.values():
        tags = {tag for one in firmware.differences for tag in one.tags}
        assert tags == {"first step", "masks", "shared memory", "task"}


@EVERY
def test_every_difference_is_known_to_show_in_its_own_outputs(firmware: Firmware) -> None:
    shown = shown_alone(firmware)
    for one in (*firmware.differences, *firmware.further):
        assert one.own_outputs(firmware.board) & set(shown[one.id]), one.id


def test_what_shows_alone_is_kept_of_these_differences_only() -> None:
    kept_ids = {name: set(table) for name, table in json.loads(ALONE.read_text(encoding="utf-8")).items()}
    assert kept_ids == {f.name: {one.id for one in (*f.differences, *f.further)} for f in FIRMWARES.values()}


@EVERY
def test_the_firmware_conforms_and_its_twin_does_not(
    firmware: Firmware, request: pytest.FixtureRequest
) -> None:
    if firmware.language == "c":
        request.getfixturevalue("cc")
    with running(firmware) as base:
        for inputs in steps(firmware):
            mismatch = compared(firmware.board, rerun(firmware.board, inputs), base)
            assert mismatch is None, mismatch
    with running(firmware, (*firmware.differences, *firmware.further)) as twin:
        shown = [
            differences(firmware.board, wanted.expected, got, set(got))
            for inputs in steps(firmware)
            for wanted, got in zip(rerun(firmware.board, inputs), outputs(twin, inputs), strict=True)
        ]
    assert any(shown)


def test_a_text_that_is_not_there_once_is_refused() -> None:
    texts = {"a.c": "x = 1;\nx = 1;\n"}
    for old in ("x = 2;", "x = 1;"):
        one = Planted("id", "kind", "says", ("part",), (("a.c", old, "y"),))
        with pytest.raises(PlantingError, match="it must be there once"):
            changed(texts, [one])


def test_what_is_the_same_within_single_precision_is_no_difference() -> None:
    assert not differing({"v": 0.25}, {"v": 0.25000001})
    assert differing({"v": 0.25, "m": 1}, {"v": 0.2501, "m": 2}) == {"v", "m"}


# --- the judgement ----------------------------------------------------------------------------------


def test_each_difference_has_a_group_of_its_own_where_there_is_one() -> None:
    assert matched({"one": [0, 1], "two": [0], "three": [0]}) == {"one": 1, "two": 0}
    assert matched({"one": [0], "two": [0, 1]}) == {"one": 0, "two": 1}


def group(part: str, *names: str) -> ToldGroup:
    return ToldGroup(part, tuple((name, "0", "1") for name in names))


def test_groups_are_told_again_or_false() -> None:
    firmware = FIRMWARES["board1_c"]
    planted = [one for one in firmware.differences if one.parts == ("Monitor_temperature",)][:1]
    alone = {planted[0].id: ["temp_status", "critical_mask"]}
    temperature = group("Monitor_temperature", "temp_status")
    others = [group("Fault_masks", "critical_mask"), group("Motion_Supervision", "v_ref")]
    found = judged(firmware.board, planted, alone, [temperature, temperature, *others])
    assert found.found == {planted[0].id: 0}
    assert (found.missing, found.again, found.false) == ((), (1,), (2, 3))


def test_a_group_of_two_differences_is_of_neither_and_not_false() -> None:
    firmware = FIRMWARES["board1_py"]
    planted = [one for one in firmware.differences if one.id in ("stop-at-power-up", "turns-with-0.4")]
    alone = {"stop-at-power-up": ["actuate_emergency_stop"], "turns-with-0.4": ["omega_ref"]}
    both = group("Motion_Supervision", "actuate_emergency_stop", "omega_ref")
    found = judged(firmware.board, planted, alone, [both])
    assert (found.found, found.mixed, found.false) == ({}, (0,), ())


def test_a_group_in_which_the_difference_does_not_show_alone_is_not_its() -> None:
    firmware = FIRMWARES["board1_c"]
    planted = [one for one in firmware.differences if one.parts == ("Fault_masks",)]
    alone = {planted[0].id: ["degraded_mask"]}
    found = judged(firmware.board, planted, alone, [group("Fault_masks", "critical_mask")])
    assert found.missing == (planted[0].id,) and found.false == (0,)


def test_what_a_part_decides_further_on_is_of_that_part() -> None:
    firmware = FIRMWARES["board2_c"]
    planted = [one for one in firmware.differences if one.parts == ("Motion_Supervision_2",)][:1]
    alone = {planted[0].id: ["omega_ref_actuation", "left_rpm"]}
    passed_on = group("Actuation (Motion_Supervision_2, which Actuation passes on)", "left_rpm")
    assert judged(firmware.board, planted, alone, [passed_on]).found == {planted[0].id: 0}
    assert judged(firmware.board, planted, alone, [group("Actuation", "left_rpm")]).false == (0,)


# --- logs -------------------------------------------------------------------------------------------


def log(firmware: Firmware, damage: str, seed: int = 7) -> TwinLog:
    longest = max(covering_tests(firmware.board_name), key=lambda test: len(test.steps))
    inputs = tuple(dict(given) for given in longest.steps)
    return TwinLog("log.csv", inputs, damage, seed)


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_log_is_damaged_as_told_and_the_same_each_time(damage: str, tmp_path: Path) -> None:
    firmware = FIRMWARES["board1_py"]
    made = log(firmware, damage)
    texts = []
    with running(firmware, firmware.differences) as twin:
        for _ in range(2):
            texts.append(written(twin, made, firmware.board, tmp_path).read_text(encoding="utf-8"))
        whole = written(twin, replace(made, damage="whole"), firmware.board, tmp_path)
    assert texts[0] == texts[1]
    assert (texts[0] == whole.read_text(encoding="utf-8")) == (damage == "whole")
    assert bool(kept(made, firmware.board).without) == (damage in ("columns lost", "all of it"))


@pytest.mark.parametrize("damage", DAMAGES[:-1])
def test_cells_without_meaning_are_where_they_were_put(damage: str, tmp_path: Path) -> None:
    firmware = FIRMWARES["board2_py"]
    made = log(firmware, damage)
    with running(firmware, firmware.differences) as twin:
        written(twin, made, firmware.board, tmp_path)
    found = examine(tmp_path / made.name, ColumnMap(), firmware.board_name)
    assert bool(found.invalid) == (damage in ("cells out of range", "all of it"))
