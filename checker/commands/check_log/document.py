"""What was found in a log, for machines."""

from rovercheck.checker.logs import LogResult, as_on_record
from rovercheck.checker.logs.deviations import Deviation
from rovercheck.checker.logs.invalid import InvalidCell
from rovercheck.checker.logs.monitors import Verdict

Entry = dict[str, object]


def as_json(found: LogResult, charts: str = "") -> Entry:
    """Everything about one log; ``charts``: how the charts differ from those specified, in words."""
    return {
        "log": found.name,
        "system": found.layout.board,
        "charts": charts or "as specified",
        "start": found.start,
        "rows": found.rows,
        "ticks": found.ticks,
        "missing_steps": found.missing,
        "invalid_cells": [_cell(c) for c in found.invalid.cells],
        "invalid_cells_of_other_values": dict(found.invalid.others),
        "ignored_columns": list(found.layout.ignored),
        "inferred": list(found.behaviour.inferred),
        "compared": list(found.behaviour.compared),
        "not_compared": list(found.behaviour.left_out),
        "properties": [_verdict(v) for v in found.verdicts],
        "not_monitorable": {o.property.id: list(o.missing) for o in found.choice.missing},
        "not_for_logs": {o.property.id: o.because for o in found.choice.untold},
        "deviations": [_deviation(d) for d in found.behaviour.deviations],
        "unknown": [
            {"part": u.part, "from_tick": u.tick, "because": u.because} for u in found.behaviour.undecided
        ],
        "conforms": found.conforms,
    }


def _cell(cell: InvalidCell) -> Entry:
    return {
        "column": cell.column,
        "signal": cell.signal,
        "value": cell.text,
        "because": cell.because,
        "first_tick": cell.tick,
        "first_line": cell.line,
        "last_line": cell.last_line,
        "rows": cell.count,
    }


def _verdict(verdict: Verdict) -> Entry:
    entry: Entry = {
        "id": verdict.prop.id,
        "verdict": verdict.word,
        "as_on_record": as_on_record(verdict) if verdict.count else True,
        "ticks": verdict.count,
        "ticks_tested": verdict.tested,
    }
    if verdict.first is not None:
        entry["first"] = {
            "tick": verdict.first.tick,
            "line": verdict.first.line,
            "false": list(verdict.first.parts),
            "values": dict(verdict.first.values),
        }
    return entry


def _deviation(one: Deviation) -> Entry:
    return {
        "kind": one.kind,
        "outputs": list(one.outputs),
        "first_tick": one.first.tick,
        "first_line": one.first.line,
        "last_tick": one.last,
        "ticks": one.count,
        "times": one.times,
        "differences": [_difference(d.output.name, *d.values()) for d in one.differences],
        "charts": list(one.first.moves),
        "inputs": dict(one.first.inputs),
    }


def _difference(output: str, expected: list[str], logged: str) -> Entry:
    return {"output": output, "expected": expected, "logged": logged}
