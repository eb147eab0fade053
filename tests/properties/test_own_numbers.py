"""Properties state their own numbers: of a chart they take states and variables, never what it computes.

A formula, a limit or a table that a property takes from the chart it checks departs from the document
together with the chart, and the fault passes.
"""

import ast
import re
from collections.abc import Iterator
from importlib import import_module
from itertools import chain
from pathlib import Path
from types import ModuleType

import pytest

from rovercheck.spec_model.board1.wheels import monitor_wheel_FL
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.signals.board1 import has_no_feedback, v_ref
from rovercheck.spec_model.signals.board2 import SONARS, objDetected

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "properties"
STATES_NO_PROPERTY = {"properties/catalogue.py"}
MODULES = {p.relative_to(ROOT).as_posix() for p in FOLDER.rglob("*.py")} - STATES_NO_PROPERTY
VOCABULARY = ("rovercheck.spec_model.lang", "rovercheck.spec_model.ambiguity")


def faults(source: str) -> list[str]:
    """What a module takes from the model and must not, each with its reason."""
    tree = ast.parse(source)
    found: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            whole = [a.name for a in node.names if a.name.startswith("rovercheck.spec_model")]
            found += (f"{name}: import its names one by one" for name in whole)
        elif isinstance(node, ast.ImportFrom) and _of_the_model(node.module or ""):
            found += chain.from_iterable(_taken(node.module or "", alias, tree) for alias in node.names)
    return found


def _of_the_model(module: str) -> bool:
    parts = module.split(".")
    return parts[:2] == ["rovercheck", "spec_model"] and ".".join(parts[:3]) not in VOCABULARY


def _taken(module: str, alias: ast.alias, tree: ast.AST) -> Iterator[str]:
    if alias.name == "*":
        yield f"{module}: import its names one by one"
        return
    package = import_module(module)
    found = hasattr(package, alias.name)
    thing = getattr(package, alias.name) if found else import_module(f"{module}.{alias.name}")
    if isinstance(thing, ModuleType):
        yield from _used_of(thing, alias.asname or alias.name, tree)
    else:
        yield from _refused(module, alias.name, thing)


def _used_of(module: ModuleType, alias: str, tree: ast.AST) -> Iterator[str]:
    """A module as a whole may be imported where nothing is done with it but naming what it has."""
    named = [n for n in ast.walk(tree) if isinstance(n, ast.Attribute) and _is_name(n.value, alias)]
    for node in named:
        yield from _refused(module.__name__, node.attr, getattr(module, node.attr))
    if sum(_is_name(n, alias) for n in ast.walk(tree)) > len(named):
        yield f"{module.__name__} is a value: write {alias}.name"


def _is_name(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name


def _refused(module: str, name: str, thing: object) -> Iterator[str]:
    if isinstance(thing, Domain) and module.startswith("rovercheck.spec_model.signals"):
        return
    if not isinstance(thing, Chart | Var) and not _is_family(thing):
        kind = "formula" if isinstance(thing, Expr) else type(thing).__name__
        yield f"{module}.{name} is a {kind}: state it with its source"


def _is_family(thing: object) -> bool:
    """Variables that tell by their own names which is which, so that no order of theirs is believed."""
    if isinstance(thing, dict):
        return all(
            isinstance(v, Var) and (v.name.endswith(f"_{key}") or v.name.startswith(f"{key}."))
            for key, v in thing.items()
        )
    if isinstance(thing, tuple) and thing and all(isinstance(v, Var) for v in thing):
        one = thing[0].name
        numbered = [re.sub("1", str(i), one) for i in range(1, len(thing) + 1)]
        return "1" in one and [v.name for v in thing] == numbered
    return False


@pytest.mark.parametrize("module", sorted(MODULES))
def test_a_property_takes_states_and_variables_only(module: str) -> None:
    assert faults((ROOT / module).read_text(encoding="utf-8")) == []


def test_every_area_is_examined() -> None:
    assert len([m for m in MODULES if m.startswith("properties/areas/")]) > 25


@pytest.mark.parametrize(
    "source",
    [
        "from rovercheck.spec_model.board1.battery import critical_range",
        "from rovercheck.spec_model.board1.temperature import ok_range as fine",
        "from rovercheck.spec_model.board1.safety import critical",
        "from rovercheck.spec_model.board1.masks import COMPONENTS",
        "from rovercheck.spec_model.board2.actuation import LIMIT",
        "from rovercheck.spec_model.board2.monitors import silent",
        "from rovercheck.spec_model.board2.failure_check import check_board1, q",
        "from rovercheck.spec_model.board2.coherence import ring, hits",
        "from rovercheck.spec_model.composition.motors import motors_zero, zero_1",
        "from rovercheck.spec_model.signals.board2 import within",
        "from rovercheck.spec_model.signals.board2 import MEANING",
        "from rovercheck.spec_model.signals.board1 import WHEELS",
        "from rovercheck.spec_model.signals.board2_supervisor import BLE",
        "from rovercheck.spec_model.signals import board2\nnear = board2.within(70)",
        "from rovercheck.spec_model.signals import board1\nwheels = getattr(board1, 'WHEELS')",
        "from rovercheck.spec_model.composition import link as the_link\nmany = the_link.MANY",
        "from rovercheck.spec_model.board1.limits import *",
        "import rovercheck.spec_model.board1.safety",
        "import rovercheck.spec_model.board1.safety as safety\ncause = safety.critical",
        "def cause():\n    from rovercheck.spec_model.board1.safety import critical\n    return critical",
    ],
)
def test_what_a_chart_computes_is_refused(source: str) -> None:
    assert len(faults(source)) == 1


@pytest.mark.parametrize(
    "source",
    [
        "from rovercheck.spec_model.board1.battery import monitor_battery",
        "from rovercheck.spec_model.board2.coherence import ring, differs",
        "from rovercheck.spec_model.signals.common import COMMAND",
        "from rovercheck.spec_model.signals.board1 import v_ref, has_no_feedback",
        "from rovercheck.spec_model.signals import board2\nmoving = board2.B2Decision == 2",
        "from rovercheck.spec_model.lang.words import held\nfrom spec_model.ambiguity import choose",
        "from rovercheck.properties.document.distances import within",
    ],
)
def test_states_variables_and_domains_are_not_refused(source: str) -> None:
    assert faults(source) == []


def test_a_family_of_variables_says_which_is_which() -> None:
    assert _is_family(SONARS) and _is_family(objDetected) and _is_family(has_no_feedback)
    assert not _is_family(SONARS[::-1]), "sonar 3 under the number 1"
    assert not _is_family({"FL": has_no_feedback["FR"], "FR": has_no_feedback["FL"]})
    assert not _is_family((v_ref, v_ref)) and not _is_family((v_ref > 0,)) and not _is_family(())
    assert not _is_family((monitor_wheel_FL,))
