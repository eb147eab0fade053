"""Causes told as sentences."""

from collections.abc import Iterable, Mapping, Sequence

from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.decide import DecidingRun
from rovercheck.checker.diagnosis.result import DiagnosedPart
from rovercheck.checker.diagnosis.search import ExplainingCause

WITH = ("limit", "constant", "timer", "repair")
"""Kinds whose text is what there is instead of what is drawn."""


def behaves(cause: ExplainingCause) -> str:
    """What the part is like, chart by chart: "Monitor_temperature behaves as with a limit of 55 °C ..."."""
    return behaves_like(*cause.changes)


def behaves_like(*changes: ChartChange) -> str:
    """What charts are like by changes; those that are like the same in one sentence."""
    charts: dict[str, list[str]] = {}
    for change in changes:
        charts.setdefault(change.chart, []).append(like(change))
    return "; ".join(_behave(names, told) for told, names in _alike(charts).items())


def _alike(charts: Mapping[str, Iterable[str]]) -> Mapping[tuple[str, ...], list[str]]:
    found: dict[tuple[str, ...], list[str]] = {}
    for chart, told in charts.items():
        found.setdefault(tuple(told), []).append(chart)
    return found


def _behave(names: Sequence[str], told: Iterable[str]) -> str:
    return f"{' and '.join(names)} {'behave' if len(names) > 1 else 'behaves'} {' and '.join(told)}"


def like(change: ChartChange) -> str:
    """One change, as what something behaves like."""
    if change.kind == "interpretation":
        return f"as under the interpretation {change.text}"
    word = "as with" if change.kind in WITH or change.text.startswith("a limit") else "as if"
    return f"{word} {change.text}"


def explained(part: DiagnosedPart) -> str:
    """The nearest cause, or what explains most, and how much that is."""
    if part.cause is not None:
        return f"{behaves(part.cause)}: explains {part.cases} of {_cases(part.cases)} in {_runs(part)}"
    if part.partial is None:
        return f"{part.name}: no change found for {_cases(part.cases)} in {_runs(part)}"
    number = part.partial.trial.explained
    some = f"explains {number or 'parts'} of {_cases(part.cases)} in {_runs(part)}"
    return f"{behaves(part.partial)}: {some}; no change found for the rest"


def _cases(number: int) -> str:
    return f"{number:,} case" if number == 1 else f"{number:,} cases"


def _runs(part: DiagnosedPart) -> str:
    number = len(part.runs)
    return f"{number} recording" if number == 1 else f"{number} recordings"


def inputs_told(run: DecidingRun) -> str:
    """The inputs of a run: "from power-up T = 57 for 201 steps, then T = 20 for 1 step"."""
    parts = []
    for block in run.blocks:
        changes = ", ".join(f"{name} = {value}" for name, value in block.changes) or "no change"
        parts.append(f"{changes} for {block.steps} step{'s' if block.steps > 1 else ''}")
    return f"from power-up {', then '.join(parts)}"


__all__ = ["behaves", "behaves_like", "explained", "inputs_told", "like"]
