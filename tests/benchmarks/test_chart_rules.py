"""The rules that are broken on purpose: each is still written in its module as they say."""

import pytest

from benchmarks.chart_rules import READINGS, BrokenRule, rules
from benchmarks.edits import ROOT


@pytest.mark.parametrize("rule", rules(), ids=lambda rule: f"{rule.reading}-{rule.name}")
def test_a_rule_is_written_once_in_its_module(rule: BrokenRule) -> None:
    text = (ROOT / READINGS[rule.reading].folder / f"{rule.module}.py").read_text(encoding="utf-8")
    assert text.count(rule.before) == 1
    assert rule.before != rule.after


def test_no_two_rules_have_one_name() -> None:
    names = [rule.name for rule in rules()]
    assert len(names) == len({*names})
