"""The small charts by which papers on the semantics of Stateflow show its rules, each with a simulation.

Scaife and others, "Defining and translating a safe subset of Simulink/Stateflow into Lustre" (2004); Hamon
and Rushby, "An operational semantics for Stateflow" (2004); Bourbouh and others on CoCoSim.
"""

from collections.abc import Iterable, Iterator

from tests.simulink.known.models import Known, Row
from tests.simulink.known.packages import ChartText

Outs = Iterator[tuple[float, ...]]


def _stopwatch(rows: Iterable[Row]) -> Outs:
    state, cent, sec, mins, shown = "", 0, 0, 0, (0, 0, 0)
    before: Row = {"START": 0, "LAP": 0, "TIC": 0}
    for row in rows:
        for event in ("START", "LAP", "TIC"):
            if not (row[event] and not before[event]):
                continue
            if not state:
                state = "Reset"
                continue
            if state == "Reset":
                if event == "START":
                    state = "Running"
                elif event == "LAP":
                    cent = sec = mins = 0
                    shown = (0, 0, 0)
            elif state == "LapStop":
                if event == "START":
                    state = "Lap"
                elif event == "LAP":
                    state = "Reset"
                    cent = sec = mins = 0
                    shown = (0, 0, 0)
            elif event == "START":
                state = "Reset" if state == "Running" else "LapStop"
            else:
                if event == "TIC":
                    cent += 1
                    if cent == 4:
                        cent, sec = 0, sec + 1
                        if sec == 3:
                            sec, mins = 0, (mins + 1) % 5
                if state == "Running":
                    if event == "LAP":
                        state = "Lap"
                    else:
                        shown = (cent, sec, mins)
                elif event == "LAP":
                    state = "Running"
        before = row
        yield (*shown, cent)


STOPWATCH = ChartText(
    "stopwatch",
    """
    event START input rising
    event LAP input rising
    event TIC input rising
    out disp_cent uint8
    out disp_sec uint8
    out disp_min uint8
    out cent uint8
    local sec uint8
    local min uint8
    -> Stop
    state Stop
        -> Reset
        state Reset
        state Lap_stop
        Reset -> Running: START
        Reset -> Reset: LAP{cent=0; sec=0; min=0;\\n disp_cent=0; disp_sec=0; disp_min=0;}
        Lap_stop -> Reset: LAP /* all anew */ {cent=0;sec=0;min=0;disp_cent=0;disp_sec=0;disp_min=0;}
        Lap_stop -> Lap: START
    state Run
        junction j1
        junction j2
        junction j3
        Run -> j1: TIC{cent=cent+1;}
        j1 -> j2: [cent==4]{cent=0; sec=sec+1;}
        j2 -> j3: [sec==3]{sec=0; min=(min+1)%%5;}
        state Running: during: disp_cent=cent;\\n disp_sec=sec;\\n disp_min=min;
        state Lap
        Running -> Reset: START
        Running -> Lap: LAP
        Lap -> Lap_stop: START
        Lap -> Running: LAP
    """,
)


def _backtracking(rows: Iterable[Row]) -> Outs:
    state, n, log = "", 0, 0
    for row in rows:
        u = int(row["u"])
        if not state:
            state = "A"
        elif state == "A":
            n += 1  # the condition action of the first segment stays
            if u == 1:
                n, state, log = n + 10, "B", log + 1  # transition actions in the order of the segments
                log *= 2
            elif u == 2:  # both ways on fail, and the next transition of A is tried
                n += 100
                state, log = "C", log + 5
            else:
                log += 3
        elif u == 0:
            state = "A"
            n = 0
        log %= 1000
        n %= 1000
        yield n, log, "ABC".index(state)


BACKTRACKING = ChartText(
    "backtracking",
    """
    in u int8
    out n int32
    out log int32
    out where uint8
    -> A
    state A: entry: where = 0;\\nduring: log = log + 3; log = log %% 1000;
    state B: entry: where = 1; log = log %% 1000; n = n %% 1000;
    state C/ entry: where = 2; log = log %% 1000; n = n %% 1000
    junction j1
    junction j2
    A -> j1: {n = n + 1;\\nn = n %% 1000;}/log = log + 1;
    j1 -> B: [u == 1]\\n{ n = n + 10; }\\n/ log = log * 2;
    j1 -> j2: [u == 2]{n += 100;}
    j2 -> B: [u == 3]
    j2 -> B: [u < 0]
    A -> C: [u == 2] / log += 5;
    B -> A: [u == 0] {n = 0;}
    C -> A: [!u] {n = 0;}
    """,
)


def _loop(rows: Iterable[Row]) -> Outs:
    for row in rows:
        u, total, k = int(row["u"]), 0, 0
        for i in range(u):
            if i == 3:
                break
            for j in range(i + 1):
                total += j
            total += 1
            k = i + 1
        yield total, k


LOOP = ChartText(
    "loop",
    """
    in u uint8
    out total int32
    out k int32
    -> start: {total = 0; k = 0; i = 0;}
    local i int32
    local j int32
    junction start
    junction body
    junction inner
    junction next
    junction end
    start -> body: [i < u && i != 3]{j = 0;}
    start -> end
    body -> inner: [j <= i]{total += j;}
    body -> next: {total++; k = i + 1;}
    inner -> body: {j++;}
    next -> start: {i++;}
    """,
    "C",
)


INNER = ChartText(
    "inner",
    """
    in u int8
    out log int32
    function add(d)
        takes d int32
        junction f
        -> f: {log = (log*3 + d) %% 997;}
    -> P
    state P: en: log = 0;\\ndu: add(2);\\nex: add(99);
        -> X: {add(4);}
        junction j
        state X: entry: add(7); during: add(10); exit: add(5);
        state Y: entry: add(8); during: add(10); exit: add(6);
        P -> j: [u > 0]
        j -> X: [u == 1] / add(1);
        j -> Y: [u == 2] / add(2);
        P -> P: [u == 3] / add(9);
    """,
)


def _inner(rows: Iterable[Row]) -> Outs:
    child, log = "", 0

    def add(*digits: int) -> None:
        nonlocal log
        for digit in digits:
            log = (log * 3 + digit) % 997

    for row in rows:
        u = int(row["u"])
        left = 5 if child == "X" else 6
        if not child:
            add(4, 7)
            child = "X"
        else:
            add(2)
            if u == 1:
                add(left, 1, 7)
                child = "X"
            elif u == 2:
                add(left, 2, 8)
                child = "Y"
            elif u == 3:
                add(left, 9, 4, 7)
                child = "X"
            else:
                add(10)
        yield (log,)


BRANCHES = ChartText(
    "branches",
    """
    in u uint8
    out n int32
    out last int32
    function y = odd_even(a)
        takes a uint8
        gives y int32
        local i int32
        junction head
        junction body
        junction odd
        junction join
        junction end
        -> head: {i = 0; y = 0;}
        head -> body: [i < 12]
        head -> end
        body -> odd: [(i + a) %% 3 == 1]/y = y + a;
        body -> join: {y = y + 1;}
        odd -> join: [y > 40]{y = y - 40;}
        odd -> join: {y = y * 2;}
        join -> end: [y == 9]
        join -> head: {i++;}
    -> A
    state A: du: n = odd_even(u);
    """,
)


def _branches(rows: Iterable[Row]) -> Outs:
    first = True
    for row in rows:
        u, y, i = int(row["u"]), 0, 0
        while i < 12 and not first:
            if (i + u) % 3 == 1:
                y += u
                y = y - 40 if y > 40 else y * 2
            else:
                y += 1
            if y == 9:
                break
            i += 1
        first = False
        yield y, 0


SEMANTICS = (
    Known(STOPWATCH, {"START": (0, 0, 0, 1), "LAP": (0, 0, 0, 1), "TIC": (0, 1)}, _stopwatch, 400),
    Known(BACKTRACKING, {"u": (0, 1, 2, 3, -1)}, _backtracking),
    Known(LOOP, {"u": (0, 1, 2, 3, 4, 5)}, _loop),
    Known(INNER, {"u": (0, 1, 2, 3)}, _inner),
    Known(BRANCHES, {"u": (0, 1, 2, 3, 7, 20)}, _branches, 40),
)
