"""A whole model as a system: its charts and blocks in their order of execution, its inputs free."""

from collections.abc import Mapping

from rovercheck.checker.drawn.lower.attempt import LoweringAttempt
from rovercheck.checker.drawn.lower.data import DataTable, SizeLearned
from rovercheck.checker.drawn.lower.kinds import KindTable
from rovercheck.checker.drawn.lower.lowered import LoweredModel, RangeNotKnown
from rovercheck.checker.drawn.lower.program import MOST_STATEMENTS, TooManyStatements
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.lower.system import SystemWriter
from rovercheck.checker.drawn.parsed import parsed_chart
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.spec_model.lang.domain import Domain

ATTEMPTS = 24
"""Times that a model is lowered until nothing new is learned of its data."""
MANY_STATEMENTS = 5_000
"""A step with more is shortened first, if that is possible."""


def lowered_model(
    model: DrawnModel, file: str, domains: Mapping[str, Domain] | None = None, step: str = "",
    systems: type[SystemWriter] = SystemWriter,
) -> LoweredModel:  # fmt: skip
    """The system of a model.

    ``domains`` are those of inputs and data, by name; ``systems`` makes the components.
    Raises ``NotLowered`` for what has no formula, with its place, and for a datum whose range is not given.
    """
    try:
        return _lowered(model, file, domains or {}, step, systems)
    except RecursionError:
        raise NotLowered("states, blocks or expressions are nested too deeply") from None


def _lowered(
    model: DrawnModel, file: str, domains: Mapping[str, Domain], step: str, systems: type[SystemWriter]
) -> LoweredModel:
    for note in notes_of(model):
        if note.kind == "refused":
            raise NotLowered(str(note).rstrip("."))
    charts = {one.path: parsed_chart(one) for one in model.charts}
    for parsed in charts.values():
        if parsed.notes:
            raise NotLowered(str(parsed.notes[0]))
    table = DataTable(KindTable.of(model), domains)
    most = MANY_STATEMENTS
    for _ in range(ATTEMPTS):
        table.begin()
        try:
            found = LoweringAttempt(model, file, table, charts, step or model.step, most, systems).lowered()
        except TooManyStatements as error:
            if not table.shortened():
                if most == MOST_STATEMENTS:
                    raise NotLowered(str(error)) from error
                most = MOST_STATEMENTS
            continue
        except SizeLearned:
            table.settle()
            continue
        table.settle()
        _refuse_too_fine(table)
        if not table.changed:
            return found
    if table.endless:
        raise RangeNotKnown("the range of {} does not follow from what is assigned", table.endless)
    raise NotLowered(f"{', '.join(sorted(table.changed)[:5])} is of another type in each attempt")


def _refuse_too_fine(table: DataTable) -> None:
    fine = table.too_fine()
    if fine:
        raise RangeNotKnown("{} is computed with more and more digits, or without end", fine)


__all__ = ["lowered_model"]
