"""Our tools on RoverLite, each run in a child process by ``benchmarks.child``."""

import json
import sys
from typing import Any

from benchmarks.measure import ROOT, Cost, Sample, Tool, run
from benchmarks.rivals import checked
from benchmarks.roverlite import FULL

MODELS = {"M2": (28, 1), "O": (32, 1), "M10": (31, 10), "P5 cone": (85, 1)}
"""Parts and divisor of the timers, of the models that can be searched state by state."""
PROPERTIES = ("P1", "P2", "P3", "P3h", "P4", "P5")
GRACE = 15.0
"""Seconds of wall time beyond its own limit after which a child is killed."""


def child(*arguments: object, limit: float | None = None) -> Cost:
    """Our side of a comparison, killed some seconds after its limit."""
    command = [sys.executable, "-m", "benchmarks.child", *map(str, arguments)]
    return run(command, None if limit is None else limit + GRACE, ROOT)


def killed(cost: Cost) -> Sample:
    return Sample(cost.seconds, cost.wall, "open", note="killed: it went on after its time limit")


def search(comp: int, k: int, limit: float | None = None) -> Tool:
    """The explicit search of all states, with parents and property checks."""

    def once() -> Sample:
        arguments = [comp, k] if limit is None else [comp, k, limit]
        cost = child("search", *arguments, limit=limit)
        return killed(cost) if cost.timed_out else Sample(**told(cost))

    return once


def engine(name: str, goal: str, limit: float, comp: int = FULL, k: int = 1) -> Tool:
    """One engine on one property; what it says is checked again, outside the time."""

    def once() -> Sample:
        cost = child("engine", name, goal, comp, k, limit, limit=2 * limit)
        return killed(cost) if cost.timed_out else Sample(**told(cost)[goal])

    return once


def auto(goal: str, limit: float, comp: int = FULL, k: int = 1) -> Tool:
    """Engines in turn, as ``rovercheck check`` puts a property to them; checked again, outside the time."""

    def once() -> Sample:
        cost = child("certified", goal, comp, k, limit, limit=2 * limit)
        return killed(cost) if cost.timed_out else Sample(**told(cost)[goal])

    return once


def together(limit: float) -> Sample:
    """All properties of the full model in one process, from the start of Python to its end."""
    cost = child("auto", ",".join(PROPERTIES), FULL, 1, limit, limit=limit)
    if cost.timed_out:
        return killed(cost)
    answers = {goal: Sample(**one) for goal, one in told(cost).items()}
    shown = ", ".join(f"{goal} {cell(answers[goal])}" for goal in PROPERTIES)
    verdict = "decided" if all(a.decided for a in answers.values()) else "open"
    return Sample(cost.seconds, cost.wall, verdict, note=shown)


def cell(sample: Sample) -> str:
    """``proved``, the length of the run, or ``open``."""
    return str(sample.length) if sample.verdict == "reached" else sample.verdict


def start_up() -> Cost:
    """The command line on a small property, the compiled code for which is in the cache (Python's too)."""
    command = [sys.executable, "-m", "rovercheck", "check", "PB1-13b"]
    writing = {"PYTHONDONTWRITEBYTECODE": ""}
    checked(run(command, folder=ROOT, changed=writing))
    return checked(run(command, folder=ROOT, changed=writing))


def told(cost: Cost) -> dict[str, Any]:
    """The JSON on the last line of what a child printed."""
    return dict(json.loads(checked(cost).text.splitlines()[-1]))
