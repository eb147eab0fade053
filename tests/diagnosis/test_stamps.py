"""Stamps that a task takes otherwise: told as such, one at a time and several at once; as a variant, too."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.recording import LogBlock, Raw, Recording
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.diagnosis.causes import CauseGroups, cause_groups, followed
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.hypotheses import stamp_changes
from rovercheck.checker.diagnosis.result import diagnose_board
from rovercheck.checker.diagnosis.rivals import read_earlier
from rovercheck.checker.diagnosis.variant import (
    VariantError,
    WrittenChange,
    applied,
    read_variant,
    with_change,
    written,
)
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.abstraction.board import with_readings
from rovercheck.spec_model.abstraction.readings import READINGS, StampReading, StampsTaken, readings_of
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.errors import ModelError
from tests.diagnosis.planted import CALM, Row, deviating, part_of, recorded_on

HEARTBEAT, FRAME = "last_valid_b2_ms", "b2_data_last_valid_ms"
BOARD1 = boards()["board1"]
MONITORS = frozenset({"Monitor_heartbeat"})
TOGETHER = "into one record with "
WRAPPING = "into one record, added up in 32 bits, with "


def links(seed: int, steps: int, since_ms: int = 0, calm: range = range(0)) -> list[Row]:
    """Heartbeats and frames of Board 2 that come in time, late, or not at all for a while.

    In the ``calm`` steps all are in time.
    """
    random, stamps = Random(seed), [s.name for s in BOARD1.inputs if s.stamp]
    at: Row = {**BOARD1.at_power_up(), **CALM["board1"]}
    due = {HEARTBEAT: 0, FRAME: 0}
    found: list[Row] = []
    for step in range(1, steps + 1):
        at[NOW] = now = since_ms + 20 * step
        at |= {name: now for name in stamps if name not in due}
        for name, left in due.items():
            due[name] = left - 1
            if left <= 1:
                at[name] = now - random.randrange(20) if step > 1 else now
                slow = (step // 100) % 2
                due[name] = random.choice((1, 1, 2, 3) if slow else (1, 1, 1, 2))
                if random.random() < 0.03:
                    due[name] = random.choice((4, 5, 6, 7, 8, 60))
                due[name] = 1 if step in calm else due[name]
        found.append(dict(at))
    return found


def runs_of(*readings: StampReading) -> list[Recording]:
    board = with_readings(BOARD1, readings)
    rows = [links(1, 600), links(2, 600), links(3, 300, 65_000), links(4, 100)]
    return [recorded_on(board, one, f"run {number}") for number, one in enumerate(rows, 1)]


def grouped(runs: Sequence[Recording]) -> CauseGroups:
    evidence = followed(BOARD1, runs)
    found = [d for run in runs for d in evidence.behaviours[run.name].deviations]
    once = {d.scope: d for d in found}
    return cause_groups(evidence, list(once.values()), ["Monitor_heartbeat", "Monitor_reception"], 60)


@pytest.mark.parametrize(
    "how",
    [
        "a step late",
        "in 16 bits",
        "its age in 8 bits",
        "every other one",
        "every other one from the first",
    ],
)
def test_a_stamp_that_is_taken_otherwise_is_told_as_such(how: str) -> None:
    planted = StampReading(HEARTBEAT, how)
    causes = [c for c in grouped(runs_of(planted)).causes if c.part == "Monitor_heartbeat"]
    [found] = {c.change.reading for c in causes if c.change is not None}
    assert found == planted
    assert all(c.change is not None for c in causes)


@pytest.mark.parametrize(
    ("planted", "calm", "note"),
    [(64, range(0), ""), (128, range(100, 260), "update 64 on explains the same")],
)
def test_from_which_update_a_stamp_is_new_in_every_step_is_told_as_far_as_runs_show_it(
    planted: int, calm: range, note: str
) -> None:
    """While every step has an update nobody sees whether it is taken for one: 64 was told in place of 8."""
    reading = StampReading(HEARTBEAT, f"new in every step from update {planted} on")
    board = with_readings(BOARD1, [reading])
    runs = [recorded_on(board, links(seed, 500, 0, calm), f"run {seed}") for seed in (1, 2, 3)]
    [one] = {c.change for c in grouped(runs).causes if c.part == "Monitor_heartbeat"}
    assert one is not None and one.reading == reading
    assert one.note.endswith(note) and bool(one.note) is bool(note)


def since(update: int) -> StampReading:
    return StampReading(HEARTBEAT, f"new in every step from update {update} on")


def test_an_earlier_update_that_explains_more_takes_the_place_of_a_later_one() -> None:
    """64 was told, and a limit for the one row of a folder that only update 8 or an earlier one explains."""
    [late] = [c for c in stamp_changes(BOARD1, BOARD1.system, MONITORS) if c.reading == since(64)]
    taken = [(late, frozenset({1})), (replace(late, reading=None), frozenset({2}))]

    def added(one: ChartChange) -> bool:
        if one.reading != since(8):
            return False
        taken.append((one, frozenset({3})))
        return True

    read_earlier(taken, added)
    (_, other), (change, explained) = taken
    assert (change.reading, change.new, change.text) == (since(8), since(8).how, since(8).text)
    assert (other, explained) == (frozenset({2}), frozenset({1, 3}))
    before = list(taken)
    read_earlier(taken, lambda _: False)
    assert taken == before


@pytest.mark.parametrize("late", [16, 64])
def test_an_earlier_update_on_top_of_a_later_one_is_the_earlier_one(late: int) -> None:
    """So that a change for it takes the place of the other one."""
    both, alone = StampsTaken([since(late), since(8)]), StampsTaken([since(8)])
    for row in links(5, 400):
        stamps, now = {HEARTBEAT: int(row[HEARTBEAT])}, int(row[NOW])
        assert both.step(stamps, now) == alone.step(stamps, now)


def test_several_stamps_that_only_together_explain_anything_are_found_together() -> None:
    """Both links write into one record of intervals, and every other heartbeat is dropped."""
    planted = {StampReading(HEARTBEAT, "every other one"), StampReading(FRAME, WRAPPING + HEARTBEAT)}
    groups = grouped(runs_of(*planted))
    found = {c.change.reading: c for c in groups.causes if c.change is not None}
    assert found.keys() == planted and all(c.change or not c.part for c in groups.causes)
    shared = found[StampReading(FRAME, WRAPPING + HEARTBEAT)]
    assert set(shared.parts) == {"Monitor_heartbeat", "Monitor_reception"}
    assert not shared.beside


@pytest.mark.parametrize("how", ["a step late", TOGETHER + HEARTBEAT])
def test_with_the_stamp_in_a_variant_nothing_deviates(how: str, tmp_path: Path) -> None:
    planted = StampReading(FRAME, how)
    runs = runs_of(planted)
    assert set(deviating(BOARD1, runs)) <= {"Monitor_heartbeat", "Monitor_reception"}
    kind = "shared" if planted.other else "stamp"
    text = f'board = "board1"\n[[change]]\nkind = "{kind}"\nchart = "Monitor_reception"\n'
    text += f'at = "stamp/{FRAME}"\nfrom = "as it is given"\nto = "{how}"\n'
    file = tmp_path / "variant.toml"
    file.write_text(text, encoding="utf-8")
    assert deviating(applied(BOARD1, read_variant(file)), runs) == []
    file.write_text(text.replace(how, "upside down"), encoding="utf-8")
    with pytest.raises(VariantError, match="cannot become `upside down`"):
        applied(BOARD1, read_variant(file))


def test_diagnose_tells_the_stamp_and_writes_a_variant_that_applies(tmp_path: Path) -> None:
    runs = runs_of(StampReading(HEARTBEAT, "a step late"))
    [part] = diagnose_board(BOARD1, runs, 60, deciding=False).parts
    assert part.cause is not None
    [change] = part.cause.changes
    assert change.reading == StampReading(HEARTBEAT, "a step late")
    assert change.text == f"{HEARTBEAT} were given a step late"
    file = tmp_path / "variant.toml"
    file.write_text(written("board1", part.cause.changes), encoding="utf-8")
    assert deviating(applied(BOARD1, read_variant(file)), runs) == []


def test_a_known_change_that_reads_another_signal_is_found_in_a_part_of_the_charts() -> None:
    """The part itself has no such input: the signals are those of the board."""
    part = replace(BOARD1, system=replace(BOARD1.system, components=(part_of("board1", "Monitor_wheel_RR"),)))
    change = WrittenChange(
        "exchanged", "Monitor_wheel_RR", "everywhere", "hasNoFeedback_RR", "hasNoFeedback_RL"
    )
    assert "hasNoFeedback_RL" not in part.system.inputs
    try:
        made = with_change(part, change)
    except ModelError as error:
        pytest.fail(str(error))
    assert "hasNoFeedback_RL" in made.system.inputs


# --- reading and decoding ---------------------------------------------------------------------------


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_logs_and_implementations_have_their_stamps_taken_alike(board: str) -> None:
    """The reader of a variant, step by step, and the decoder of its logs, column by column."""
    plain = boards()[board]
    random, stamps = Random(7), [s.name for s in plain.inputs if s.stamp and s.name != NOW]
    rows: list[Row] = []
    at: Row = {**plain.at_power_up(), **CALM[board]}
    for step in range(1, 400):
        at[NOW] = now = 65_000 + 20 * step
        for name in stamps:
            if random.random() < 0.4:
                at[name] = now - random.randrange(300)
        rows.append(dict(at))
    columns: dict[str, list[Raw | None]] = {
        s.name: [s.raw(row[s.name]) for row in rows] for s in plain.inputs
    }
    steps = range(1, len(rows) + 1)
    block = LogBlock(list(steps), list(steps), [0] * len(rows), columns)
    recorded = [v.signal.name for v in plain.interface.views if v.how == "slow"]
    for reading in (r for stamp in stamps for r in readings_of(stamp, recorded)):
        variant = with_readings(plain, [reading])
        reader, decoder = variant.reader(), InputDecoder(Vocabulary(variant), frozenset(columns), True)
        decoded = decoder.decode(block)
        for number, row in enumerate(rows):
            seen = reader.step(row)
            assert {n: cells[number] for n, cells in decoded.items()} == {n: seen[n] for n in decoded}


def test_what_was_not_recorded_is_not_known_afterwards() -> None:
    """A stamp of the step before, where a row is missing; one in fewer bits, too, as that is told of all."""
    variant = with_readings(BOARD1, [StampReading(HEARTBEAT, "a step late")])
    values: dict[str, list[Raw | None]] = {NOW: [20, 40, 80], HEARTBEAT: [20, 40, 80]}
    block = LogBlock([1, 2, 3], [1, 2, 4], [0, 0, 1], values)
    decoder = InputDecoder(Vocabulary(variant), frozenset(values), True)
    assert decoder.decode(block)["heartbeat_age"] == [1, 1, None]


@pytest.mark.parametrize(("update", "ages"), [(2, [0, 0, 0, 0]), (4, [0, 0, None, None])])
def test_behind_a_cell_that_is_not_known_the_updates_before_it_have_still_come(
    update: int, ages: list[int | None]
) -> None:
    """One such stamp left a whole log open, and so all that showed in it without a cause."""
    variant = with_readings(BOARD1, [StampReading(HEARTBEAT, f"new in every step from update {update} on")])
    values: dict[str, list[Raw | None]] = {NOW: [20, 40, 60, 80], HEARTBEAT: [20, 40, None, 40]}
    block = LogBlock([1, 2, 3, 4], [1, 2, 3, 4], [0, 0, 0, 0], values)
    decoder = InputDecoder(Vocabulary(variant), frozenset(values), True)
    assert decoder.decode(block)["heartbeat_age"] == ages


def test_every_way_to_take_a_stamp_is_told_and_does_something() -> None:
    for how, (text, _) in READINGS.items():
        one = StampReading(HEARTBEAT, how)
        take, given = one.start(), [(1 << 25) + 20 * n for n in range(1, 3000)]
        assert [take(stamp, stamp + 7) for stamp in given] != given or "age" in how
        assert not one.other and HEARTBEAT in one.text and "{}" in text
    both = StampReading(FRAME, TOGETHER + HEARTBEAT)
    assert both.other == HEARTBEAT and HEARTBEAT in both.text and FRAME in both.text
