"""``rovercheck import``: what is drawn in a file of Simulink, for people and as JSON."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from rovercheck.checker.commands.import_.document import document
from rovercheck.checker.commands.import_.lowering import LoweringReport, lowering_of
from rovercheck.checker.commands.import_.recorded import RecordingComparison, compared_with
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.output import counted, out, text_width
from rovercheck.checker.commands.shared.tables import listed
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.drawn.parsed import parsed_chart
from rovercheck.checker.drawn.records import DrawnChart, DrawnModel
from rovercheck.checker.drawn.refused import DrawingNote, notes_of
from rovercheck.checker.drawn.unknown import unknown_names
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.drawn import free_in
from rovercheck.checker.simulink.model import read_model

COLUMNS = ("Chart", "is a", "states", "transitions", "junctions", "functions", "data", "events", "timers")
MOST_SHOWN = 5
"""Rows that are shown of those that differ."""
_TIMERS = re.compile(r"\b(?:after|before|at|every|temporalCount|elapsed|duration|count)\s*\(")


def import_model(
    path: Path, beside: Sequence[Path], log: Path | None, *, strict: bool, as_json: bool
) -> Exit:
    """Read a model, and say what is in it; ``strict``: what is read with a note is not as expected.

    Raises ``ModelError`` for a file that cannot be read.
    """
    said = read_domains(domains_path(path))
    model = read_model(path, [*said.beside, *beside])
    model = model if strict else free_in(model, said)
    notes = list(notes_of(model))
    for chart in map(parsed_chart, model.charts):
        notes += [*chart.notes, *unknown_names(chart, model.enumerations, model.free)]
    compared = None if log is None else compared_with(model, log)
    lowering = None if any(note.kind == "refused" for note in notes) else lowering_of(path, model)
    code = Exit.INCONCLUSIVE if any(note.kind == "refused" for note in notes) else Exit.AS_EXPECTED
    if lowering is not None and (lowering.refused or (strict and (lowering.needed or lowering.notes))):
        code = Exit.INCONCLUSIVE
    if strict and notes:
        code = Exit.INCONCLUSIVE
    if compared is not None and compared.differences:
        code = Exit.FAILED
    if lowering is not None and lowering.difference:
        code = Exit.INTERNAL
    if as_json:
        print(json_text(document(model, notes, lowering, compared, code), ascii=True))
        return code
    for line in _head(model):
        out.print(line, markup=False)
    if model.charts:
        out.print()
        listed(COLUMNS, [_row(chart) for chart in model.charts])
    for lines in (
        _around(model), _types(model), _notes(notes), _lowered(path, lowering), _compared(compared, log)
    ):  # fmt: skip
        told = list(lines)
        if told:
            out.print()
            out.print("\n".join(told), markup=False)
    return code


def _head(model: DrawnModel) -> Iterator[str]:
    release = f"Simulink {model.release}" if model.release else "Simulink"
    step = f"steps of {model.step} s" if model.step not in ("", "auto") else "steps of unknown length"
    yield f"{model.name}: {release}, {counted(len(model.charts), 'chart', 'charts')}, {step}."
    if len(model.files) > 1:
        yield _wrapped(f"read with {', '.join(Path(file).name for file in model.files[1:])}", "  ")


def _row(chart: DrawnChart) -> tuple[str, ...]:
    levels = list(chart.content.every_level())
    states = list(chart.content.every_state())
    labels = [one.label for one in states] + [t.label for level in levels for t in level.transitions]
    kind = chart.kind if chart.kind != "chart" else f"{chart.language} chart"
    drawn = levels if chart.kind != "MATLAB function" else []  # what is drawn there calls its function
    counts = (
        sum(one.kind in ("exclusive", "parallel") for one in states),
        sum(len(level.transitions) for level in drawn),
        sum(len(level.junctions) for level in drawn),
        sum(one.kind == "function" for one in states),
        sum(len(level.data) for level in levels),
        sum(len(level.events) for level in levels),
        sum(len(_TIMERS.findall(label)) for label in labels),
    )
    return (chart.shown_path, kind, *map(str, counts))


def _around(model: DrawnModel) -> Iterator[str]:
    """How many blocks there are of each kind, without those that are charts."""
    kinds = Counter(block.kind for block in model.system.every_block() if not block.chart)
    if kinds:
        told = ", ".join(
            f"{times} {kind}" for kind, times in sorted(kinds.items(), key=lambda k: (-k[1], k[0]))
        )
        yield _wrapped(f"Blocks around them: {told}.")


def _types(model: DrawnModel) -> Iterator[str]:
    for one in model.enumerations:
        members = ", ".join(f"{name} = {value}" for name, value in one.members.items())
        yield _wrapped(f"Enumeration {one.name} ({one.file}): {members}.")
    for bus in model.buses:
        elements = ", ".join(f"{element.name} ({element.type})" for element in bus.elements)
        yield _wrapped(f"Bus {bus.name} ({bus.file}): {elements}.")
    if model.parameters:
        told = ", ".join(f"{one.name} = {one.value}" for one in model.parameters)
        yield _wrapped(f"Parameters: {told}.")


def _notes(notes: Sequence[DrawingNote]) -> Iterator[str]:
    heads = {"refused": "Without a meaning here:", "otherwise": "Read otherwise than drawn:"}
    for kind, head in heads.items():
        own = [note for note in notes if note.kind == kind]
        if own:
            yield head
        for note in own:
            yield _wrapped(f"{'✗' if kind == 'refused' else '•'} {note}", "  ")


def _lowered(path: Path, found: LoweringReport | None) -> Iterator[str]:
    if found is None:
        return
    if found.refused:
        yield _wrapped(f"✗ It cannot be checked: {found.refused}.")
        return
    if found.needed:
        yield _wrapped(f"• It cannot be checked yet: {found.needed}.")
        return
    size = f"{counted(found.inputs, 'input', 'inputs')}, {counted(found.variables, 'variable', 'variables')}"
    yield _wrapped(f"✓ It can be checked, as a system with {size}: rovercheck check --model {path}")
    for note in found.notes:
        yield _wrapped(f"• {note}", "  ")
    if found.difference:
        yield _wrapped(
            "✗ The two ways in which it is read differ, which is an error of rovercheck: "
            f"{found.difference}. Please report it.", "  ",
        )  # fmt: skip
    elif found.alike:
        yield _wrapped(f"in {found.steps:,} steps of random runs the direct interpreter gives the same", "  ")


def _compared(found: RecordingComparison | None, log: Path | None) -> Iterator[str]:
    if found is None or log is None:
        return
    rows = counted(found.rows, "row", "rows")
    if not found.differences:
        outputs = ", ".join(found.outputs)
        yield _wrapped(f"✓ {log.name}: in {rows} the model gives what is recorded: {outputs}.")
    else:
        yield _wrapped(f"✗ {log.name}: {len(found.differences)} of {rows} differ.")
    for one in found.differences[:MOST_SHOWN]:
        told = (f"{name} is {given:g} and recorded {was:g}" for name, (was, given) in one.values.items())
        yield _wrapped(f"row {one.row} (line {one.line}): {', '.join(told)}", "  ")
        yield from (_wrapped(f"takes {text}", "    ") for text in one.fired)
    if len(found.differences) > MOST_SHOWN:
        yield f"  and {len(found.differences) - MOST_SHOWN} more rows; --json has them all"
    if found.missing:
        yield _wrapped(f"not recorded: {', '.join(found.missing)}", "  ")


def _wrapped(text: str, indent: str = "") -> str:
    return filled(" ".join(text.split()), text_width(), indent, f"{indent}  ")


__all__ = ["import_model"]
