"""The table of the rules of Simulink and Stateflow: what pins each of them is there, and has what it says."""

import ast
import tomllib
from functools import cache
from pathlib import Path

import pytest

from tests.simulink.constructs import Row, has, rows_of
from tests.simulink.packages import PACKAGES

TESTS = Path(__file__).parents[1]
TABLE = tomllib.loads((Path(__file__).parent / "rules.toml").read_text(encoding="utf-8"))
RULES = {rule["id"]: rule for topic in TABLE["topic"] for rule in topic["rule"]}


@cache
def _tests_of(file: str) -> set[str]:
    """The tests of a file."""
    tree = ast.parse((TESTS / file).read_text(encoding="utf-8"))
    return {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Row]]:
    """What stands in each package."""
    return {name: rows_of(one(tmp_path_factory.mktemp(name))) for name, one in PACKAGES.items()}


def test_each_rule_has_a_name_and_what_pins_it() -> None:
    assert len(RULES) == sum(len(topic["rule"]) for topic in TABLE["topic"])
    for name, rule in RULES.items():
        assert rule.keys() <= {"id", "says", "packages", "has", "tests", "refused"}, name
        assert rule["says"].endswith("."), name
        assert bool(rule.get("packages")) == bool(rule.get("has")), name
        assert rule.get("tests") if "packages" not in rule else not rule.get("refused"), name


@pytest.mark.parametrize("name", RULES)
def test_the_tests_of_a_rule_are_there(name: str) -> None:
    for test in RULES[name].get("tests", []):
        file, _, function = test.partition("::")
        assert function.startswith("test_") and function in _tests_of(file), test


@pytest.mark.parametrize("name", [name for name, rule in RULES.items() if "packages" in rule])
def test_the_packages_of_a_rule_have_what_it_speaks_of(name: str, read: dict[str, list[Row]]) -> None:
    lacks = [
        (package, construct)
        for package in RULES[name]["packages"]
        for construct in RULES[name]["has"]
        if not has(read[package], construct)
    ]
    assert lacks == []


def test_each_package_pins_a_rule() -> None:
    named = {package for rule in RULES.values() for package in rule.get("packages", [])}
    assert PACKAGES.keys() - named == set()
