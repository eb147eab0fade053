"""Goals for conditions that decide (MC/DC): against a definition by trial, and what their tests find."""

import subprocess
import sys
from collections.abc import Iterator
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.cli import run
from rovercheck.checker.results.exit_code import Exit
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.sides import deciding_sides
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.replay import first_reached
from rovercheck.checker.testgen.scripts import steps
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Expr, Named, flag, ite, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.words import named
from tests.model_files.files import BASELINE, FIRMWARE, HEATER
from tests.testgen.cover_toys import TOY

P, Q = flag("p"), flag("q")
X = var("x", integer(0, 3))
CONDITIONS = {
    "p": P, "q": Q, "x < 2": X < 2, "x <= 2": X <= 2, "x > 1": X > 1, "x >= 1": X >= 1, "x == 1": X == 1,
}  # fmt: skip
BESIDE = {"x < 2": (1, 2), "x <= 2": (2, 3), "x > 1": (1, 2), "x >= 1": (0, 1), "x == 1": (0, 1, 2)}
"""The values of x on both sides of the limit, written down by hand."""
decisions = st.recursive(
    st.sampled_from(list(CONDITIONS.values())),
    lambda inner: st.one_of(
        inner.map(lambda a: ~a),
        st.tuples(inner, inner).map(lambda two: two[0] & two[1]),
        st.tuples(inner, inner).map(lambda two: two[0] | two[1]),
        st.tuples(inner, inner, inner).map(lambda three: ite(*three)),
        inner.map(lambda a: named("so", a)),
    ),
    max_leaves=5,
)


def states() -> Iterator[dict[str, int]]:
    for p, q, x in product((0, 1), (0, 1), range(4)):
        yield {"p": p, "q": q, "x": x}


def by_trial(decision: Expr, condition: Expr, at: dict[str, int]) -> bool:
    """Whether the decision is another one where the condition is given each truth by hand."""

    def decided(expr: Expr, truth: bool) -> bool:
        if str(expr) == str(condition):
            return truth
        match expr:
            case Named(_, body):
                return decided(body, truth)
            case Apply(Op.NOT, (one,), _):
                return not decided(one, truth)
            case Apply(Op.AND, args, _):
                return all(decided(arg, truth) for arg in args)
            case Apply(Op.OR, args, _):
                return any(decided(arg, truth) for arg in args)
            case Apply(Op.ITE, (chosen, then, other), _):
                return decided(then if decided(chosen, truth) else other, truth)
        return bool(evaluate(expr, at))

    return decided(decision, True) != decided(decision, False)


@given(decisions)
def test_a_condition_decides_where_the_decision_changes_with_it(decision: Expr) -> None:
    sides = list(deciding_sides(decision, 20))
    for said, condition in CONDITIONS.items():
        mine = [
            s
            for s in sides
            if s.text.startswith((f"{said} true", f"{said} false", f"{said} just", f"{said} at"))
        ]
        if not mine:
            continue
        for at in states():
            beside = said not in BESIDE or at["x"] in BESIDE[said]
            met = any(evaluate(side.condition, at) for side in mine)
            assert met == (beside and by_trial(decision, condition, at)), (said, at)


def test_each_condition_in_a_decision_has_its_sides_once() -> None:
    texts = [side.text for side in deciding_sides((P & (X < 2)) | (Q & P), 20)]
    assert texts == [
        "p true and decides", "p false and decides", "x < 2 just below and decides",
        "x < 2 at it and decides", "q true and decides", "q false and decides",
    ]  # fmt: skip
    assert not [side for side in deciding_sides(X + 1, 20)]


def test_a_limit_does_not_count_where_another_condition_decides() -> None:
    looked = watched(TOY.system, [GoalKind.CONDITIONS])
    texts = {goal.id: goal.text for goal in looked.goals}

    def met(*presses: int) -> list[str]:
        script = tuple({"press": bool(press), "light_lx": 10} for press in presses)
        return [texts[id] for id in first_reached(TOY, looked, steps(TOY, script))]

    assert not [text for text in met(0, 0) if text.startswith("light_lx < 10")], "the button decides"
    assert [text for text in met(0, 1) if text.startswith("light_lx < 10 at it and decides")]


FAULTS = (
    ("warm < 18", "warm < 17"),
    ("warm < 18", "warm < 19"),
    ("18 and not door", "18"),
    ("warm > self.limit", "warm > self.limit - 1"),
    ("warm > self.limit", "warm > self.limit + 1"),
    ("self.steps >= 500", "self.steps >= 499"),
    ("self.steps >= 500", "self.steps >= 501"),
    ("self.steps >= self.rest", "self.steps >= self.rest - 1"),
    ("self.steps >= self.rest", "self.steps >= self.rest + 1"),
)


def test_every_limit_that_is_wrong_by_one_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "heater.py").write_text(HEATER, encoding="utf-8")
    (tmp_path / "baseline.toml").write_text(BASELINE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    made = ["--cover", "conditions", "--format", "pytest", "-o", "made"]
    assert run(["generate-tests", "--model", "heater.py", *made]) is Exit.AS_EXPECTED
    assert "conditions 12: 12 covered" in capsys.readouterr().out
    for number, (is_, other) in enumerate((("", ""), *FAULTS)):
        assert not is_ or FIRMWARE.count(is_) == 1
        firmware = tmp_path / f"firmware_{number}.py"
        firmware.write_text(FIRMWARE.replace(is_, other), encoding="utf-8")
        monkeypatch.setenv("ROVERCHECK_IMPL", f"python:{firmware.name}:Heater")
        command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "made"]
        code = subprocess.run(command, capture_output=True, check=False).returncode
        assert code == (1 if is_ else 0), other


def test_kept_tests_have_no_goals_of_that_kind(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for word in (["--kept"], ["--keep", str(tmp_path)]):
        assert run(["generate-tests", "--cover", "conditions", *word]) is Exit.USAGE
        assert "leave --cover conditions out" in " ".join(capsys.readouterr().err.split())
    assert not list(tmp_path.iterdir())
