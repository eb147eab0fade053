"""Executions, paths, entering and leaving, history: models by hand."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.simulink.by_hand.models import ByHand, Given, Told, one_chart, tell


def _order(c: WrittenChart) -> None:
    a, b = c.state(f"A\nen: {tell(1)}\ndu: {tell(2)}\nex: {tell(3)}"), c.state(f"B\nen: {tell(4)}")
    k = c.state(f"K\nen: {tell(5)}\ndu: {tell(6)}\nex: {tell(7)}", a)
    m = c.state(f"M\nen: {tell(8)}\ndu: {tell(9)}\nex: {tell(10)}", a)
    c.transition(None, a)
    c.transition(None, k)
    c.transition(a, b, f"[u == 1]{{{tell(11)}}}/{tell(12)}")
    c.transition(a, m, "[u == 2]", inner=True)
    c.transition(b, a, "[u == 0]")


def _order_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, child = Told(), "", ""
    for u in given:
        if not state:
            say(1, 5)
            state, child = "A", "K"
        elif state == "B":
            if u == 0:
                say(1, 5)
                state, child = "A", "K"
        elif u == 1:
            say(11, 7 if child == "K" else 10, 3, 12, 4)
            state = "B"
        else:
            say(2)
            if u == 2:
                say(7 if child == "K" else 10, 8)
                child = "M"
            else:
                say(6 if child == "K" else 9)
        yield (say.t,)


def _initialized_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    """The entry comes before the first step."""
    found = _order_by_hand([0, *given])
    next(found)
    yield from found


def _paths(c: WrittenChart) -> None:
    a, b = c.state(f"A\ndu: {tell(1)}"), c.state(f"B\nen: {tell(2)}")
    first, second, end = c.junction(), c.junction(), c.junction()
    c.transition(None, a)
    c.transition(a, first, f"{{{tell(3)}}}/{tell(4)}", 1)
    c.transition(first, b, f"[u == 1]/{tell(5)}", 1)
    c.transition(first, second, f"[u >= 2]{{{tell(6)}}}", 2)
    c.transition(second, end, f"[u == 2]{{{tell(7)}}}", 1)
    c.transition(second, b, f"[u == 9]{{{tell(8)}}}", 2)
    c.transition(a, b, f"[u == 3]{{{tell(9)}}}", 2)
    c.transition(b, a, f"[u == 0]{{{tell(10)}}}")


def _paths_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state:
            state = "A"
        elif state == "B":
            if u == 0:
                say(10)
                state = "A"
        else:
            say(3)
            if u == 1:
                say(4, 5, 2)
                state = "B"
            elif u == 2:  # a junction without a way on: the search ends, and A is executed
                say(6, 7, 1)
            elif u == 3:  # back to the next transition of A
                say(6, 9, 2)
                state = "B"
            else:
                say(1)
        yield (say.t,)


def _taking(c: WrittenChart) -> None:
    a = c.state(f"A\nen: {tell(1)}\nex: {tell(2)}")
    k = c.state(f"K\nen: {tell(3)}\nex: {tell(4)}", a)
    m = c.state(f"M\nen: {tell(5)}\nex: {tell(6)}", a)
    c.transition(None, a)
    c.transition(None, k)
    c.transition(a, a, f"[u == 1]/{tell(7)}", 1)
    c.transition(a, m, "[u == 2]", 2)
    c.transition(a, a, f"[u == 3]/{tell(8)}", 1, inner=True)
    c.transition(m, a, "[u == 0]", holder=a)


def _taking_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, child = Told(), ""
    for u in given:
        left = 4 if child == "K" else 6
        if not child:
            say(1, 3)
            child = "K"
        elif u == 1:  # outside, to itself
            say(left, 2, 7, 1, 3)
            child = "K"
        elif u == 2:  # outside, to its own child
            say(left, 2, 1, 5)
            child = "M"
        elif u == 3:  # inside, to its own border
            say(left, 8, 3)
            child = "K"
        elif child == "M":  # of a child to the state around it, drawn in that
            say(6, 3)
            child = "K"
        yield (say.t,)


def _regions(c: WrittenChart) -> None:
    a, p = c.state(f"A\nex: {tell(1)}"), c.state(f"P\nen: {tell(2)}\nex: {tell(3)}", parallel=True)
    third = c.state(f"R3\nen: {tell(4)}\ndu: {tell(5)}\nex: {tell(6)}", p, order=3)
    first = c.state(f"R1\nen: {tell(7)}\ndu: {tell(8)}\nex: {tell(9)}", p, order=1)
    second = c.state(f"R2\nen: {tell(10)}\nex: {tell(11)}", p, order=2)
    x, y = c.state(f"X\nen: {tell(12)}\nex: {tell(13)}", second), c.state(f"Y\nen: {tell(14)}", second)
    assert third is not first
    c.transition(None, a)
    c.transition(None, x)
    c.transition(a, y, "[u == 1]", 1)
    c.transition(a, p, "[u == 2]", 2)
    c.transition(p, a, "[u == 0]")


def _regions_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, child = Told(), "", ""
    for u in given:
        if not state:
            state = "A"
        elif state == "A" and u in (1, 2):
            state, child = "P", "Y" if u == 1 else "X"
            say(1, 2, 7, 10, 14 if child == "Y" else 12, 4)
        elif state == "P" and u == 0:
            say(6, *([13] if child == "X" else []), 11, 9, 3)
            state = "A"
        elif state == "P":
            say(8, 5)
        yield (say.t,)


def _history(c: WrittenChart) -> None:
    a, b = c.state(f"A\nen: {tell(1)}"), c.state("B")
    k, m = c.state(f"K\nen: {tell(2)}", a), c.state(f"M\nen: {tell(3)}", a)
    h = c.junction(a, history=True)
    c.transition(None, b)
    c.transition(None, k)
    c.transition(k, m, "[u == 2]")
    c.transition(m, k, "[u == 2]")
    c.transition(a, b, "[u == 0]")
    c.transition(b, a, "[u == 1]", 1)
    c.transition(b, h, "[u == 3]", 2)


def _history_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, child = Told(), "", "K"
    for u in given:
        if not state:
            state = "B"
        elif state == "B" and u in (1, 3):
            say(1, 2 if child == "K" else 3)
            state = "A"
        elif state == "A" and u == 0:
            state = "B"
        elif state == "A" and u == 2:
            child = "M" if child == "K" else "K"
            say(2 if child == "K" else 3)
        yield (say.t,)


def _border(c: WrittenChart) -> None:
    a = c.state("A")
    outer = c.state(f"Outer\nen: {tell(1)}\nex: {tell(2)}", subchart=True)
    k, m = c.state(f"K\nen: {tell(3)}", outer), c.state(f"M\nen: {tell(4)}\nex: {tell(5)}", outer)
    c.transition(None, a)
    c.transition(None, k)
    c.crossing(a, m, f"[u == 1]/{tell(6)}", 1, outer)
    c.transition(a, outer, "[u == 2]", 2)
    c.crossing(m, a, "[u == 0]", 1, outer)
    c.transition(outer, a, "[u == 3]", 1)


def _border_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state:
            state = "A"
        elif state == "A" and u == 1:
            say(6, 1, 4)
            state = "M"
        elif state == "A" and u == 2:
            say(1, 3)
            state = "K"
        elif (state == "M" and u in (0, 3)) or (state == "K" and u == 3):
            say(*([5] if state == "M" else []), 2)
            state = "A"
        yield (say.t,)


def _box(c: WrittenChart) -> None:
    """A box is a namespace only: its regions are ordered with the others."""
    c.parallel = True
    box = c.state("Box", box=True)
    regions = [
        c.state(f"R3\ndu: {tell(3)}", box, order=3),
        c.state(f"R2\ndu: {tell(2)}", order=2),
        c.state(f"R1\ndu: {tell(1)}\nen: {tell(4)}\nen: {tell(5)}", box, order=1),
    ]
    assert len(regions) == 3


def _box_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say = Told()
    for number, _ in enumerate(given):
        say(*((1, 2, 3) if number else (4, 5)))
        yield (say.t,)


STATES = (
    ByHand("order", one_chart(_order), _order_by_hand),
    ByHand(
        "initialized", one_chart(_order, executeAtInitialization=1),
        _initialized_by_hand,
    ),
    ByHand("paths", one_chart(_paths), _paths_by_hand),
    ByHand("taking", one_chart(_taking), _taking_by_hand),
    ByHand("regions", one_chart(_regions), _regions_by_hand),
    ByHand("history", one_chart(_history), _history_by_hand),
    ByHand("border", one_chart(_border), _border_by_hand),
    ByHand("box", one_chart(_box), _box_by_hand),
)  # fmt: skip

__all__ = ["STATES"]
