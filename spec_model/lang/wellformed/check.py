"""The checks in order; all faults of a chart are reported together."""

from collections.abc import Iterator
from weakref import WeakValueDictionary

from rovercheck.spec_model.lang.chart import Chart, parts
from rovercheck.spec_model.lang.domain import Bool, fixed
from rovercheck.spec_model.lang.errors import ModelError, with_article
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import TICK_MS, System, enabled_in
from rovercheck.spec_model.lang.wellformed.data import chart_data_faults, system_data_faults
from rovercheck.spec_model.lang.wellformed.paths import path_faults
from rovercheck.spec_model.lang.wellformed.sends import send_faults
from rovercheck.spec_model.lang.wellformed.tree import junction_cycle_faults, target_faults, tree_faults
from rovercheck.spec_model.lang.wellformed.words import block_word_faults, no_words, word_faults


def check_chart(chart: Chart, tick_ms: int = TICK_MS) -> None:
    """Raises ``ModelError`` with one line for each fault of the chart, and more below those of labels."""
    _raise(iter(chart.label_faults))
    _raise(f"{chart.name}: {fault}" for fault in _chart_faults(chart, tick_ms))


def check_system(system: System) -> None:
    """Raises ``ModelError`` with one line for each fault of the system and of its charts."""
    if _SOUND.get(id(system)) is system:
        return
    _raise(fault for chart in system.charts for fault in chart.label_faults)
    faults: list[str] = []
    for chart in system.charts:
        faults += [f"{chart.name}: {fault}" for fault in _chart_faults(chart, system.step_ms)]
    for block in system.blocks:
        faults += [f"{block.name}: {fault}" for fault in block_word_faults(block)]
    if not faults:
        faults = [f"{system.name}: {fault}" for fault in _system_faults(system)]
    _raise(iter(faults))
    _SOUND[id(system)] = system


_SOUND: WeakValueDictionary[int, System] = WeakValueDictionary()
"""Systems in which no fault was found; they never change, so nobody need look again."""


def _chart_faults(chart: Chart, tick_ms: int) -> list[str]:
    """Later checks rely on earlier ones, so they run only where those found nothing."""
    if isinstance(chart, ProgrammedChart):
        return []
    found = list(tree_faults(chart)) or list(target_faults(chart)) or list(junction_cycle_faults(chart))
    if found:
        return found
    checks = (path_faults(chart), send_faults(chart), word_faults(chart, tick_ms), chart_data_faults(chart))
    return list(dict.fromkeys(fault for check in checks for fault in check))


def _system_faults(system: System) -> Iterator[str]:
    yield from _length_faults(system)
    yield from _elapsed_faults(system)
    yield from _name_faults(system)
    conditions = [(f"the enable `{e.by}`", e.by) for e in enabled_in(system.components)]
    conditions += [
        (f"the assumption `{f}`", f) for f in (system.assume, *(a.formula for a in system.assumptions))
    ]
    faults = [fault for what, condition in conditions for fault in _condition_faults(what, condition)]
    yield from faults or system_data_faults(system)


def _length_faults(system: System) -> Iterator[str]:
    lengths = {system.step_ms: "step_ms", system.tick_ms: "tick_ms"}
    wrong = [f"{name}={length}" for length, name in lengths.items() if length < 1]
    for one in wrong:
        yield f"{one} is no length of time; write whole milliseconds, at least 1."
    if not wrong and system.step_ms % system.tick_ms:
        yield (
            f"step_ms={system.step_ms} is no multiple of tick_ms={system.tick_ms}; charts execute in ticks "
            "only, write a multiple of one."
        )


def _elapsed_faults(system: System) -> Iterator[str]:
    elapsed = system.elapsed
    if elapsed is None:
        return
    if elapsed.sort != fixed(0, 1, 1, "ms").sort or elapsed.domain.low < 1:
        yield f"elapsed={elapsed} is {elapsed.domain}; write whole milliseconds, at least 1."
    if elapsed.name in system.written:
        yield f"elapsed={elapsed} is written by a component; it must be an input, or frozen."


def _condition_faults(what: str, condition: Expr) -> Iterator[str]:
    if not isinstance(condition.sort, Bool):
        yield f"{what} is {with_article(condition.sort)}; write a condition, such as a comparison."
    yield from no_words(what, condition)


def _name_faults(system: System) -> Iterator[str]:
    seen: set[str] = set()
    for part in parts(system.components):
        if part.name in seen:
            yield f"two components are named {part.name!r}; give each its own name."
        seen.add(part.name)
    for what, names in (
        ("frozen variables are named", [v.name for v in system.frozen]),
        ("assumptions have the id", [a.id for a in system.assumptions]),
    ):
        for name in {name: None for name in names if names.count(name) > 1}:
            yield f"{names.count(name)} {what} {name}; name each once."


def _raise(faults: Iterator[str]) -> None:
    lines = list(faults)
    if lines:
        raise ModelError("\n".join(lines))
