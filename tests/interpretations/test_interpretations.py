"""Figures alone in their files, and beside them what each other choice of an interpretation changes."""

import ast
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import pytest

from rovercheck.spec_model.abstraction.board1 import BOARD1
from rovercheck.spec_model.abstraction.board2 import BOARD2
from rovercheck.spec_model.ambiguity import ambiguities, fixed
from rovercheck.spec_model.board1.temperature import T, monitor_temperature
from rovercheck.spec_model.interpretations import Alternative, alternative, alternatives, name_of, woven
from rovercheck.spec_model.lang.change import formula, guards
from rovercheck.spec_model.lang.chart import Component, Enabled, parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import FALSE, TRUE
from rovercheck.spec_model.lang.merge import Merge
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import BOARDS, _systems_of
from tests.interpretations.test_board2 import FIVE_DEGREES

ROOT = Path(__file__).parents[2] / "spec_model"
FIGURES = [f for board in ("board1", "board2") for f in sorted((ROOT / board).glob("*.py"))]
DRAWN = [system for module in BOARDS for system in _systems_of(module).values()]


@pytest.mark.parametrize("file", FIGURES, ids=lambda f: f"{f.parent.name}/{f.stem}")
def test_a_chart_file_is_the_figure(file: Path) -> None:
    """Systems put charts together, and free their timers once the alternatives are woven in."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    called = {n.func.id for n in ast.walk(tree) if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)}
    assert called.isdisjoint({"choose", "under"})
    imported = {n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
    assert "rovercheck.spec_model.ambiguity" not in imported
    assert file.stem.endswith("systems") or not any("interpretations" in str(name) for name in imported)


@cache
def woven_parts() -> list[tuple[System, set[str]]]:
    """Every system with the names of its parts, those that alternatives bring and of subsystems included."""
    found = [(system, woven(system).components) for system in DRAWN]
    return [(system, set(map(name_of, every(components)))) for system, components in found]


def every(components: Sequence[Component]) -> Iterator[Component]:
    for component in components:
        yield component
        if isinstance(component, Enabled):
            yield from every(component.components)


@pytest.mark.parametrize(
    "one", alternatives(), ids=lambda one: f"{one.interpretation}-{one.choice}-{one.part}"
)
def test_every_alternative_has_a_part_to_change(one: Alternative) -> None:
    """Weaving has refused those that change nothing in theirs."""
    assert any(one.among(system) and one.part in names for system, names in woven_parts())


@pytest.mark.parametrize("id", [id for id, one in ambiguities().items() if one.scope in ("M", "MP")])
def test_every_choice_changes_a_chart_or_what_is_around_it(id: str) -> None:
    one = ambiguities()[id]
    other = {c for c in one.choices if c not in one.not_modelled and c != one.default}
    by_chart = {alternative.choice for alternative in alternatives() if alternative.interpretation == id}
    around = any(id in system.inputs for system in DRAWN)
    assert other <= by_chart or around


@pytest.mark.parametrize("system", [BOARD1.system, BOARD2.system, FIVE_DEGREES], ids=lambda s: s.name)
def test_the_defaults_leave_the_figure(system: System) -> None:
    """Woven in and fixed, no alternative leaves a trace."""
    as_read = fixed({})
    left, drawn = as_read.system(woven(system)).components, as_read.system(system).components
    pairs = list(zip(parts(left), parts(drawn), strict=True))
    assert pairs and all(Merge(TRUE).components(one, other) == (other,) for one, other in pairs)
    assert woven(system, {"S14": "GT"}) is system


def test_what_is_woven_stays_as_it_is() -> None:
    once = woven(FIVE_DEGREES)
    assert woven(once).components == once.components


def test_an_alternative_that_does_not_fit_says_where_it_is_written() -> None:
    gone = alternative("S14", "GE", "No such limit.", "Monitor_temperature", formula(T > 500, FALSE))
    with pytest.raises(ModelError) as refused:
        gone.applied(monitor_temperature)
    line = gone.place.line if gone.place else 0
    assert str(refused.value) == (
        f"tests/interpretations/test_interpretations.py:{line}: S14=GE does not fit. "
        "Monitor_temperature has no formula `temperature_degC > 500` any more. "
        "Write what it changes for the chart as it is now."
    )


def test_an_alternative_that_changes_nothing_is_refused() -> None:
    kept = guards("decide", "Temp_OK", lambda g: g)
    same = alternative("S14", "GE", "As it is.", "Monitor_temperature", kept)
    with pytest.raises(ModelError, match=r"test_interpretations\.py:\d+: S14=GE changes nothing in Monitor_"):
        same.applied(monitor_temperature)
