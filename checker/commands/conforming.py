"""``rovercheck conform``: logs checked against the properties and the charts."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from checker.commands.codes import Exit, UsageError
from checker.commands.conforming_json import as_json
from checker.commands.conforming_text import page, summary
from checker.commands.output import err, out
from checker.commands.silence import silent
from checker.commands.variant import Variant, pick_variant
from checker.conform.logs import Against, LogError, Map, Result, examine, read_map
from checker.conform.varied import varied

SCHEMA = "rovercheck/conform/1"
"""The format of the JSON documents, and its version."""

SUFFIXES = (".csv", ".csv.gz", ".tsv", ".tsv.gz", ".parquet")
Outcome = Result | LogError


@dataclass(frozen=True)
class Asked:
    """What the command line asks for; ``against``: the charts, with ``charts`` in words where changed."""

    how: Map
    system: str
    as_json: bool
    verbose: bool
    charts: str = ""
    against: Against | None = None

    def examined(self, path: Path) -> Outcome:
        """What one log says."""
        try:
            return examine(path, self.how, self.system, self.against)
        except LogError as error:
            return error


def conform(
    place: Path,
    map_file: Path | None,
    system: str | None,
    json_wanted: bool,
    verbose: bool,
    chosen: tuple[str, ...] = (),
    repair: str | None = None,
) -> Exit:
    """Check one log or all logs of a folder, under chosen readings and with a repair.

    Raises ``UsageError`` for a map without meaning, and for a single log that cannot be read.
    """
    variant = pick_variant(chosen, repair, ())
    against = _against(variant) if variant.name else None
    asked = Asked(_map(map_file), system or "", json_wanted, verbose, variant.name, against)
    return _folder(place, asked) if place.is_dir() else _log(place, asked)


def _log(place: Path, asked: Asked) -> Exit:
    found = asked.examined(place)
    if isinstance(found, LogError):
        raise UsageError(f"{place}: {found}")
    if asked.as_json:
        print(json.dumps({"schema": SCHEMA, **as_json(found, asked.charts)}, indent=2, ensure_ascii=False))
    else:
        out.print(page(found, asked.verbose, asked.charts), markup=False)
    return _code([found])


def _against(variant: Variant) -> Against:
    """The boards, properties and verdicts on record of a variant."""
    found = varied(variant.choices, variant.repair)
    properties, systems = variant.properties(), variant.systems()
    return Against(found, properties, systems, lambda id: variant.expected(id).verdict)


def _map(file: Path | None) -> Map:
    if file is None:
        return Map()
    try:
        return read_map(file)
    except LogError as error:
        raise UsageError(str(error)) from error


def _folder(folder: Path, asked: Asked) -> Exit:
    """Every log of a folder; one that cannot be read leaves the others' results."""
    logs = sorted(p for p in folder.iterdir() if p.is_file() and p.name.lower().endswith(SUFFIXES))
    if not logs:
        err.print(f"{folder} holds no log ({', '.join(SUFFIXES)}).", markup=False)
        return Exit.NOTHING
    found: dict[str, Outcome] = {}
    for number, log in enumerate(logs, 1):
        if err.is_terminal and not silent():
            err.print(f"{number} of {len(logs)}: {log.name}", markup=False)
        found[log.name] = asked.examined(log)
    if asked.as_json:
        entries = [_entry(n, r, asked.charts) for n, r in found.items()]
        print(json.dumps({"schema": SCHEMA, "logs": entries}, indent=2, ensure_ascii=False))
    else:
        out.print(summary(found, asked.charts), markup=False)
    return _code(list(found.values()))


def _entry(name: str, found: Outcome, charts: str) -> Mapping[str, object]:
    return as_json(found, charts) if isinstance(found, Result) else {"log": name, "error": str(found)}


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
