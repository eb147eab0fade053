"""What an action would still do is dropped once an event has had its state left, in both readings."""

from pathlib import Path

import pytest

from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.drawn.charts import logged, note, running

LEAVES = f"{note(1)} E; {note(2)}"
"""An action whose event has the state left, to Z, which notes 3."""


def test_a_during_action_that_has_its_state_left_is_the_last_one(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        a, z = c.state(f"A\ndu: if u == 1, {LEAVES} end; {note(5)}"), c.state(f"Z\nen: {note(3)}")
        k = c.state(f"K\ndu: {note(4)}", a)
        c.transition(None, a)
        c.transition(None, k)
        c.transition(a, z, "E")

    assert logged(running(tmp_path, draw), [0, 0, 1]) == [0, 54, 5413]


def test_an_on_section_that_has_its_state_left_is_the_last_one(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        c.event("F")
        a = c.state(
            f"A\ndu: if u == 1, u1 = u1 + 1; if u1 == 1, send(F, A); {note(5)} end; end\non F: {LEAVES}"
        )
        z = c.state(f"Z\nen: {note(3)}")
        c.data("u1", "local", "uint8")
        c.transition(None, a)
        c.transition(a, z, "E")

    assert logged(running(tmp_path, draw), [0, 1]) == [0, 13]


@pytest.mark.parametrize("inner", [True, False])
def test_a_condition_action_inside_that_has_its_state_left_drops_the_path(
    tmp_path: Path, inner: bool
) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        a, z = c.state(f"A\nex: {note(6)}"), c.state(f"Z\nen: {note(3)}")
        k = c.state(f"K\nen: {note(4)}", a)
        c.transition(None, a)
        c.transition(None, k)
        c.transition(a, z, "E")
        c.transition(a, k, f"[u == 1]{{{LEAVES}}}", 1 if inner else 2, inner=inner)

    assert logged(running(tmp_path, draw), [0, 1]) == [4, 4163]


@pytest.mark.parametrize("text", [f"{{{LEAVES}}}", f"/{LEAVES}"])
def test_an_action_of_a_default_transition_that_has_its_state_left_drops_the_path(
    tmp_path: Path, text: str
) -> None:
    def draw(c: WrittenChart) -> None:
        c.event("E")
        p, z = c.state("P"), c.state(f"Z\nen: {note(3)}")
        c.transition(None, p)
        c.transition(None, c.state(f"K\nen: {note(4)}", p), text)
        c.transition(p, z, "E")

    assert logged(running(tmp_path, draw), [0, 0]) == [13, 13]


def test_a_transition_ends_where_its_scope_was_left_and_entered_again(tmp_path: Path) -> None:
    """What is around it is active, but so is a state in that: B is not entered as a second one."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        s = c.state("S")
        a, b = c.state(f"A\nen: {note(3)}", s), c.state(f"B\nen: {note(2)}", s)
        c.transition(None, s)
        c.transition(None, a)
        c.transition(a, b, f"[u == 1] / {note(1)} E; {note(4)}")
        c.transition(s, s, "E")

    assert logged(running(tmp_path, draw), [0, 1, 1]) == [3, 313, 31313]


def test_a_region_is_not_entered_once_what_is_around_it_was_left(tmp_path: Path) -> None:
    """The event is sent in a function, which goes on to its end."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        p, z = c.state("P", parallel=True), c.state(f"Z\nen: {note(3)}")
        regions = [c.state(f"R1\nen: {note(1)} f();", p, order=1), c.state(f"R2\nen: {note(2)}", p, order=2)]
        f = c.function("f()")
        c.transition(None, c.junction(f), "{E;}", holder=f)
        c.transition(None, p)
        c.transition(p, z, "E")
        assert len(regions) == 2

    assert logged(running(tmp_path, draw), [0, 0]) == [13, 13]


def put(digit: int) -> str:
    """An action in C that notes a digit."""
    return f"log = log * 10 + {digit};"


def test_an_event_of_an_exit_action_in_c_is_answered_by_the_state_that_is_left(tmp_path: Path) -> None:
    """It is left once more by itself, and what the first exit still had to do is dropped."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        c.data("n", "local", "uint8")
        a = c.state(f"A\nex: n++; log = log * 10 + n; E; {put(9)}")
        b, z = c.state(f"B\nen: {put(4)}"), c.state(f"Z\nen: {put(5)}")
        c.transition(None, a)
        c.transition(a, z, "E[n == 1]", 1)
        c.transition(a, b, "[u > 0 && n == 0]", 2)

    found = running(tmp_path, draw, {"u": "uint8"}, {"log": "uint32"}, language="C")
    assert logged(found, [0, 1, 1]) == [0, 1295, 1295]


def test_an_event_of_an_exit_action_in_c_is_answered_before_the_action_goes_on(tmp_path: Path) -> None:
    """By another region, while the state that sends it is still active."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        c.data("n", "local", "uint8")
        s, t = c.state("S", order=1), c.state("T", order=2)
        a, b = c.state(f"A\nex: {put(1)} E; {put(2)}", s), c.state(f"B\nen: {put(4)}", s)
        k, m = c.state("K", t), c.state(f"M\nen: {put(3)}", t)
        c.transition(None, a)
        c.transition(None, k)
        c.transition(a, b, "[u > 0 && n == 0]{n = 1;}")
        c.transition(k, m, "E[in(S.A)]")

    found = running(tmp_path, draw, {"u": "uint8"}, {"log": "uint32"}, language="C", parallel=True)
    assert logged(found, [0, 1]) == [0, 1324]
