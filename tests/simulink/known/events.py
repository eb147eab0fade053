"""Events in charts: early return in each kind of action, events to one state, counted events.

The rules are those of the manual's chapter on early return logic, and of charts in papers.
"""

from collections.abc import Iterable, Iterator

from tests.simulink.known.models import Known, Row
from tests.simulink.known.packages import ChartText

Outs = Iterator[tuple[float, ...]]

EARLY_DURING = ChartText(
    "early_during",
    """
    in u uint8
    out log uint16
    event E
    -> A
    state A: en: log = 1;\\ndu: log = log + 2; E; log = log + 10;\\nex: log = log + 1000;
        -> K
        state K: du: log = log + 3;
        K -> L: E{log = log + 5;}
        state L: en: log = log + 7;
    state B: en: log = log + 100;\\ndu: log = log + 1;
    A -> B: E
    B -> A: [u == 0]
    """,
    "C",
)


def _early_during(rows: Iterable[Row]) -> Outs:
    state, log = "", 0
    for row in rows:
        if not state:
            state, log = "A", 1
        elif state == "A":
            log += 2 + 1000 + 100  # the event has A left: the rest of its action, and K, are dropped
            state = "B"
        elif row["u"] == 0:
            state, log = "A", 1
        else:
            log += 1
        yield (log % 65536,)


EARLY_CONDITION = ChartText(
    "early_condition",
    """
    in u uint8
    out log uint16
    event E
    region P
        -> A
        state A: en: log = 1;\\nex: log = log + 7;
        state B: en: log = log + 20;
        state D: en: log = log + 300;
        junction j
        A -> D: E{log = log + 2;}
        A -> j: [u == 1]{log = log + 40; E; log = log + 500;}
        A -> j: [u == 2]{log = log + 60, send(E)\\nlog = log + 900}
        j -> B: {log = log + 5;}/log = log + 3;
        B -> A: [u == 0]
        D -> A: [u == 0]
    region Q: on E: log = log + 2000;
    """,
)


def _early_condition(rows: Iterable[Row]) -> Outs:
    state, log = "", 0
    for row in rows:
        u = row["u"]
        if not state:
            state, log = "A", 1
        elif state == "A" and u == 1:
            log += 40 + 2 + 7 + 300 + 2000
            state = "D"
        elif state == "A" and u == 2:
            log += 60 + 2 + 7 + 300 + 2000
            state = "D"
        elif state != "A" and u == 0:
            state, log = "A", 1
        yield (log,)


EARLY_TRANSITION = ChartText(
    "early_transition",
    """
    in u uint8
    out log uint16
    event E
    region M
        -> S
        state S: en: log = log + 3;\\nex: log = log + 9;
            -> A
            state A: en: log = log + 2;\\nex: log = log + 1;
            state B: en: log = log + 20;
            A -> B: [u == 1 || u == 3]/E; log = log + 4000;
            B -> A: [u == 0]{log = 0;}
        S -> S: E[u == 3]{log = log + 50;}
    region Q
        -> X
        state X
        state Y
        X -> Y: E{log = log + 500;}
        Y -> X: [u == 0]
    """,
)


def _early_transition(rows: Iterable[Row]) -> Outs:
    m = q = ""
    log = 0
    for row in rows:
        u = row["u"]
        if not m:
            m, q, log = "A", "X", 5
            yield (log,)
            continue
        if m == "A" and u in (1, 3):
            log += 1
            if u == 3:  # S is left and entered anew, so that A is active: the rest and B are dropped
                log += 50 + 9 + 3 + 2
            if q == "X":
                log, q = log + 500, "Y"
            if u == 1:  # nobody in S is active while E is answered
                log, m = log + 4000 + 20, "B"
        elif m == "B" and u == 0:
            m, log = "A", 2
        if q == "Y" and u == 0:
            q = "X"
        log %= 65536
        yield (log,)


EARLY_ENTRY = ChartText(
    "early_entry",
    """
    in u uint8
    out log uint16
    event E
    -> A
    state A: en: log = 0;
    state B: en: log = log + 1; send(E); log = log + 20;\\nex: log = log + 300;
        -> K
        state K: en: log = log + 4000;
    state D: en: log = log + 5;
    A -> B: [u > 0]
    B -> D: E[u == 1]
    B -> A: [u == 0]
    D -> A: [u != 1]
    """,
)


def _early_entry(rows: Iterable[Row]) -> Outs:
    state, log = "", 0
    for row in rows:
        u = row["u"]
        if not state or (state == "B" and u == 0) or (state == "D" and u != 1):
            state, log = "A", 0
        elif state == "A" and u == 1:  # B is left while its entry action runs: the rest and K are dropped
            log, state = log + 1 + 300 + 5, "D"
        elif state == "A" and u > 1:
            log, state = log + 1 + 20 + 4000, "B"
        elif state == "B" and u == 1:
            pass  # B -> D needs the event
        yield (log,)


EXIT_RECURSION = ChartText(
    "exit_recursion",
    """
    in u uint8
    out n uint8
    out log uint16
    event E
    -> A
    state A: en: n = 0; log = 0;\\nex: n = n + 1; E; log = log + 1;
    state B: en: log = log + 10;
    state C: en: log = log + 100;
    A -> C: [u > 0 && n == 0]/log = log + 1000;
    A -> B: E[n < 3]/log = log + 2000;
    B -> A: [u == 0]
    C -> A: [u == 0]
    """,
)


def _exit_recursion(rows: Iterable[Row]) -> Outs:
    state, n, log = "", 0, 0
    for row in rows:
        if not state or (state == "B" and row["u"] == 0):
            state, n, log = "A", 0, 0
        elif state == "A" and row["u"] > 0:
            # A is active while its exit action runs, and answers the event: three times over. The innermost
            # exit ends, B is entered, and the transitions around that are dropped.
            state, n, log = "B", 3, 1 + 2000 + 10
        yield n, log


DIRECTED = ChartText(
    "directed",
    """
    in u uint8
    out fails uint8
    out log int32
    event INC
    event DEC
    region Sensors
        region O2
            -> normal
            state normal
            state fail: entry: Fail.INC;\\nexit: Fail.DEC;
            normal -> fail: [bitand(u, 1) != 0]
            fail -> normal: [bitand(u, 1) == 0]
        region Speed
            -> ok
            state ok
            state bad: en: send(INC, Fail); ex: send(DEC, Fail);
            ok -> bad: [(u & 2) != 0 && in(Fail.Multi) == 0]
            bad -> ok: [!(u & 2)]
    region Fail
        -> None
        state None: en: fails = 0;
        state One: en: fails = 1;
        state Multi: on INC: log = log + 1;
            -> Two
            state Two: en: fails = 2;
            state Three: en: fails = 3;
            Two -> Three: INC
            Three -> Two: DEC
        None -> One: INC
        One -> Two: INC
        One -> None: DEC
        Two -> One: DEC
    """,
)


def _directed(rows: Iterable[Row]) -> Outs:
    first, o2, speed, fails = True, False, False, 0
    for row in rows:
        u = int(row["u"])
        if first:
            first = False
        else:
            if o2 != bool(u & 1):
                o2 = not o2
                fails += 1 if o2 else -1
            if speed and not u & 2:
                speed, fails = False, fails - 1
            elif not speed and u & 2 and fails < 2:
                speed, fails = True, fails + 1
        yield fails, 0


COUNTED = ChartText(
    "counted",
    """
    in u uint8
    out a uint8
    out b uint16
    event E
    event W
    region Send
        -> S0
        state S0
        S0 -> S0: [u == 1]/E;
        S0 -> S0: [u == 2]/{E; E;}
        S0 -> S0: [u == 3]/W
    region Count
        -> X
        state X: en: a = 1;\\non E: b = b + 1;\\non every(2, E): b = b + 100;\\non after(3, E): b = b + 1000;
        state Y: en: a = 2;\\ndu: b = temporalCount(E);\\non before(2, E), on at(4, E): b = b + 50;
        X -> Y: after(5, E)
        Y -> X: at(3, W){b = 0;}
    """,
)


def _counted(rows: Iterable[Row]) -> Outs:
    state, es, ws, b = "", 0, 0, 0
    for row in rows:
        if not state:
            state = "X"
            yield 1, 0
            continue
        u = int(row["u"])
        for _ in range({1: 1, 2: 2}.get(u, 0)):
            es += 1
            if state == "X" and es >= 5:
                state, es, ws = "Y", 0, 0
            elif state == "X":
                b += 1 + (100 if es % 2 == 0 else 0) + (1000 if es >= 3 else 0)
            else:
                b = es
                b += 50 * (es < 2) + 50 * (es == 4)
        if u == 3:
            ws += 1
            if state == "Y" and ws == 3:
                state, es, ws, b = "X", 0, 0, 0
            elif state == "Y":
                b = es
        if state == "Y":
            b = es
        yield (1 if state == "X" else 2), b


EVENTS = (
    Known(EARLY_DURING, {"u": (0, 1)}, _early_during),
    Known(EARLY_CONDITION, {"u": (0, 1, 2, 3)}, _early_condition),
    Known(EARLY_TRANSITION, {"u": (0, 1, 2, 3)}, _early_transition),
    Known(EARLY_ENTRY, {"u": (0, 1, 2)}, _early_entry),
    Known(EXIT_RECURSION, {"u": (0, 1)}, _exit_recursion),
    Known(DIRECTED, {"u": (0, 1, 2, 3)}, _directed, 300),
    Known(COUNTED, {"u": (0, 1, 2, 3)}, _counted, 300),
)
