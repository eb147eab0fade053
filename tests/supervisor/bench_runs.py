"""Short runs of the bench for the tests, written as scenarios."""

from typing import Any

from rovercheck.supervisor.bench import Record, Scenario, parse, simulate
from rovercheck.supervisor.bench.columns import outputs1, outputs2


def scenario(*events: dict[str, Any], duration: str = "2 s", **keys: Any) -> Scenario:
    return parse({"duration": duration, "event": list(events), **keys})


def run(*events: dict[str, Any], duration: str = "2 s", **keys: Any) -> Record:
    return simulate(scenario(*events, duration=duration, **keys))


def at(label: str, **settings: Any) -> dict[str, Any]:
    """An event at a time."""
    return {"at": label, **settings}


def board1(record: Record, name: str) -> dict[int, Any]:
    """An output of Board 1 by the time in ms."""
    return {step.time_us // 1000: outputs1(step.outputs)[name] for step in record.board1}


def board2(record: Record, name: str) -> dict[int, Any]:
    """An output of Board 2 by the time in ms."""
    return {step.time_us // 1000: outputs2(step.outputs)[name] for step in record.board2}


def first(found: dict[int, Any], value: Any, after: int = 0) -> int:
    """The first time in ms at which it has the value."""
    return next(time for time, one in found.items() if time >= after and one == value)
