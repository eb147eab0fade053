"""The benchmarks' own judgement: targets, agreement, the order of runs, what a late child becomes."""

import sys
from collections.abc import Callable
from dataclasses import replace

import pytest

from benchmarks.compare import Measured, answer, search_table
from benchmarks.markdown import number, table
from benchmarks.measure import Cost, Sample, Tool, interleaved, run, seconds
from benchmarks.targets import KNOWN, agrees, targets

SEARCHED = Sample(1.0, 1.0, "searched", states=2_000_000, start=0.1, memory=40_000_000)
PROVED = Sample(0.2, 0.2, "proved", evidence="certified")
OPEN = Sample(9.0, 9.0, "open", note="the time limit of 9 s")


def reached(length: int, note: str = "shortest") -> Sample:
    return Sample(0.3, 0.3, "reached", length=length, note=note, evidence="replayed")


def measured() -> Measured:
    """A comparison in which every target is met."""
    runs = {
        "ours": [SEARCHED],
        "C factored": [replace(SEARCHED, seconds=0.6)],
        "SPIN": [replace(SEARCHED, seconds=5)],
    }
    verdicts = {goal: PROVED if length is None else reached(length) for goal, length in KNOWN.items()}
    return Measured(
        searches={name: dict(runs) for name in ("M2", "O")},
        properties={g: {name: [s] for name in ("pdr", "auto", "ABC pdr")} for g, s in verdicts.items()},
        together=[Sample(2.5, 2.6, "decided")],
        start_up=[Cost("", 0.5, 0.6, 0, 0, False)],
        large=Sample(60, 60, "searched", states=61_213_152, memory=1_500_000_000),
    )  # fmt: skip


def slow(found: Measured) -> None:
    found.searches["O"] = {**found.searches["O"], "ours": [replace(SEARCHED, seconds=1.3)]}


def heavy(found: Measured) -> None:
    found.searches["M2"] = {**found.searches["M2"], "ours": [replace(SEARCHED, memory=50_000_000)]}


def undecided(found: Measured) -> None:
    found.properties["P2"] = {**found.properties["P2"], "auto": [OPEN]}


def too_long(found: Measured) -> None:
    found.properties["P5"] = {**found.properties["P5"], "pdr": [reached(407)], "auto": [reached(407)]}


def wrong(found: Measured) -> None:
    found.properties["P3h"] = {**found.properties["P3h"], "pdr": [reached(7)]}


def another_count(found: Measured) -> None:
    found.searches["M2"] = {**found.searches["M2"], "SPIN": [replace(SEARCHED, seconds=5, states=1_999_999)]}


def late(found: Measured) -> None:
    found.together = [Sample(7.5, 7.5, "decided")]


def large(found: Measured) -> None:
    found.large = Sample(60, 60, "searched", states=61_213_152, memory=6_100_000_000)


def start(found: Measured) -> None:
    found.start_up = [Cost("", 0.5, 1.2, 0, 0, False)]


def test_all_targets_can_be_met() -> None:
    assert [t.text for t in targets(measured()) if t.met is not True] == []


@pytest.mark.parametrize(
    ("change", "missed"),
    [
        (slow, ["search at least 0.5", "search at least 4"]),
        (heavy, ["at most 24 bytes"]),
        (undecided, ["each certified or replayed"]),
        (too_long, ["P4 and P5 with their shortest length", "every engine and tool agrees"]),
        (wrong, ["every engine and tool agrees"]),
        (another_count, ["every engine and tool agrees"]),
        (late, ["all six properties decided"]),
        (large, ["60 million states"]),
        (start, ["a cached run of the command line"]),
    ],
)
def test_each_target_can_be_missed(change: Callable[[Measured], None], missed: list[str]) -> None:
    found = measured()
    change(found)
    failed = [t.text for t in targets(found) if t.met is False]
    assert len(failed) == len(missed)
    assert all(text.startswith(start) for text, start in zip(failed, missed, strict=True))


def test_what_was_not_measured_is_neither_met_nor_missed() -> None:
    found = measured()
    found.large = None
    for name, runs in found.searches.items():
        found.searches[name] = {n: s for n, s in runs.items() if n != "SPIN"}
    assert [t.met for t in targets(found)].count(None) == 2
    assert "–" in search_table(found.searches)


@pytest.mark.parametrize(
    ("goal", "sample", "right"),
    [
        ("P1", PROVED, True),
        ("P1", reached(3), False),
        ("P4", PROVED, False),
        ("P4", reached(200), True),
        ("P4", reached(199, ""), False),
        ("P4", reached(250, ""), True),
        ("P4", reached(250), False),
    ],
)
def test_agreement_is_with_what_is_known(goal: str, sample: Sample, right: bool) -> None:
    assert agrees(goal, sample) is right


def test_cells() -> None:
    assert answer([]) == "–" and answer([OPEN]) == "open 9"
    assert (
        answer([PROVED, PROVED]) == "0.20 ✓"
        and answer([replace(PROVED, evidence="REJECTED: base")]) == "0.20"
    )
    assert answer([reached(200), reached(201)]) == "0.30 (200/201) ✓"
    assert [number(n) for n in (None, 0.0123, 1.234, 12.34)] == ["–", "0.012", "1.23", "12.3"]
    assert table(["a", "b"], [["x", "12345"]]).splitlines() == [
        "| a   |     b |",
        "|-----|------:|",
        "| x   | 12345 |",
    ]


def test_tools_take_turns_and_what_failed_is_not_repeated() -> None:
    order: list[str] = []

    def tool(name: str, sample: Sample) -> Tool:
        def once() -> Sample:
            order.append(name)
            return sample

        return once

    tools = {"a": tool("a", SEARCHED), "b": tool("b", OPEN), "c": tool("c", replace(SEARCHED, wall=1e6))}
    taken = interleaved(tools, 3)
    assert order == ["a", "b", "c", "a", "a"] and [len(s) for s in taken.values()] == [3, 1, 1]
    assert seconds(taken["a"]) == 1.0 and seconds(taken["b"]) is None


def test_a_command_is_measured() -> None:
    cost = run([sys.executable, "-c", "print(sum(range(10**6))); raise SystemExit(3)"])
    assert cost.status == 3 and cost.text.strip() == "499999500000" and not cost.timed_out
    assert cost.seconds > 0 and cost.memory > 1 << 20


def test_a_late_command_is_killed() -> None:
    cost = run([sys.executable, "-c", "while True: pass"], 0.2)
    assert cost.timed_out and cost.status < 0
