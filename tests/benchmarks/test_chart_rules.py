"""The rules that are broken on purpose: each is still written in its module as they say."""

import ast
from pathlib import Path

import pytest

from benchmarks.chart_rules import READINGS, TABLE, BrokenRule, broken, rules, written
from benchmarks.edits import ROOT


@pytest.mark.parametrize("rule", rules(), ids=lambda rule: f"{rule.reading}-{rule.name}")
def test_a_rule_is_written_once_in_its_module(rule: BrokenRule) -> None:
    text = (ROOT / READINGS[rule.reading].folder / f"{rule.module}.py").read_text(encoding="utf-8")
    assert text.count(rule.before) == 1
    assert rule.before != rule.after
    ast.parse(text.replace(rule.before, rule.after))


def test_no_two_rules_have_one_name() -> None:
    names = [rule.name for rule in rules()]
    assert len(names) == len({*names})


def test_the_tests_that_noticed_rules_are_there() -> None:
    for file, _, name in {rule.noticed_by.partition("::") for rule in rules() if rule.noticed_by}:
        text = (ROOT / file).read_text(encoding="utf-8")
        assert f"def {name.rpartition('::')[2]}(" in text, f"{file} has no {name}; write the table anew"


def test_the_table_is_written_with_them_and_is_else_as_it_was() -> None:
    table = TABLE.read_text(encoding="utf-8")
    one = rules()[0]
    new = written(table, {one.name: "tests/some.py::test_it"})
    lines = set(new.splitlines()) - set(table.splitlines())
    assert lines == {'noticed_by = "tests/some.py::test_it"'}
    assert written(new, {}) == new == written(new, {one.name: "the tests do not end"})


@pytest.mark.parametrize(
    ("known", "after", "noticed"),
    [
        ("", "False", "test_it.py::test_one"),
        ("test_it.py::test_two", "False", "test_it.py::test_two"),
        ("test_it.py::test_gone", "False", "test_it.py::test_one"),
        ("test_it.py::test_three", "False", "test_it.py::test_one"),
        ("", "1", ""),
        ("test_it.py::test_two", "1", ""),
    ],
)
def test_a_rule_is_noticed_by_the_known_test_or_by_another(
    known: str, after: str, noticed: str, tmp_path: Path
) -> None:
    """Every rule that no test was noted for was told as unnoticed."""
    folder = tmp_path / READINGS["interpret"].folder
    folder.mkdir(parents=True)
    module, tests = folder / "rule.py", tmp_path / "test_it.py"
    module.write_text("HOLDS = True\n", encoding="utf-8")
    tests.write_text(
        f"import sys\nsys.path.insert(0, {str(folder)!r})\nfrom rule import HOLDS\n"
        "def test_one(): assert HOLDS\ndef test_two(): assert HOLDS\ndef test_three(): pass\n",
        encoding="utf-8",
    )
    rule = BrokenRule("a rule", "rule", "True", after, noticed_by=known)
    assert broken(tmp_path, rule, [tests.name]) == noticed
    assert module.read_text(encoding="utf-8") == "HOLDS = True\n"
