"""``rovercheck simulate INPUTS.csv --model MODEL``: run charts on inputs from a table, and show the run."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, possible, wrote
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.trace.examples import boards_changed
from rovercheck.checker.commands.trace.formats import exit_written, format_of
from rovercheck.checker.explore.by_hand.session import MOST_TICKS, Session
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.render import renderers
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.system import System

STEPS = "steps"
"""The column that says for how many steps the inputs of a row stay; one where it is empty or not there."""

Row = Mapping[str, str]


def simulate_charts(place: Path, variant: Variant, name: str | None, output: Path | None) -> Exit:
    """Run a system on the inputs of a CSV file, each row for one step or more; an empty cell leaves an input.

    Every step is executed by the chart interpreter and by the lowered system.  Raises ``UsageError`` for a
    table without meaning, with its line, and ``ModelError``.
    """
    possible(output)
    try:
        format = "table" if output is None else format_of(str(output))
    except ModelError as error:
        raise UsageError(str(error)) from error
    by_name = variant.systems()
    system = _system(by_name, name)
    for note in variant.changes.notes() if variant.changes else ():
        err.print(note, markup=False)
    session = _run(system, place)
    renderer = renderers("trace")[format]
    trace, systems = session.simulation.trace(), {**by_name, system.name: system}
    others = exit_written(renderer, trace, systems, output, boards=boards_changed(variant))
    for written in (output, *others):
        wrote(written)
    return Exit.AS_EXPECTED


def _system(by_name: Mapping[str, System], name: str | None) -> System:
    if name is None and len(by_name) != 1:
        some = ", ".join(list(by_name)[:8])
        raise UsageError(f"There are {len(by_name)} systems, such as {some}; name one with --system.")
    return pick("system", name or next(iter(by_name)), by_name)


def _run(system: System, place: Path) -> Session:
    session = Session(system)
    for line, row in _rows(place, session.simulation.inputs):
        given = [(name, text) for name, text in row.items() if name != STEPS and text]
        try:
            if given:
                session.set(given)
            session.advance(steps := _steps(row))
        except (RefusedInput, ModelError, ValueError) as error:
            raise UsageError(f"{whole(place)}, line {line}: {error}") from error
        if len(session.simulation) > MOST_TICKS:
            raise UsageError(
                f"{whole(place)}, line {line}: {steps} more steps are over {MOST_TICKS:,}; simulate fewer."
            )
    if not len(session.simulation):
        raise UsageError(f"{whole(place)} holds no step; write the inputs of each in a line.")
    return session


def _steps(row: Row) -> int:
    """Raises ``ValueError`` for what is no number of steps."""
    text = row.get(STEPS) or "1"
    if not text.isdigit() or not 0 < int(text) <= MOST_TICKS:
        raise ValueError(f"{STEPS} = {text!r} is no number of steps from 1 to {MOST_TICKS:,}.")
    return int(text)


def _rows(place: Path, inputs: Mapping[str, object]) -> Sequence[tuple[int, Row]]:
    """The rows of a table by their lines.  Raises ``UsageError``."""
    try:
        with place.open(encoding="utf-8-sig", newline="") as file:
            table = list(csv.reader(file))
    except OSError as error:
        raise UsageError(
            f"Cannot read {whole(place)}: {error.strerror}. Write the path of a table."
        ) from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise UsageError(f"{whole(place)} is no table in CSV: {error}.") from error
    names = [name.strip() for name in table[0]] if table else []
    known = [*inputs, STEPS]
    for name in names:
        if name not in known:
            raise UsageError(f"{whole(place)}: the column {name!r} is no input. {did_you_mean(name, known)}")
    if len(set(names)) < len(names):
        raise UsageError(f"{whole(place)} has two columns of one name; leave one out.")
    rows = [(n, [cell.strip() for cell in row]) for n, row in enumerate(table[1:], 2) if any(row)]
    for line, row in rows:
        if len(row) != len(names):
            raise UsageError(f"{whole(place)}, line {line}: {len(row)} cells under {len(names)} columns.")
    return [(line, dict(zip(names, row, strict=True))) for line, row in rows]
