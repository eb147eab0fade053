"""``rovercheck conform``: logs checked against the properties and the charts."""

import json
from collections.abc import Mapping
from pathlib import Path

from checker.commands.codes import Exit, UsageError
from checker.commands.conforming_json import as_json
from checker.commands.conforming_text import page, summary
from checker.commands.output import err, out
from checker.conform.logs import LogError, Map, Result, examine, read_map

SUFFIXES = (".csv", ".csv.gz", ".tsv", ".tsv.gz", ".parquet")
Outcome = Result | LogError


def conform(place: Path, map_file: Path | None, system: str | None, json_wanted: bool, verbose: bool) -> Exit:
    """Check one log or all logs of a folder.

    Raises ``UsageError`` for a map without meaning, and for a single log that cannot be read.
    """
    how = _map(map_file)
    if place.is_dir():
        return _folder(place, how, system or "", json_wanted)
    found = _examined(place, how, system or "")
    if isinstance(found, LogError):
        raise UsageError(f"{place}: {found}")
    if json_wanted:
        print(json.dumps(as_json(found), indent=2, ensure_ascii=False))
    else:
        out.print(page(found, verbose), markup=False)
    return _code([found])


def _map(file: Path | None) -> Map:
    if file is None:
        return Map()
    try:
        return read_map(file)
    except LogError as error:
        raise UsageError(str(error)) from error


def _examined(path: Path, how: Map, system: str) -> Outcome:
    try:
        return examine(path, how, system)
    except LogError as error:
        return error


def _folder(folder: Path, how: Map, system: str, json_wanted: bool) -> Exit:
    """Every log of a folder; one that cannot be read leaves the others' results."""
    logs = sorted(p for p in folder.iterdir() if p.is_file() and p.name.lower().endswith(SUFFIXES))
    if not logs:
        err.print(f"{folder} holds no log ({', '.join(SUFFIXES)}).", markup=False)
        return Exit.NOTHING
    found: dict[str, Outcome] = {}
    for number, log in enumerate(logs, 1):
        if err.is_terminal:
            err.print(f"{number} of {len(logs)}: {log.name}", markup=False)
        found[log.name] = _examined(log, how, system)
    if json_wanted:
        print(json.dumps({"logs": [_entry(n, r) for n, r in found.items()]}, indent=2, ensure_ascii=False))
    else:
        out.print(summary(found), markup=False)
    return _code(list(found.values()))


def _entry(name: str, found: Outcome) -> Mapping[str, object]:
    return as_json(found) if isinstance(found, Result) else {"log": name, "error": str(found)}


def _code(found: list[Outcome]) -> Exit:
    """What deviates counts first, then a log that cannot be read, then what is open."""
    results = [r for r in found if isinstance(r, Result)]
    if any(r.deviates for r in results):
        return Exit.CHANGED
    if len(results) < len(found):
        return Exit.USAGE
    if any(r.behaviour.undecided for r in results):
        return Exit.INCONCLUSIVE
    return Exit.AS_EXPECTED
