"""The measurements of one firmware: its base, what is told of its twin, of further faults, of its logs."""

import json
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Any

from benchmarks.twins.exposed import differing, exposure, inputs_of, outputs, running, shows_among
from benchmarks.twins.firmware import HERE, Firmware, Planted
from benchmarks.twins.recordings import KeptRows, kept, logs, written
from benchmarks.twins.told import ToldComparison, command, judged, matched, names, told

ALONE = HERE / "planted" / "alone.json"
"""In which outputs each difference shows alone; ``--stage alone`` writes it, in minutes."""


@dataclass(frozen=True)
class TwinEffort:
    """How much is tried: random runs beside the fixed ones, logs of each firmware, seconds for a cause."""

    examples: int = 60
    logs: int = 50
    seconds: float = 20.0
    further: int = 15


def alone(firmware: Firmware, examples: int) -> Iterator[str]:
    """Runs every difference alone, and keeps where it shows.  One that never shows is told."""
    every = json.loads(ALONE.read_text(encoding="utf-8")) if ALONE.exists() else {}
    table = every[firmware.name] = {}
    inputs_of(firmware.board_name, examples)
    for one in (*firmware.differences, *firmware.further):
        found = exposure(firmware, one, examples, enough=0 if one in firmware.differences else 5)
        own = one.own_outputs(firmware.board)
        table[one.id] = sorted(found.ever)
        if not own & found.ever:
            yield f"{one.id}: NOT EXPOSED in its own outputs by any run; it shows in {sorted(found.ever)}"
        if found.first_step != ("first step" in one.tags) and "first step" in one.tags:
            yield f"{one.id}: does not show in the first step of any run"
    ALONE.write_text(json.dumps(every, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    yield f"{len(table)} differences alone: kept in {ALONE.name}"


def shown_alone(firmware: Firmware) -> Mapping[str, Collection[str]]:
    """The outputs in which each difference shows alone."""
    table: Mapping[str, Collection[str]] = json.loads(ALONE.read_text(encoding="utf-8"))[firmware.name]
    return table


def base(firmware: Firmware, folder: Path, effort: TwinEffort) -> Iterator[str]:
    """Whether it conforms before anything is planted."""
    report = told(firmware, firmware.written(folder / "base"), folder, effort.examples)
    what = "conforms" if report.answer == 0 else f"DOES NOT CONFORM (exit code {report.answer})"
    yield f"base {what}{': ' + report.trouble if report.trouble else ''}"
    yield from (f"  {group}" for group in report.groups)


def twin(firmware: Firmware, folder: Path, effort: TwinEffort, *more: str) -> Iterator[str]:
    """Which of the planted differences are told, each in a group of its own, and what else is told."""
    began = monotonic()
    address = firmware.written(folder / "twin", firmware.differences)
    report = told(firmware, address, folder, effort.examples, *more)
    shown = shown_alone(firmware)
    verdict = judged(firmware.board, firmware.differences, shown, report.groups)
    yield (
        f"twin: {len(verdict.found)} of {len(firmware.differences)} differences told in {len(report.groups)} "
        f"groups; {len(verdict.again)} more of the same, {len(verdict.mixed)} of several, "
        f"{len(verdict.false)} false ({monotonic() - began:.0f} s, exit code {report.answer})"
    )
    if report.trouble:
        yield f"  trouble: {report.trouble}"
    yield from (f"  undecided: {text}" for text in report.undecided)
    named = [group for group in report.groups if group.change]
    right = matched(
        {
            one.id: [n for n, group in enumerate(named) if names(one, group.change)]
            for one in firmware.differences
        }
    )
    for one in firmware.differences:
        group = report.groups[verdict.found[one.id]] if one.id in verdict.found else None
        word = "NOT TOLD" if group is None else "named" if one.id in right else "told"
        if group is None and not shows_among(firmware, one, firmware.differences, effort.examples):
            word = "masked"
        yield f"  {word:8} {one.id}{_tags(one)}: {group or one.says}"
    yield from (f"  again    {report.groups[n]}" for n in verdict.again)
    yield from (f"  several  {report.groups[n]}" for n in verdict.mixed)
    yield from (f"  FALSE    {report.groups[n]}" for n in verdict.false)
    if named:
        yield f"causes: {len(named)} groups have a change, {len(right)} of them the one planted"


def causes(firmware: Firmware, folder: Path, effort: TwinEffort) -> Iterator[str]:
    """The same with the deviations merged by cause."""
    yield from twin(firmware, folder, effort, "--causes", "--seconds", str(effort.seconds))


def _tags(one: Planted) -> str:
    return f" ({', '.join(one.tags)})" if one.tags else ""


def further(firmware: Firmware, folder: Path, effort: TwinEffort) -> Iterator[str]:
    """Writes what is known of the twin, and plants each further fault on top: is it reported as new?"""
    address = firmware.written(folder / "twin", firmware.differences)
    known = folder / "known.toml"
    seconds = "--seconds", str(effort.seconds)
    report = told(firmware, address, folder, effort.examples, "--write-known", str(known), *seconds)
    if not known.exists():
        yield f"further: no file of known deviations was written: {report.trouble}"
        return
    with_known = ("--known", str(known), "--no-causes")  # what is new is asked, and not why
    again = told(firmware, address, folder, effort.examples, *with_known)
    yield f"all known: exit code {again.answer} (0 is right), {len(again.new)} groups new {again.trouble}"
    yield from (f"  STILL NEW {group}" for group in again.new)
    found = 0
    asked = firmware.further[: effort.further]
    for number, one in enumerate(asked):
        place = folder / f"further{number}"
        planted = firmware.written(place, (*firmware.differences, one))
        report = told(firmware, planted, folder, effort.examples, *with_known)
        new, said = _reported(report, again, one, firmware)
        found += new
        yield f"  {said}"
    yield f"further: {found} of {len(asked)} faults on top are reported as new"
    yield from gone(firmware, folder, effort, with_known)


def _reported(
    report: ToldComparison, before: ToldComparison, one: Planted, firmware: Firmware
) -> tuple[bool, str]:
    """Whether a group is new that is of the fault, and what is said of it."""
    seen = {(g.part, g.differences, g.moves) for g in before.new}
    new = [g for g in report.new if (g.part, g.differences, g.moves) not in seen]
    own = [g for g in new if g.outputs & one.own_outputs(firmware.board)]
    if own:
        return True, f"new      {one.id}: {own[0]}{f' and {len(new) - 1} more' if len(new) > 1 else ''}"
    others = f"; new are {', '.join(map(str, new[:3]))}" if new else ""
    return False, f"NOT NEW  {one.id}: {one.says} (exit code {report.answer}{others}) {report.trouble}"


def gone(firmware: Firmware, folder: Path, effort: TwinEffort, with_known: tuple[str, ...]) -> Iterator[str]:
    """Whether known deviations are reported to be gone once nothing is planted any more."""
    report = told(firmware, firmware.written(folder / "mended"), folder, effort.examples, *with_known)
    yield (
        f"gone: {len(report.known_gone)} known deviations are reported as gone after all are mended, "
        f"exit code {report.answer}"
    )


def variant(firmware: Firmware, folder: Path, effort: TwinEffort) -> Iterator[str]:
    """Writes the causes as a variant of the charts: is anything left that the twin does otherwise?"""
    address, file = firmware.written(folder / "twin", firmware.differences), folder / "variant.toml"
    seconds = "--seconds", str(effort.seconds)
    report = told(firmware, address, folder, effort.examples, "--write-variant", str(file), *seconds)
    if not file.exists():
        yield f"variant: none was written: {report.trouble}"
        return
    again = told(firmware, address, folder, effort.examples, "--variant", str(file), "--no-causes")
    yield f"variant: exit code {again.answer} (0 is right), {len(again.groups)} left {again.trouble}"
    yield from (f"  LEFT {group}" for group in again.groups)


# --- logs -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LoggedDifferences:
    """The logs of a twin, and the differences that show in what each of them logs."""

    folder: Path
    exposed: Mapping[str, frozenset[str]]
    """Of each log the differences that it shows alone, beside the firmware without any."""
    shown: Mapping[str, Mapping[str, frozenset[str]]]
    """Of each log and difference the outputs in which it shows, alone or beside all others."""
    masked: frozenset[str]
    """Those of the exposed ones that the others hide: the logs would be the same without them."""


def recorded(firmware: Firmware, folder: Path, number: int) -> LoggedDifferences:
    """Writes the logs, and says what there is to be found in each of them.

    On its inputs the firmware with each difference alone is compared with the one without any, and the one
    with all others with the twin: what two of them do together shows alone in nothing.
    """
    place = folder / "logs"
    place.mkdir()
    every = list(logs(firmware, number))
    with running(firmware, firmware.differences) as twin:
        for log in every:
            written(twin, log, firmware.board, place)
        with_all = {log.name: outputs(twin, log.inputs) for log in every}
    with running(firmware) as conforming:
        required = {log.name: outputs(conforming, log.inputs) for log in every}
    shown: dict[str, dict[str, frozenset[str]]] = {log.name: {} for log in every}
    left = {log.name: kept(log, firmware.board) for log in every}
    for one in firmware.differences:
        with running(firmware, [one]) as faulty:
            for log in every:
                given = outputs(faulty, log.inputs)
                shown[log.name][one.id] = _logged(required[log.name], given, left[log.name])
    exposed = {
        log.name: frozenset(
            one.id
            for one in firmware.differences
            if shown[log.name][one.id] & one.own_outputs(firmware.board)
        )
        for log in every
    }
    beside = set[str]()
    for one in firmware.differences:
        with running(firmware, [other for other in firmware.differences if other is not one]) as without:
            for log in every:
                given = outputs(without, log.inputs)
                found = _logged(with_all[log.name], given, left[log.name])
                shown[log.name][one.id] |= found
                if found:
                    beside.add(one.id)
    return LoggedDifferences(place, exposed, shown, frozenset().union(*exposed.values()) - beside)


def _logged(
    required: Sequence[Mapping[str, Any]], given: Sequence[Mapping[str, Any]], left: KeptRows
) -> frozenset[str]:
    found: set[str] = set()
    for step in left.steps:
        if required[step] != given[step]:
            found |= differing(required[step], given[step]) - left.without
    return frozenset(found)


def folder_of_logs(firmware: Firmware, folder: Path, effort: TwinEffort) -> Iterator[str]:
    """What ``check-log`` and ``diagnose`` say of the logs of a twin."""
    began = monotonic()
    made = recorded(firmware, folder, effort.logs)
    exposed = frozenset().union(*made.exposed.values()) - made.masked
    yield (
        f"logs: {len(made.exposed)} written, {len(exposed)} differences show, {len(made.masked)} more only "
        f"without the others ({monotonic() - began:.0f} s)"
    )
    yield from (f"  MASKED {d.id}: {d.says}" for d in firmware.differences if d.id in made.masked)
    yield from _checked(firmware, made)
    yield from _caused(firmware, made, exposed, effort)
    yield from _diagnosed(firmware, made, exposed, effort)


def _checked(firmware: Firmware, made: LoggedDifferences) -> Iterator[str]:
    began = monotonic()
    done = command("check-log", str(made.folder), "--json")
    try:
        document = json.loads(done.stdout)
    except ValueError:
        yield f"check-log: NO REPORT, exit code {done.returncode}: {done.stderr.strip()[-500:]}"
        return
    rows = document["logs"]
    refused = [row for row in rows if "error" in row]
    internal = [row for row in refused if row.get("internal")]
    of_none = Counter[str]()
    deviations = 0
    for row in rows:
        for deviation in row.get("deviations", ()):
            deviations += 1
            if not _planted_in(firmware, made.shown[row["log"]], deviation):
                of_none[f"{row['log']}: {', '.join(deviation['outputs'])}"] += 1
    yield (
        f"check-log: {len(rows)} logs, {len(refused) - len(internal)} refused, {len(internal)} internal "
        f"errors; {deviations} entries, {sum(of_none.values())} where no difference shows "
        f"({monotonic() - began:.0f} s, exit code {done.returncode})"
    )
    yield from (f"  REFUSED {row['log']}: {row['error']}" for row in refused)
    yield from (f"  FALSE {text} ({times})" for text, times in of_none.most_common(20))


def _caused(
    firmware: Firmware, made: LoggedDifferences, exposed: frozenset[str], effort: TwinEffort
) -> Iterator[str]:
    """What ``check-log --causes`` names over all logs."""
    began = monotonic()
    done = command("check-log", str(made.folder), "--json", "--causes", "--seconds", str(effort.seconds))
    try:
        findings = json.loads(done.stdout)["campaign"]["findings"]
    except (ValueError, KeyError):
        yield f"check-log --causes: NO REPORT, exit code {done.returncode}: {done.stderr.strip()[-500:]}"
        return
    told = [one for one in findings if one["change"]]
    shown = [one for one in firmware.differences if one.id in exposed]
    right = matched({d.id: [n for n, one in enumerate(told) if names(d, one["change"])] for d in shown})
    others = [
        one
        for n, one in enumerate(told)
        if n not in right.values() and not any(names(d, one["change"]) for d in firmware.differences)
    ]
    yield (
        f"check-log --causes: {len(right)} of {len(shown)} causes named right, {len(findings)} findings, of "
        f"which {len(told)} have a change, {len(others)} one that is not planted "
        f"({monotonic() - began:.0f} s, exit code {done.returncode})"
    )
    yield from (f"  NOT NAMED {d.id}: {d.says}" for d in shown if d.id not in right)
    yield from (f"  OTHER {one['cause']}" for one in others)


def _planted_in(
    firmware: Firmware, shown: Mapping[str, frozenset[str]], deviation: Mapping[str, Any]
) -> bool:
    """Whether a difference shows in the outputs of an entry of a log, and is of the part that decides them.

    A column that is lost leaves to the parts that it feeds what it would have shown.
    """
    outputs, part = set(deviation["outputs"]), f"{deviation['part']} ({deviation['decided_by']})"
    return any(
        outputs & shown[one.id] and (outputs & one.own_outputs(firmware.board) or one.is_named_in(part))
        for one in firmware.differences
    )


def _diagnosed(
    firmware: Firmware, made: LoggedDifferences, exposed: frozenset[str], effort: TwinEffort
) -> Iterator[str]:
    began = monotonic()
    done = command("diagnose", str(made.folder), "--json", "--seconds", str(effort.seconds))
    try:
        document = json.loads(done.stdout)
    except ValueError:
        said = (done.stderr or done.stdout).strip()[-500:]
        yield f"diagnose: no report, exit code {done.returncode}: {said}"
        return
    found: dict[str, str] = {}
    false, parts = 0, 0
    lines: list[str] = []
    for board in document["boards"]:
        for part in board["parts"]:
            parts += 1
            cause = part["cause"] or part["partial"]
            changes = cause["changes"] if cause else []
            said = cause["says"] if cause else "no cause"
            candidates = [one for one in firmware.differences if one.id in exposed and _in_part(one, part)]
            lines.append(f"  {part['part']}{'' if part['cause'] else ' (some cases only)'}: {said}")
            lines += [f"    planted: {one.id}: {one.says}" for one in candidates]
            named = matched(
                {one.id: [n for n, change in enumerate(changes) if names(one, change)] for one in candidates}
            )
            found |= dict.fromkeys(named, said)
            false += len(changes) - len(named)
            lines += [f"    RIGHT {name}" for name in named]
    yield (
        f"diagnose: {len(found)} of {len(exposed)} causes named right in {parts} parts, {false} changes of "
        f"no planted difference ({monotonic() - began:.0f} s, exit code {done.returncode})"
    )
    yield from lines


def _in_part(one: Planted, part: Mapping[str, Any]) -> bool:
    text = json.dumps(
        [part["part"], part["cause"], part["partial"], [c["outputs"] for c in part["first_cases"]]]
    )
    return any(name in text for name in (*one.parts, *one.outputs))
