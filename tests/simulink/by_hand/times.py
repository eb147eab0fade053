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


def _units(c: WrittenChart) -> None:
    """Times in every unit, and steps in which a condition has held."""
    a, b = c.state("A"), c.state(f"B\ndu: if temporalCount(sec) >= 0.2, {tell(1)} end\nbind: t")
    d = c.state(f"D\non after(300, msec): {tell(2)}")
    c.transition(None, a)
    c.transition(a, b, f"after(200, msec)[u > 0]{{{tell(3)}}}")
    c.transition(b, d, f"[elapsed(sec) >= 0.3 || before(200000, usec) && u == 3]/{tell(4)}")
    c.transition(d, a, f"[count(u > 1) >= 2]/{tell(5)}")


def _units_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, count, held = Told(), "", 0, 0
    for u in given:
        count, before = count + 1, state
        held = held if u > 1 else 0
        if not state:
            state = "A"
        elif state == "A" and count >= 2 and u > 0:
            say(3)
            state = "B"
        elif state == "B" and (count >= 3 or (count < 2 and u == 3)):
            say(4)
            state = "D"
        elif state == "D" and held >= 2:
            say(5)
            state = "A"
        elif (state == "B" and count >= 2) or (state == "D" and count >= 3):
            say(1 if state == "B" else 2)
        if state != before:
            count = held = 0
        held = held + 1 if state == "D" and u > 1 else 0
        yield (say.t,)


def _seen(c: WrittenChart) -> None:
    """Events that a state has seen since it was entered, in every word that counts them."""
    c.parallel = True
    c.event("E")
    first, second = c.state("S\ndu: if u > 0, send(E, T); end", order=1), c.state("T", order=2)
    on = f"on every(2, E): {tell(1)}\non at(3, E): {tell(2)}"
    a, b = c.state(f"A\n{on}\ndu: if temporalCount(E) == 1, {tell(3)} end", second), c.state("B", second)
    assert first
    c.transition(None, a)
    c.transition(a, b, f"after(4, E)[u > 1]/{tell(4)}")
    c.transition(b, a, f"before(2, E)[u == 2]/{tell(5)}", 1)
    c.transition(b, a, f"[temporalCount(E) >= 2 && u == 0]/{tell(6)}", 2)


def _seen_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, seen = Told(), "", 0
    for u in given:
        if not state:
            state = "A"
            yield (say.t,)
            continue
        for event in (True, False) if u > 0 else (False,):
            seen += event
            if state == "A" and event and seen >= 4 and u > 1:
                say(4)
                state, seen = "B", 0
            elif state == "A":
                counts = {3: seen == 1, 1: event and seen % 2 == 0, 2: event and seen == 3}
                say(*(digit for digit, true in counts.items() if true))
            elif event and seen < 2 and u == 2:
                say(5)
                state, seen = "A", 0
            elif seen >= 2 and u == 0:
                say(6)
                state, seen = "A", 0
        yield (say.t,)


def _shared(c: WrittenChart) -> None:
    """A duration behind a junction that two states lead to, each of which counts for itself."""
    a, b, d = c.state("A"), c.state(f"B\nen: {tell(1)}"), c.state(f"D\nen: {tell(2)}")
    both = c.junction()
    c.transition(None, a)
    c.transition(a, b, "[u == 2]", 1)
    c.transition(a, both, "", 2)
    c.transition(b, a, "[u == 3]", 1)
    c.transition(b, both, "", 2)
    c.transition(both, d, "[duration(u < 2) > 0.2]")
    c.transition(d, b, "[u == 2]")


def _shared_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, held = Told(), "", 0
    for u in given:
        before = state
        held = held if u < 2 else 0
        if not state or (state == "B" and u == 3):
            state = "A"
        elif state in "AD" and u == 2:
            say(1)
            state = "B"
        elif state in "AB" and held > 2:
            say(2)
            state = "D"
        held = (0 if state != before else held) + 1 if u < 2 and state != "D" else 0
        yield (say.t,)


def _own_changes(c: WrittenChart) -> None:
    """Changes of what the chart writes itself are those from the start of one step to that of the next."""
    c.data("n", "local", "int8", 1)
    words = ("hasChanged(n)", "hasChangedTo(n, 2)", "hasChangedFrom(n, 2)")
    done = " ".join(f"if {word}, {tell(number)} end" for number, word in enumerate(words, 1))
    a = c.state(f"A\nen, du: n = mod(n + u, 4); {done}")
    b = c.state(f"B\nen: n = int8(2);\ndu: n = int8(0); {done}")
    c.transition(None, a)
    c.transition(a, b, f"[hasChangedTo(n, 3)]{{{tell(4)}}}")
    c.transition(b, a, "[u == 3]")


def _own_changes_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, n, before = Told(), "", 1, 1

    def changes(started: int) -> None:
        if state and started != before:
            say(*(d for d, true in ((1, True), (2, started == 2), (3, before == 2)) if true))

    for u in given:
        started = n
        if state == "A" and started != before and started == 3:
            say(4)
            state, n = "B", 2
        elif state == "B" and u != 3:
            n = 0
            changes(started)
        else:
            n = (n + u) % 4
            changes(started)
            state = "A"
        before = started
        yield (say.t,)


TIMES = (
    ByHand("early", one_chart(_early), _early_by_hand),
    ByHand("sent", one_chart(_sent), _sent_by_hand),
    ByHand("times", one_chart(_times), _times_by_hand),
    ByHand("units", one_chart(_units), _units_by_hand, (0, 1, 2, 3, 2)),
    ByHand("seen", one_chart(_seen), _seen_by_hand),
    ByHand("shared", one_chart(_shared), _shared_by_hand, (0, 1, 1, 0, 2, 3)),
    ByHand("own_changes", one_chart(_own_changes), _own_changes_by_hand),
    ByHand("duration", one_chart(_duration), _duration_by_hand),
    ByHand(
        "changes", one_chart(_changes), _changes_by_hand,
        (-2, -1, 0, 1, 2, 2),
    ),
)  # fmt: skip

__all__ = ["TIMES"]
