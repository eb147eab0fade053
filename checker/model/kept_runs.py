"""Runs kept beside the expected verdicts: they show cases that occur, and faults that are noticed."""

import json
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from rovercheck.checker.model import Model, shown
from rovercheck.checker.model.records import baseline_of
from rovercheck.checker.results.verdict import Run
from rovercheck.spec_model.lang.errors import ModelError

T = TypeVar("T")
SCHEMA = "rovercheck/{}/1"
PREMISES, KILLS, MUTANTS = "premises", "kills", "mutants"
"""What runs are kept for: cases that occur, a mutant that a property kills, mutants killed by a search."""
INVARIANTS = "invariants"
"""What is kept of proofs (``checker.model.kept_invariants``)."""
VERDICTS = "verdicts"
"""What reports are made of (``checker.commands.reports.record``)."""
RECORD = {
    PREMISES: "rovercheck check --record-premises",
    KILLS: "rovercheck mutate --record-kills",
    MUTANTS: "rovercheck mutate --record-mutants",
    INVARIANTS: "rovercheck check --record-invariants",
    VERDICTS: "rovercheck reports",
}
ROVER = Path(__file__).parents[2] / "properties"
MOST_TICKS = 1_000_000
"""Ticks that a file may hold, all runs together: more would be no use and might not fit in memory."""


@dataclass(frozen=True)
class KeptRun:
    """A run of the system of that name, with the fault of that id in it if there is one."""

    system: str
    run: Run
    mutant: str = ""


def file_of(model: Model, kind: str = PREMISES) -> Path:
    """Where they are: ``premises.json`` beside the baseline, or ``NAME.premises.json``."""
    if model.path is None:
        return ROVER / f"{kind}.json"
    table = baseline_of(model.path)
    return table.with_name(f"{table.name.removesuffix('baseline.toml')}{kind}.json")


def read(file: Path, kind: str = PREMISES, only: Collection[str] | None = None) -> dict[str, KeptRun]:
    """The runs in a file by the id of their property or mutant, none if there is no file.

    With ``only``, those of these ids; the others are not looked at.  Raises ``ModelError`` for a file that
    holds something else.
    """

    def runs(rows: Any) -> dict[str, KeptRun]:
        left, found = MOST_TICKS, dict[str, KeptRun]()
        for id, one in rows.items():
            if only is not None and id not in only:
                continue
            found[id] = kept(one, left)
            left -= len(found[id].run)
        return found

    return contents(file, kind, "runs", runs)


def contents(file: Path, kind: str, what: str, made: Callable[[Any], dict[str, T]]) -> dict[str, T]:
    """What is made of all rows of a file that is kept, by their id; nothing if there is none.

    Raises ``ModelError`` for a file that holds something else.
    """
    if not file.exists():
        return {}
    try:
        whole = json.loads(file.read_text(encoding="utf-8"))
        if whole["schema"] != SCHEMA.format(kind):
            raise ValueError(f"its schema is {whole['schema']!r}, not {SCHEMA.format(kind)!r}")
        return made(whole[what])
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        why = f"{type(error).__name__}: {error}" if isinstance(error, KeyError) else str(error)
        again = f"Remove it, and `{RECORD[kind]}` writes it anew."
        raise ModelError(f"{shown(file)} holds no {what}: {why}. {again}") from error


def text(runs: Mapping[str, KeptRun], kind: str = PREMISES) -> str:
    """The runs as JSON, one a line; of a tick the inputs that differ from the one before."""
    return lines(kind, "runs", {id: row(one) for id, one in runs.items()})


def lines(kind: str, what: str, rows: Mapping[str, object]) -> str:
    """Rows to keep as JSON, one a line."""
    ordered = (f"  {json.dumps(id)}: {json.dumps(rows[id], separators=(',', ':'))}" for id in sorted(rows))
    schema = json.dumps(SCHEMA.format(kind))
    return f'{{"schema": {schema}, {json.dumps(what)}: {{\n' + ",\n".join(ordered) + "\n}}\n"


def row(one: KeptRun) -> dict[str, object]:
    """A run as JSON; of a tick the inputs that differ from the one before."""
    blocks: list[tuple[int, dict[str, int]]] = []
    before: Mapping[str, int] = {}
    for inputs in one.run.inputs:
        changed = {name: value for name, value in inputs.items() if before.get(name) != value}
        if changed or not blocks:
            blocks.append((1, changed))
        else:
            blocks[-1] = (blocks[-1][0] + 1, blocks[-1][1])
        before = inputs
    mutant = {"mutant": one.mutant} if one.mutant else {}
    return {"system": one.system, **mutant, "frozen": dict(one.run.frozen), "blocks": blocks}


def kept(row: Mapping[str, Any], most: int) -> KeptRun:
    """What ``row`` wrote, of at most so many ticks.  Raises ``ValueError`` or the like for anything else."""
    inputs: list[dict[str, int]] = []
    at: dict[str, int] = {}
    for ticks, changed in row["blocks"]:
        if not isinstance(ticks, int) or not 1 <= ticks <= most - len(inputs):
            raise ValueError(f"{ticks!r} is no number of ticks, or there are more than {MOST_TICKS:,} in all")
        at = at | _numbers(changed)
        inputs += [at] * ticks
    return KeptRun(
        str(row["system"]), Run(_numbers(row["frozen"]), tuple(inputs)), str(row.get("mutant", ""))
    )


def _numbers(values: Mapping[str, Any]) -> dict[str, int]:
    wrong = [name for name, value in values.items() if not isinstance(value, int)]
    if wrong:
        raise ValueError(f"{wrong[0]} is {values[wrong[0]]!r}, no whole number")
    return {name: int(value) for name, value in values.items()}


__all__ = [
    "INVARIANTS",
    "KILLS",
    "MUTANTS",
    "PREMISES",
    "VERDICTS",
    "KeptRun",
    "contents",
    "file_of",
    "kept",
    "lines",
    "read",
    "row",
    "text",
]
