"""Numbers that are computed from an input in every step, in both readings."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.spec_model.lang.domain import fixed
from tests.drawn.charts import logged, note, running

MATLAB: Sequence[tuple[str, Sequence[float], Sequence[float]]] = (
    ("mod(u, -3)", (4, -4, 3), (-2, -1, 0)), ("mod(u, 3)", (4, -4, 3), (1, 2, 0)),
    ("mod(u, 0)", (4, -4), (4, -4)), ("rem(u, 3)", (4, -4), (1, -1)), ("ceil(u / 2)", (2, 3, -3), (1, 2, -1)),
    ("floor(u / 2)", (3, -3), (1, -2)),
    ("fix(u / 2)", (3, -3), (1, -1)), ("round(u / 2)", (3, -3, 4), (2, -2, 2)),
    ("double(int8(u / 2))", (3, -3, 300), (2, -2, 127)), ("sign(u)", (3, 0, -3), (1, 0, -1)),
    ("abs(u)", (3, -3), (3, 3)), ("double(int8(u) + int8(100))", (-100, 100), (0, 127)),
    ("double(abs(int8(u)))", (-128,), (127,)), ("double(int8(100) * 0.3 + int8(u))", (1,), (31,)),
    ("double(int8(u) / 0)", (2, 0, 0), (127, 0, 0)), ("double(bitshift(uint8(u), 1))", (200, 3), (144, 6)),
    ("double(bitshift(uint8(u), -2))", (200, 3), (50, 0)), ("double(bitcmp(uint8(u)))", (1, 0), (254, 255)),
    ("double(bitxor(uint8(u), 3))", (6,), (5,)), ("double(bitget(uint8(u), 3))", (4, 3), (1, 0)),
    ("double(bitset(uint8(u), 2))", (2, 5), (2, 7)), ("double(any([u 0]))", (3, 0), (1, 0)),
    ("double(all([u 1]))", (3, 0), (1, 0)), ("sum(ones(1, 3)) + u", (1,), (4,)),
    ("double(isequal([u 1], [2 1]))", (2, 3), (1, 0)), ("double(isequal([u 1], 2))", (2,), (0,)),
    ("double(u > 0) + (u > 1)", (2, 1), (2, 1)), ("double(in(A))", (2, 1), (1, 1)),
    ("double(uint8(u) * 0 < 0)", (3, 0), (0, 0)),
)  # fmt: skip


@pytest.mark.parametrize(("text", "given", "expected"), MATLAB)
def test_what_is_computed_in_every_step_is_as_in_matlab(
    tmp_path: Path, text: str, given: Sequence[float], expected: Sequence[float]
) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state(f"A\nen, du: log = {text};"))

    assert logged(running(tmp_path, draw), given) == list(expected)


C: Sequence[tuple[str, Sequence[float], Sequence[float]]] = (
    ("g / 2", (3, -3), (1, -1)), ("(k + h) / 2", (100, 20), (178, 138)), ("g + k > 0", (-1, 1), (1, 1)),
    ("h = u", (2.5, -2.5), (2, -2)), ("7 / 2 + u", (1,), (4,)), ("list[u]", (0, 1), (4, 6)),
    ("-7 %% 4 + u", (5,), (2,)),
)  # fmt: skip


@pytest.mark.parametrize(("text", "given", "expected"), C)
def test_what_is_computed_in_every_step_is_as_in_c(
    tmp_path: Path, text: str, given: Sequence[float], expected: Sequence[float]
) -> None:
    """Of integers the larger type, the unsigned one of two that are as large, and cut towards 0."""

    def draw(c: WrittenChart) -> None:
        c.data("g", "local", "int8")
        c.data("k", "local", "uint8")
        c.data("h", "local", "int16", 256)
        c.data("list", "local", "int8", "[4 6]", "[1 2]")
        done = f"{text}; log = h;" if text.startswith("h =") else f"log = {text};"
        c.transition(None, c.state(f"A\nen, du: g = u; k = u; {done}"))

    assert logged(running(tmp_path, draw, language="C", saturates=False), given) == list(expected)


def test_integers_of_two_types_are_refused_in_matlab(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state("A\nen: log = double(int8(u) + int16(u));"))

    model = running(tmp_path, draw).model
    with pytest.raises(NotLowered, match="MATLAB takes integers of one type only"):
        lowered_model(model, "one.slx", {"u": fixed(0, 1, 1)})


@pytest.mark.parametrize(
    ("condition", "u", "holds"), [("u", -1, 1), ("u", 0, 0), ("[u 0]", 1, 0), ("[u 1]", 1, 1)]
)
def test_a_number_is_a_condition_where_it_is_not_0_and_a_matrix_where_all_are(
    tmp_path: Path, condition: str, u: float, holds: float
) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state(f"A\nen: if {condition}, log = 1; end"))

    assert logged(running(tmp_path, draw), [u]) == [holds]


def test_an_action_of_a_default_transition_is_done(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state(f"A\nen: {note(2)}"), f"/{note(1)}")

    assert logged(running(tmp_path, draw), [0, 0]) == [12, 12]


@pytest.mark.parametrize(
    ("guard", "steps"),
    [("after(300000, usec)", 3), ("temporalCount(E) >= 2", 4), ("temporalCount(sec) >= 0.3", 3)],
)
def test_times_have_their_units(tmp_path: Path, guard: str, steps: int) -> None:
    """An event is sent in every other step."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        first = c.state("S\ndu: if u == 1, send(E, T); end", order=1)
        t = c.state("T", order=2)
        a, b = c.state("A", t), c.state(f"B\nen: {note(1)}", t)
        c.transition(None, a)
        c.transition(a, b, f"[{guard}]")
        assert first

    assert logged(running(tmp_path, draw, parallel=True), [0, 1, 0, 0, 1, 0]).index(1) == steps


def test_a_change_is_one_of_the_start_of_a_step(tmp_path: Path) -> None:
    """What an action assigns changes at the start of the step after it."""

    def draw(c: WrittenChart) -> None:
        c.data("x", "local", "int8")
        c.transition(
            None, c.state("A\ndu: log = double(hasChanged(x)); x = int8(u); log = log + 2 * hasChanged(x);")
        )

    assert logged(running(tmp_path, draw), [0, 1, 1, 2, 2, 2]) == [0, 0, 3, 0, 3, 0]
