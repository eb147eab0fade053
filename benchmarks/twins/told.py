"""What ``rovercheck compare`` tells of a firmware, read from its JSON, and which planted difference each is.

Read with tolerance: a mismatch without a part belongs to the part that writes its first output.
"""

import json
import re
import subprocess
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from benchmarks.measure import ROOT
from benchmarks.twins.firmware import Firmware, Planted
from rovercheck.checker.compare.beside import author_of
from rovercheck.spec_model.abstraction import Board

TIMEOUT = 3600.0


@dataclass(frozen=True)
class ToldGroup:
    """A group of mismatches as the report tells it: the part, its outputs with both values, what was done."""

    part: str
    differences: tuple[tuple[str, str, str], ...]
    moves: tuple[str, ...] = ()
    known: str = ""
    runs: int = 1
    change: Mapping[str, Any] = field(default_factory=dict)
    """With ``--causes``: the change of the charts that is named; empty where none is."""

    @property
    def outputs(self) -> frozenset[str]:
        """The outputs that differ."""
        return frozenset(name for name, _, _ in self.differences)

    def __str__(self) -> str:
        values = ", ".join(f"{n} {e} is {a}" for n, e, a in self.differences)
        return f"{self.part}: {values} [{'; '.join(self.moves)}] in {self.runs} runs"


@dataclass(frozen=True)
class ToldComparison:
    """A whole report; ``answer`` is its exit code, ``trouble`` what it said instead of a report."""

    answer: int
    groups: tuple[ToldGroup, ...]
    trouble: str = ""
    undecided: tuple[str, ...] = ()
    known_gone: tuple[str, ...] = ()

    @property
    def new(self) -> tuple[ToldGroup, ...]:
        """The groups that are not known: ``known`` is empty, or says so."""
        return tuple(g for g in self.groups if g.known not in KNOWN)


KNOWN = ("known", "expected", "seen")
"""The words for a deviation that is known and as it was."""


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Runs ``rovercheck`` with these arguments."""
    asked = [sys.executable, "-m", "rovercheck", *arguments]
    return subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, timeout=TIMEOUT, check=False)


def told(firmware: Firmware, address: str, folder: Path, examples: int, *more: str) -> ToldComparison:
    """What the cross-check of one firmware says; tests are written into the folder."""
    done = command(
        *("compare", "--system", firmware.board_name, "--impl", address, "--examples", str(examples)),
        *("--mismatches", "0", "--json", "--output", str(folder), *more),
    )
    try:
        document = json.loads(done.stdout)
    except ValueError:
        return ToldComparison(done.returncode, (), (done.stderr or done.stdout).strip()[-2000:])
    result = document["results"][0]
    return ToldComparison(
        done.returncode,
        tuple(_groups(firmware.board, result)),
        "; ".join(row["message"] for row in result["failures"]),
        tuple(f"{row['part']}: {row['because']}" for row in result.get("undecided", ())),
        tuple(row["id"] for row in result.get("known", ()) if "gone" in json.dumps(row)),
    )


def _groups(board: Board, result: Mapping[str, Any]) -> Iterator[ToldGroup]:
    """A group for each deviation, or for each cause where causes were asked for."""
    told = {row["id"]: _group(board, row) for row in result["mismatches"]}
    if not result["causes"]:
        yield from told.values()
    for cause in result["causes"]:
        groups = [told[id] for id in cause["deviations"]]
        yield replace(
            groups[0],
            part=" and ".join(dict.fromkeys(g.part for g in groups)),
            differences=tuple(dict.fromkeys(d for g in groups for d in g.differences)),
            moves=(cause["says"],) if cause["says"] else groups[0].moves,
            change=cause["change"] or {},
        )


def _group(board: Board, row: Mapping[str, Any]) -> ToldGroup:
    differences = tuple((d["output"], str(d["expected"]), str(d["actual"])) for d in row["differences"])
    part = row.get("part") or author_of(board, differences[0][0])
    decided = row.get("decided_by", "")
    return ToldGroup(
        part if not decided or decided == part else f"{part} ({decided})",
        differences,
        tuple(row.get("arrows", ())),
        str(row.get("known", "")),
        int(row.get("runs", 1)),
    )


def fits(board: Board, planted: Planted, alone: Collection[str], group: ToldGroup) -> bool:
    """Whether a group may be of a planted difference: it shows alone in those outputs, and it is of its part.

    Of its part is what its parts write, and what a report says its parts decide, however far on it shows.
    """
    found = group.outputs
    own = found <= planted.own_outputs(board)
    return bool(found) and found <= set(alone) and (own or planted.is_named_in(group.part))


def names(one: Planted, change: Mapping[str, Any]) -> bool:
    """Whether a change of a chart is the planted difference: its chart, and a pattern of what is written."""
    if one.cause == "":
        return False
    text = " ".join(str(change.get(key, "")) for key in ("kind", "chart", "at", "old", "new", "note"))
    return re.search(one.cause, text) is not None


def matched(fitting: Mapping[str, Sequence[int]]) -> dict[str, int]:
    """The most differences that can each be given a group of its own, by augmenting paths."""
    holder: dict[int, str] = {}

    def give(name: str, seen: set[int]) -> bool:
        for number in fitting[name]:
            if number not in seen:
                seen.add(number)
                if number not in holder or give(holder[number], seen):
                    holder[number] = name
                    return True
        return False

    for name in fitting:
        give(name, set())
    return {name: number for number, name in holder.items()}


@dataclass(frozen=True)
class ToldTwin:
    """How the groups of a report go with what is planted."""

    found: Mapping[str, int]
    """Each difference that was told, and the number of its group."""
    missing: tuple[str, ...]
    again: tuple[int, ...]
    """Groups beyond the one of a difference."""
    mixed: tuple[int, ...]
    """Groups that only several differences of a part show together."""
    false: tuple[int, ...]
    """Groups that no planted difference shows alone."""


def judged(
    board: Board,
    planted: Sequence[Planted],
    alone: Mapping[str, Collection[str]],
    groups: Sequence[ToldGroup],
) -> ToldTwin:
    """Gives every difference a group of its own where there is one: it fits, or its change names it."""
    named = {one.id: [n for n, g in enumerate(groups) if names(one, g.change)] for one in planted}
    fitting = {
        one.id: [
            *named[one.id],
            *(
                n
                for n, g in enumerate(groups)
                if n not in named[one.id] and fits(board, one, alone[one.id], g)
            ),
        ]
        for one in planted
    }
    first = matched(named)  # so that none is given the group that names another one
    taken = set(first.values())
    fitting = {
        name: [*(n for n in some if first.get(name) == n), *(n for n in some if n not in taken), *some]
        for name, some in fitting.items()
    }
    found = matched(dict(sorted(fitting.items(), key=lambda item: item[0] not in first)))
    of_some = {n for numbers in fitting.values() for n in numbers}
    mixed = [n for n in range(len(groups)) if n not in of_some and _mixed(board, planted, alone, groups[n])]
    return ToldTwin(
        found,
        tuple(name for name in fitting if name not in found),
        tuple(sorted(of_some - set(found.values()))),
        tuple(mixed),
        tuple(n for n in range(len(groups)) if n not in of_some and n not in mixed),
    )


def _mixed(
    board: Board, planted: Sequence[Planted], alone: Mapping[str, Collection[str]], group: ToldGroup
) -> bool:
    """Whether each output of a group is one that some difference shows alone, in a group of this part."""
    one_each = (replace(group, differences=(one,)) for one in group.differences)
    return all(any(fits(board, p, alone[p.id], one) for p in planted) for one in one_each)
