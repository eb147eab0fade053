"""What is in a box is named with it or alone, in both readings."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.drawn.charts import logged, note, running


def test_functions_and_states_in_boxes_are_named_with_the_box(tmp_path: Path) -> None:
    """Such a name was refused."""

    def draw(c: WrittenChart) -> None:
        box = c.state("Box", box=True)
        inner = c.state("Inside", box, box=True)
        c.function("y = f(x)", box, script="function y = f(x)\ny = 10 * x + Box.k;\nend\n")
        c.data("k", "local", "double", 3, holder=box)
        g = c.function("g", inner)
        c.transition(None, c.junction(g), f"{{{note(7)}}}", holder=g)
        one, other = c.state("A\ndu: log = Box.f(u);"), c.state("B\nen: Box.Inside.g;")
        c.transition(None, one)
        c.transition(one, other, "[Box.f(u) > 20]")

    assert logged(running(tmp_path, draw), [0, 1, 2]) == [0, 13, 137]


def test_states_and_events_in_boxes_are_named_with_the_box(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        box = c.state("Box", box=True)
        c.event("E", holder=box)
        one = c.state("One", box, order=1)
        a, b = c.state("A", one), c.state("B", one)
        c.transition(None, a)
        c.transition(a, b, "E")
        two = c.state("Two", order=2)
        x, y = c.state(f"X\ndu: send(Box.E, Box.One); {note(1)}", two), c.state(f"Y\nen: {note(2)}", two)
        c.transition(None, x)
        c.transition(x, y, "[in(Box.One.B)]")

    assert logged(running(tmp_path, draw, parallel=True), [0, 0, 0]) == [0, 1, 12]


def test_a_name_that_there_is_in_a_box_and_elsewhere_is_refused(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.data("k", "local", "double", 3, holder=c.state("Box", box=True))
        state = c.state("A\ndu: log = Box.k;")
        c.data("k", "local", "double", 4, holder=state)
        c.transition(None, state)

    said = "line 2, column 11: Box.k is in a box, and there are 2 of the name k in the chart: give each its"
    with pytest.raises(DrawnFault, match=said):
        running(tmp_path, draw)


def test_a_datum_with_the_name_of_a_box_is_a_datum(tmp_path: Path) -> None:
    """A bus may have the name of a box, and its elements are no names in the box."""

    def draw(c: WrittenChart) -> None:
        c.data("k", "local", "double", 3, holder=c.state("u", box=True))
        c.transition(None, c.state("A\ndu: log = u + k;"))

    assert logged(running(tmp_path, draw), [0, 1, 2]) == [0, 4, 5]
