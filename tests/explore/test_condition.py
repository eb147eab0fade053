"""Conditions as people type them: read as meant, or refused with what to write; never executed."""

import pytest

from rovercheck.checker.explore.by_hand.condition import condition
from rovercheck.checker.explore.by_hand.names import Names
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import flag, var
from tests.render import zoo

NAMES = Names({**zoo.VARIABLES, "level": zoo.level}, {"Relay": zoo.relay, "Nested": zoo.nested})
AT = {"Relay": 2, "level": 150, "speed": -5, "alarm": 1, "mode": 1, "Relay.Theirs.duration1": 7}
AGES = {"B2-B1.age": 3, "B2-B1.older.age": 4}


@pytest.mark.parametrize(
    ("written", "true"),
    [
        ("Relay.Theirs", True),
        ("Relay.Ours or alarm", True),
        ("Relay.Theirs and not alarm", False),
        ("level > 100", True),
        ("100 < level <= 150", True),
        ("mode == CRITICAL", True),
        ("SAFE == mode", False),
        ("mode != 'SAFE'", True),
        ("speed == -0.5", True),
        ("speed + 1 > 0.4 and 1 < 2", True),
        ("level - 50 == 100", True),
        ("alarm == true", True),
        ("Relay == Theirs", True),
        ("Relay.Theirs.duration1 >= 7", True),
        ("level > 200 || !(alarm && mode == SAFE)", True),
    ],
)
def test_a_condition_means_what_it_says(written: str, true: bool) -> None:
    assert bool(evaluate(condition(written, NAMES), AT)) is true


@pytest.mark.parametrize(
    ("written", "true"),
    [
        ("B2-B1.arrives", True),
        ("not B2-B1.arrives or level > 100", True),
        ("B2-B1.age - 2 == 1 and level-50 == 100", True),
        ("B2-B1.older.age==B2-B1.age", False),
        ("(B2-B1.age<level)", True),
    ],
)
def test_a_name_with_a_hyphen_is_no_difference(written: str, true: bool) -> None:
    link = {v.name: v for v in (flag("B2-B1.arrives"), *(var(n, integer(0, 900)) for n in AGES))}
    names = Names({**NAMES.variables, **link}, NAMES.charts)
    at = AT | {"B2-B1.arrives": 1, **AGES}
    assert bool(evaluate(condition(written, names), at)) is true
    with pytest.raises(RefusedInput, match=r"`B2-B1.arrives \*\* 2` has no meaning"):
        condition("B2-B1.arrives ** 2", names)
    with pytest.raises(RefusedInput, match=r"no variable or state 'B2'. Known: B2-B1.age, B2-B1.arrives, "):
        condition("B2-B1.arives", names)


def test_names_that_differ_in_an_operator_alone_are_told_apart() -> None:
    mode = enumeration("Mode", ["A-B", "C"])
    odd = [var("a-b", integer(0, 9)), var("a+b", integer(0, 9)), flag("µ-b"), var("A-B", mode)]
    names = Names({v.name: v for v in odd}, {})
    at = {"a-b": 1, "a+b": 2, "µ-b": 1, "A-B": 0}
    assert evaluate(condition("a-b == 1 and a+b == 2 and µ-b and A-B == 'A-B'", names), at)
    with pytest.raises(RefusedInput, match=r"`a\+b \*\* 2` has no meaning"):
        condition("a+b ** 2", names)


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("", "is no condition"),
        ("level >", "is no condition"),
        ("level = 3", "is no condition"),
        ("levle > 3", "Did you mean 'level'"),
        ("Relay.Their", "no state 'Their'.*Did you mean"),
        ("Relay and alarm", "condition, such as a comparison"),
        ("Nested", "is a chart; write one of its states, such as Nested.Run"),
        (
            "level",
            "neither true nor false .*compare it. Write a state .Relay.Ours., a comparison .level > 0.,",
        ),
        ("level > 1e999", "`1e309` has no meaning"),
        ("-1e999 < level", "has no meaning"),
        ("mode == LOUD", "no member of Mode"),
        ("mode < CRITICAL", "has no order"),
        ("level == speed", "mixes"),
        ("level in speed", "have no meaning"),
        ("__import__('os').system('true')", "has no meaning in a condition"),
        ("[x for x in level]", "has no meaning in a condition"),
        ("level if alarm else speed", "has no meaning"),
        ("level ** 2 > 3", "has no meaning"),
        ("(" * 500 + "alarm" + ")" * 500, "no condition|nested too deeply"),
        ("not " * 3000 + "alarm", "no condition|nested too deeply"),
    ],
)
def test_what_has_no_meaning_is_refused(written: str, said: str) -> None:
    with pytest.raises(RefusedInput, match=said):
        condition(written, NAMES)
