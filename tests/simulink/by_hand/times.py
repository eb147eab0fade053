"""Events, early return, times and changes: models by hand."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.simulink.by_hand.models import ByHand, Given, Told, one_chart, tell


def _early(c: WrittenChart) -> None:
    """Events for all that have the sender left: in an entry, a condition and a transition action."""
    c.event("E")
    a, b = c.state("A"), c.state(f"B\nen: {tell(1)} if u == 2, E; end; {tell(2)}")
    k, z = c.state(f"K\nen: {tell(3)}", b), c.state(f"Z\nen: {tell(4)}")
    c.transition(None, a)
    c.transition(None, k)
    c.transition(a, z, "E", 1)
    c.transition(a, b, f"[u == 1 || u == 2]{{{tell(5)}}}", 2)
    c.transition(a, b, f"[u == 3]{{{tell(6)} E; {tell(7)}}}", 3)
    c.transition(b, z, f"E{{{tell(8)}}}", 1)
    c.transition(b, a, "[u == 0]", 2)
    c.transition(z, a, "[u == 0]")


def _early_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state:
            state = "A"
        elif state in "BZ":
            state = "A" if u == 0 else state
        elif u == 1:
            say(5, 1, 2, 3)
            state = "B"
        elif u == 2:  # B is left while its entry action runs: the rest of that and K are dropped
            say(5, 1, 8, 4)
            state = "Z"
        elif u == 3:  # A is left while the condition action runs: the rest and the path are dropped
            say(6, 4)
            state = "Z"
        yield (say.t,)


def _sent(c: WrittenChart) -> None:
    """An event to one region, which counts those that it has seen."""
    c.parallel = True
    c.event("E")
    first = c.state(f"S\ndu: if u > 0, {tell(1)} send(E, T); {tell(2)} end", order=1)
    second = c.state(f"T\ndu: {tell(3)}\non E: {tell(4)}", order=2)
    a, b = c.state(f"A\nex: {tell(5)}", second), c.state(f"B\nen: {tell(6)}", second)
    assert first
    c.transition(None, a)
    c.transition(a, b, "after(2, E)")
    c.transition(b, a, "E[u == 3]")


def _sent_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, seen = Told(), "", 0
    for u in given:
        if not state:
            state, seen = "A", 0
            yield (say.t,)
            continue
        if u > 0:
            seen += 1
            say(1, 3, 4)
            if state == "A" and seen >= 2:
                say(5, 6)
                state = "B"
            elif state == "B" and u == 3:
                state, seen = "A", 0
            say(2)
        say(3)
        yield (say.t,)


def _times(c: WrittenChart) -> None:
    a, b = c.state("A"), c.state("B")
    d, e = c.state(f"D\ndu: if before(3, tick), {tell(1)} end"), c.state("E")
    c.transition(None, a)
    c.transition(a, b, f"[after(0.3, sec) && u > 0]/{tell(2)}")
    c.transition(b, d, f"[at(2, tick)]/{tell(3)}", 1)
    c.transition(b, a, f"[u == 3]/{tell(4)}", 2)
    c.transition(d, e, f"[every(2, tick) && u == 1]/{tell(5)}")
    c.transition(e, a, f"[temporalCount(tick) > 2 || elapsed(sec) >= 0.2 && u == 0]/{tell(6)}")


def _times_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, count = Told(), "", 0
    for u in given:
        count += 1
        before = state
        match state:
            case "":
                state = "A"
            case "A" if count >= 3 and u > 0:
                say(2)
                state = "B"
            case "B" if count == 2:
                say(3)
                state = "D"
            case "B" if u == 3:
                say(4)
                state = "A"
            case "D" if count % 2 == 0 and u == 1:
                say(5)
                state = "E"
            case "D" if count < 3:
                say(1)
            case "E" if count > 2 or (count >= 2 and u == 0):
                say(6)
                state = "A"
        if state != before:
            count = 0
        yield (say.t,)


def _duration(c: WrittenChart) -> None:
    a, b = c.state("A"), c.state("B")
    c.transition(None, a)
    c.transition(a, b, f"[duration(u > 0) > 0.2]{{{tell(1)}}}")
    c.transition(b, a, f"[duration(u < 2, msec) >= 200]{{{tell(2)}}}")


def _duration_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, held = Told(), "", 0
    for u in given:
        holds = {"A": u > 0, "B": u < 2, "": False}[state]
        if not holds:
            held = 0
        if not state:
            state, held = "A", 0
        elif state == "A" and held > 2:
            say(1)
            state, held = "B", 0
        elif state == "B" and held >= 2:
            say(2)
            state, held = "A", 0
        held = held + 1 if (u > 0 if state == "A" else u < 2) else 0
        yield (say.t,)


_WORDS = (
    "hasChanged(u)",
    "hasChangedTo(u, 2)",
    "hasChangedFrom(u, 2)",
    "rising(u)",
    "falling(u)",
    "crossing(u)",
)


def _changes(c: WrittenChart) -> None:
    done = "\n".join(f"if {word}, {tell(n)} end" for n, word in enumerate(_WORDS, 1))
    c.transition(None, c.state(f"A\nen, du:\n{done}"))


def _changes_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, was = Told(), None
    for u in given:
        if was is not None:
            rises, falls = was <= 0 < u, was >= 0 > u
            happens = (u != was, u != was and u == 2, u != was and was == 2, rises, falls, rises or falls)
            say(*(number for number, one in enumerate(happens, 1) if one))
        was = u
        yield (say.t,)


TIMES = (
    ByHand("early", ("events", "early return"), one_chart(_early), _early_by_hand),
    ByHand("sent", ("directed events", "on sections", "counted events"), one_chart(_sent), _sent_by_hand),
    ByHand("times", ("after, before, at, every", "elapsed times"), one_chart(_times), _times_by_hand),
    ByHand("duration", ("duration",), one_chart(_duration), _duration_by_hand),
    ByHand(
        "changes", ("hasChanged", "rising, falling, crossing"), one_chart(_changes), _changes_by_hand,
        (-2, -1, 0, 1, 2, 2),
    ),
)  # fmt: skip

__all__ = ["TIMES"]
