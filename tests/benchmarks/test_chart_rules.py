"""The rules that are broken on purpose: each is still written in its module as they say."""

import pytest

from benchmarks.chart_rules import READINGS, TABLE, BrokenRule, rules, written
from benchmarks.edits import ROOT


@pytest.mark.parametrize("rule", rules(), ids=lambda rule: f"{rule.reading}-{rule.name}")
def test_a_rule_is_written_once_in_its_module(rule: BrokenRule) -> None:
    text = (ROOT / READINGS[rule.reading].folder / f"{rule.module}.py").read_text(encoding="utf-8")
    assert text.count(rule.before) == 1
    assert rule.before != rule.after


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
    assert written(new, {}) == new
