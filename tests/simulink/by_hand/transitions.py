"""Paths, levels and events once more, in the forms that are drawn less often: models by hand."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.by_hand.models import ByHand, Given, Told, one_chart, tell


def _defaults(c: WrittenChart) -> None:
    """Default transitions with guards and actions, through junctions, of a state that is entered anew."""
    first, second = c.junction(), c.junction()
    p, q = c.state(f"P\nen: {tell(1)}\nex: {tell(2)}"), c.state(f"Q\nen: {tell(3)}")
    k, m = c.state(f"K\nen: {tell(4)}", p), c.state(f"M\nen: {tell(5)}", p)
    c.transition(None, first, f"{{{tell(6)}}}/{tell(7)}", 1)
    c.transition(None, q, f"/{tell(8)}", 2)
    c.transition(first, second, f"[u > 0]{{{tell(9)}}}", 1)
    c.transition(second, p, f"[u == 1]/{tell(10)}", 1)
    c.transition(None, k, f"[u == 1]{{{tell(11)}}}", 1)
    c.transition(None, m, f"/{tell(12)}", 2)
    c.transition(q, p, f"[u ~= 0]/{tell(13)}")
    c.transition(p, q, "[u == 0]")


def _defaults_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        inside = (11, 4) if u == 1 else (12, 5)
        if not state:
            say(6, *((9,) if u > 0 else ()))
            say(*((7, 10, 1, *inside) if u == 1 else (8, 3)))
            state = "P" if u == 1 else "Q"
        elif state == "Q" and u != 0:
            say(13, 1, *inside)
            state = "P"
        elif state == "P" and u == 0:
            say(2, 3)
            state = "Q"
        yield (say.t,)


def _upwards(c: WrittenChart) -> None:
    """Transitions to the state around, drawn in it and outside of it, and one that ends in a history."""
    p = c.state(f"P\nen: {tell(1)}\ndu: {tell(2)}\nex: {tell(3)}")
    k, m = c.state(f"K\nen: {tell(4)}\nex: {tell(5)}", p), c.state(f"M\nen: {tell(6)}\nex: {tell(7)}", p)
    c.transition(None, p)
    c.transition(None, k)
    c.transition(k, m, f"[u == 1]/{tell(8)}")
    c.transition(m, p, f"[u == 2]/{tell(9)}", 1, holder=p)
    c.transition(m, p, f"[u == 3]/{tell(10)}", 2, holder=c)


def _upwards_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state:
            say(1, 4)
            state = "K"
        elif state == "K":
            say(2)
            if u == 1:
                say(5, 8, 6)
                state = "M"
        else:
            say(2)
            if u == 2:  # P is not left
                say(7, 9, 4)
            elif u == 3:  # P is left and entered again
                say(7, 3, 10, 1, 4)
            state = "K" if u in (2, 3) else "M"
        yield (say.t,)


def _histories(c: WrittenChart) -> None:
    """A history on the outer level only, one on both, and a time that begins anew."""
    idle, p = c.state("Idle"), c.state(f"P\nen: {tell(1)}")
    a, b = c.state(f"A\nen: {tell(2)}", p), c.state(f"B\nen: {tell(3)}", p)
    c.junction(p, history=True)
    a1, a2 = c.state(f"A1\nen: {tell(4)}", a), c.state(f"A2\nen: {tell(5)}", a)
    b1, b2 = c.state(f"B1\nen: {tell(6)}", b), c.state(f"B2\nen: {tell(7)}", b)
    inner = c.junction(b, history=True)
    c.transition(None, p)
    c.transition(None, a)
    c.transition(None, a1)
    c.transition(None, b1)
    c.transition(a1, a2, "[u == 1]")
    c.transition(b1, b2, f"after(2, tick)[u == 1]/{tell(8)}")
    c.transition(a, b, "[u == 2]", 1)
    c.transition(b, a, "[u == 2]", 1)
    c.transition(p, idle, "[u == 0]")
    c.transition(idle, p, "[u == 1]", 1)
    c.transition(idle, inner, "[u == 3]", 2)


def _histories_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, at, left, b, count = Told(), "", "A", "B1", 0

    def entered(child: str) -> str:
        nonlocal count
        count = 0
        if child == "A":
            say(2, 4)
            return "A1"
        say(3, 6 if b == "B1" else 7)
        return b

    for u in given:
        count += 1
        if not at:
            say(1)
            at = entered("A")
        elif at == "Idle" and u in (1, 3):
            say(1)
            at = entered(left if u == 1 else "B")
        elif at != "Idle" and u == 0:
            left, b, at = at[0], at if at[0] == "B" else b, "Idle"
        elif at != "Idle" and u == 2:
            b = at if at[0] == "B" else b
            at = entered("B" if at[0] == "A" else "A")
        elif at == "A1" and u == 1:
            say(5)
            at = "A2"
        elif at == "B1" and u == 1 and count >= 2:
            say(8, 7)
            at = "B2"
        yield (say.t,)


def _nested(c: WrittenChart) -> None:
    """Events within events, to all and to one state, in a chart of regions; there is no queue."""
    c.parallel = True
    c.data("n", "local", "int8", 0)
    for name in "EFG":
        c.event(name)
    first = c.state("R1", order=1)
    a, b = c.state("A", first), c.state(f"B\nen: {tell(1)}", first)
    second = c.state(f"R2\ndu: {tell(2)}\non E: {tell(3)} send(F, R3); {tell(4)}", order=2)
    third = c.state(f"R3\non F: {tell(5)} G; {tell(6)}\non G: {tell(7)}", order=3)
    x, y = c.state(f"X\nex: {tell(8)}", third), c.state(f"Y\non F: {tell(14)}", third)
    assert second
    c.transition(None, a)
    c.transition(None, x)
    c.transition(a, b, f"[u == 1 && n == 0]{{n = 1; {tell(9)} E; {tell(10)} n = 0;}}", 1)
    c.transition(a, b, f"[u == 2 && n == 0]{{{tell(11)} send(F, Y); Y.F; {tell(12)}}}", 2)
    c.transition(b, a, "[u == 0]")
    c.transition(x, y, "G")
    c.transition(y, x, f"[u == 1]/{tell(13)}")


def _nested_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, first, third = Told(), "", "X"

    def second_and_third(event: str) -> None:
        say(2)
        if event == "E":
            say(3)
            run_third("F")
            say(4)
        run_third(event)

    def run_third(event: str) -> None:
        nonlocal third
        if event == "F":
            say(5)
            second_and_third("G")
            say(6)
        if event == "G":
            say(7)
        if third == "Y" and u == 1:  # without an event it may be taken in any execution
            say(13)
            third = "X"
        elif third == "X" and event == "G":
            say(8)
            third = "Y"

    for u in given:
        if not first:
            first = "A"
            yield (say.t,)
            continue
        if first == "A" and u == 1:
            say(9)
            second_and_third("E")
            say(10, 1)
            first = "B"
        elif first == "A" and u == 2:
            say(11, *((14, 14) if third == "Y" else ()), 12, 1)
            first = "B"
        elif first == "B" and u == 0:
            first = "A"
        second_and_third("")
        yield (say.t,)


def _regions_left(c: WrittenChart) -> None:
    """A region is executed only while the state around it is active, and left-and-entered is active."""
    p, q = c.state(f"P\nen: {tell(1)}", parallel=True), c.state(f"Q\nen: {tell(2)}")
    c.event("OUT")
    c.event("AGAIN")
    sends = f"if u == 1, OUT; {tell(3)} elseif u == 2, AGAIN; {tell(4)} end, {tell(5)}"
    one = c.state(f"One\ndu: {sends}", p, order=1)
    two = c.state(f"Two\ndu: {tell(6)}\nex: {tell(7)}", p, order=2)
    assert one is not two
    c.transition(None, p)
    c.transition(p, q, "OUT", 1)
    c.transition(p, p, "AGAIN", 2)
    c.transition(q, p, "[u == 0]")


def _regions_left_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state or (state == "Q" and u == 0):
            say(1)
            state = "P"
        elif state == "P" and u == 1:  # One is no longer active: the rest of its action and Two are dropped
            say(7, 2)
            state = "Q"
        elif state == "P" and u == 2:  # left and entered again, it counts as active
            say(7, 1, 4, 5, 6)
        elif state == "P":
            say(5, 6)
        yield (say.t,)


def _implicit(c: WrittenChart) -> None:
    """In a chart of implicit order the numbers count, too, whatever the positions say."""
    c.explicit = False
    a, b = c.state("A"), c.state(f"B\nen: {tell(1)}")
    d, note = c.state(f"D\nen: {tell(2)}"), c.state("What it does\nen: y = 3;", more={"isNoteBox": 1})
    assert note
    c.frames = {a.ssid: (100, 100, 80, 60), b.ssid: (300, 20, 80, 60), d.ssid: (300, 220, 80, 60)}
    c.transition(None, a)
    c.transition(a, d, "[u > 0]", 1)
    c.transition(a, b, "[u > 1]", 2)
    c.transition(a, b, "[u == 0]", 3)
    c.transition(b, None, "[u == 0]", 1)
    c.transition(b, a, "[u == 1]", 2)
    c.transition(d, a, "[u == 2]")


def _implicit_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state or (state == "B" and u == 1) or (state == "D" and u == 2):
            state = "A"
        elif state == "A":
            say(2 if u > 0 else 1)
            state = "D" if u > 0 else "B"
        yield (say.t,)


def _told(name: str, **more: str) -> dict[str, object]:
    return {"useCustomName": 1, "customName": name, **more}


def _told_states() -> WrittenModel:
    """Outputs that hold the active child, the active leaf, and whether a state is active."""
    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C", more={"stateMachineType": "MEALY_MACHINE"})
    chart.data("u", "input", "int8")
    leaf = _told("leaf", enumTypeName="Leaves", activityMode="LEAF_STATE_ACTIVITY")
    child, own = _told("child", enumTypeName="Children"), _told("own", activityMode="SELF_ACTIVITY")
    chart.inside = {"activeStateOutput": leaf}
    run, halt = chart.state("Run", inside={"activeStateOutput": child}), chart.state("Halt")
    slow, fast = chart.state("Slow", run), chart.state("Fast", run, inside={"activeStateOutput": own})
    chart.data("leaf", "output", "Enum: Leaves")
    chart.data("child", "output", "Enum: Children", more={"outputState": run.ssid})
    chart.data("own", "output", "boolean", more={"outputState": fast.ssid})
    chart.transition(None, run)
    chart.transition(None, slow)
    chart.transition(slow, fast, "[u == 1]")
    chart.transition(run, halt, "[u == 2]")
    chart.transition(halt, fast, "[u == 1]", 1)
    chart.transition(halt, run, "[u == 0]", 2)
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    for number, name in enumerate(("leaf", "child", "own"), 1):
        model.root.line(f"{block}/{number}", model.root.outport(name, number))
    return model


def _told_states_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state = ""
    for u in given:
        if not state or (state == "Halt" and u == 0):
            state = "Slow"
        elif state != "Halt" and u == 2:
            state = "Halt"
        elif u == 1:
            state = "Fast"
        leaf, child = {"Fast": (1, 1), "Halt": (2, 0), "Slow": (3, 2)}[state]
        yield leaf, child, state == "Fast"


TRANSITIONS = (
    ByHand("defaults", one_chart(_defaults), _defaults_by_hand),
    ByHand("upwards", one_chart(_upwards), _upwards_by_hand),
    ByHand("histories", one_chart(_histories), _histories_by_hand, (0, 1, 1, 2, 3)),
    ByHand("nested", one_chart(_nested), _nested_by_hand),
    ByHand("regions_left", one_chart(_regions_left), _regions_left_by_hand, (0, 1, 2, 3, 4)),
    ByHand("implicit", one_chart(_implicit), _implicit_by_hand),
    ByHand("told_states", _told_states, _told_states_by_hand),
)

__all__ = ["TRANSITIONS"]
