"""The examples by which the manual of Stateflow teaches, written anew, each with a simulation by hand."""

from collections.abc import Iterable, Iterator

from rovercheck.spec_model.lang.domain import fixed
from tests.simulink.known.models import Known, Row
from tests.simulink.known.packages import ChartText

Outs = Iterator[tuple[float, ...]]

SHIFT_LOGIC = ChartText(
    "shift_logic",
    """
    in speed uint8
    in up_th uint8
    in down_th uint8
    out gear uint8
    event UP
    event DOWN
    constant TWAIT double = 2
    region gear_state: %% the gears themselves
        -> first
        state first: entry: gear = 1;
        state second:en:gear=2;
        state third/
            en: gear = 3;
        state fourth: entry:\\n  gear = 4;\\n
        first -> second: UP
        second -> third: UP
        second -2-> first: DOWN
        third -> fourth: UP
        third -2-> second: DOWN
        fourth -> third: DOWN
    region selection_state
        -> steady_state
        state steady_state
        state upshifting
        state downshifting
        steady_state -> downshifting: [speed < down_th]
        steady_state -> upshifting: [speed > up_th]
        upshifting -> steady_state: [speed <= up_th] /* too slow again */
        upshifting -> steady_state: after(TWAIT,tick)...\\n[speed > up_th]\\n{gear_state.UP}
        downshifting -> steady_state: [speed >= down_th]
        downshifting -> steady_state: after(TWAIT, tick) [speed < down_th] {send(DOWN, gear_state);}
    """.replace("\n            en: gear = 3;", "\\nen: gear = 3;"),
    "C",
    "0.04",
)


def _shift_logic(rows: Iterable[Row]) -> Outs:
    gear, mode, ticks = 0, "", 0
    for row in rows:
        speed, up, down = row["speed"], row["up_th"], row["down_th"]
        ticks += 1
        before = mode
        if not gear:
            gear, mode = 1, "steady"
        elif mode == "steady":
            mode = "down" if speed < down else "up" if speed > up else "steady"
        elif mode == "up" and speed <= up:
            mode = "steady"
        elif mode == "up" and ticks >= 2:
            gear, mode = min(4, gear + 1), "steady"
        elif mode == "down" and speed >= down:
            mode = "steady"
        elif mode == "down" and ticks >= 2:
            gear, mode = max(1, gear - 1), "steady"
        if mode != before:
            ticks = 0
        yield (gear,)


BOILER = ChartText(
    "boiler",
    """
    in temp int16
    out boiler boolean
    out LED uint8
    out color uint8
    local reference int16 = 20
    constant OFF uint8 = 0
    constant RED uint8 = 1
    constant GREEN uint8 = 2
    constant ON uint8 = 1
    function flash_LED()
        junction f
        junction e
        -> f
        f -> e: [LED == OFF]{LED = color;}
        f -> e: {LED = OFF;}
    function turn_boiler(mode)
        takes mode uint8
        junction g
        junction h
        -> g
        g -> h: [mode == ON]{boiler = 1;}
        g -> h: {boiler = 0;}
    function y = cold()
        gives y boolean
        junction k
        -> k: {y = temp <= reference;}
    function y = warm()
        gives y boolean
        junction l
        -> l: {y = temp > reference;}
    -> Off
    state Off: entry: turn_boiler(OFF), color = RED;\\non every(5,sec): flash_LED();
    state On: entry: turn_boiler(ON);\\ndu: color = GREEN;\\non every(1,sec): flash_LED();\\nex: color = RED
        -> HIGH
        state HIGH
        state NORM
        history H
        junction q
        HIGH -> NORM: [warm()]
        NORM -> HIGH: [temp < reference - 4]
    Off -> On: after(8,sec)[cold()]
    On -> Off: after(20,sec)
    On -> Off: [warm() && in(NORM)]
    """,
    "C",
    "1",
)


def _boiler(rows: Iterable[Row]) -> Outs:
    state, child, last, ticks = "", "", "", 0
    boiler, led, color = 0, 0, 0
    for row in rows:
        temp = row["temp"]
        warm = temp > 20
        ticks += 1
        if not state or (state == "On" and (ticks >= 20 or (warm and child == "NORM"))):
            state, ticks, boiler, color = "Off", 0, 0, 1
        elif state == "Off" and ticks >= 8 and not warm:
            state, ticks, boiler = "On", 0, 1
            child = last or "HIGH"
        elif state == "Off":
            if ticks % 5 == 0:
                led = color if led == 0 else 0
        else:
            color = 2
            led = color if led == 0 else 0
            child = last = "NORM" if child == "HIGH" and warm else child
            if state == "On" and child == "NORM" and not warm and temp < 16:
                child = "HIGH"
            last = child
        if state == "Off" and ticks == 0:
            pass
        yield boiler, led, color


TRAFFIC = ChartText(
    "traffic",
    """
    in cars uint8
    in walk boolean
    out ns uint8
    out ew uint8
    out dont boolean
    -> Stop
    local n uint8
    state Stop: en: ns = 0; ew = 0; dont = true;
    subchart StopTraffic
        -> Red
        state Red: en: ns = 0; ew = 2; n = 0;\\ndu: n = n + 1;
        state RedAmber: en: ns = 1;
        Red -> RedAmber: [cars > 0 && after(3, tick) || n == 9]
    state GoTraffic: en: ns = 2; ew = 0;\\non after(2, tick): dont = ~walk;
        -> Green
        state Green
        state Yellow: en: ns = 1; ex: n = 0;
        Green -> Yellow: [after(4, tick) && (cars == 0 || after(7, tick))]
    Stop -> StopTraffic: after(2, tick)
    RedAmber -> GoTraffic: after(1, tick)
    Yellow -> StopTraffic: [after(2, tick)]{dont = true;}
    GoTraffic -> Stop: [cars == 7]
    """,
    "MATLAB",
)


def _traffic(rows: Iterable[Row]) -> Outs:
    state, ns, ew, dont, n, ticks, outer = "", 0, 0, 0, 0, 0, 0
    for row in rows:
        cars, walk = row["cars"], row["walk"]
        ticks += 1
        outer += 1
        if not state or (state in ("Green", "Yellow") and cars == 7):
            if state == "Yellow":
                n = 0
            state, ns, ew, dont, ticks, outer = "Stop", 0, 0, 1, 0, 0
        elif state == "Stop" and ticks >= 2:
            state, ns, ew, n, ticks, outer = "Red", 0, 2, 0, 0, 0
        elif state == "Red":
            if (cars > 0 and ticks >= 3) or n == 9:
                state, ns, ticks = "RedAmber", 1, 0
            else:
                n += 1
        elif state == "RedAmber" and ticks >= 1:
            state, ns, ew, ticks, outer = "Green", 2, 0, 0, 0
        elif state in ("Green", "Yellow"):
            if outer >= 2:
                dont = int(not walk)
            if state == "Green" and ticks >= 4 and (cars == 0 or ticks >= 7):
                state, ns, ticks = "Yellow", 1, 0
            elif state == "Yellow" and ticks >= 2:
                n = dont = 1
                state, ns, ew, n, ticks, outer = "Red", 0, 2, 0, 0, 0
        yield ns, ew, dont


DEBOUNCER = ChartText(
    "debouncer",
    """
    in sw double
    out out double
    out mode uint8
    event E
    local cnt int8
    -> Off
    state Off: en: out = 0; mode = 0;
    state On: en: out = 1; mode = 1;
    state Debounce: en: mode = 2; cnt = 0;\\nduring: cnt = cnt + 1;
        -> j
        junction j
        state Zero
        state Pos
        state Neg
        history H
        j -> Zero: [abs(sw) < 0.1]
        j -> Pos: [sw > 0]
        j -> Neg
        Zero -> Pos: [sw >= 0.1]
        Zero -> Neg: [sw <= -0.1]
        Pos -> Zero: [sw < 0.1]
        Neg -> Zero: [sw > -0.1]
    Off -> Debounce: [sw >= 0.1 || sw <= -0.1]
    On -> Debounce: [abs(sw) < 0.1]
    Pos -> On: [after(0.3, sec)]
    Neg -> Off: after(300, msec)
    Zero -> Off: [temporalCount(msec) >= 500]
    Debounce -> Off: [cnt >= 12]
    """.replace("        history H\n", ""),
    "MATLAB",
    "0.1",
)


def _debouncer(rows: Iterable[Row]) -> Outs:
    state, out, mode, cnt, ticks = "", 0, 0, 0, 0
    for row in rows:
        sw = row["sw"]
        ticks += 1
        band = "Zero" if abs(sw) < 0.1 else "Pos" if sw > 0 else "Neg"
        go = state
        if not state:
            go = "Off"
        elif (state == "Off" and (sw >= 0.1 or sw <= -0.1)) or (state == "On" and abs(sw) < 0.1):
            go = band
        elif state in ("Zero", "Pos", "Neg"):
            if cnt >= 12:
                go = "Off"
            else:
                cnt += 1
                if state == "Zero":
                    go = "Pos" if sw >= 0.1 else "Neg" if sw <= -0.1 else "Off" if ticks >= 5 else "Zero"
                elif state == "Pos":
                    go = "Zero" if sw < 0.1 else "On" if ticks >= 3 else "Pos"
                else:
                    go = "Zero" if sw > -0.1 else "Off" if ticks >= 3 else "Neg"
        if go != state:
            ticks = 0
            if go in ("Zero", "Pos", "Neg") and state not in ("Zero", "Pos", "Neg"):
                mode, cnt = 2, 0
            elif go == "Off":
                out = mode = 0
            elif go == "On":
                out = mode = 1
        state = go
        yield float(out), mode


MACHINES = (
    Known(SHIFT_LOGIC, {"speed": (10, 20, 30, 40), "up_th": (15, 25), "down_th": (5, 15)}, _shift_logic, 300),
    Known(BOILER, {"temp": (5, 14, 17, 19, 20, 25)}, _boiler, 400),
    Known(TRAFFIC, {"cars": (0, 1, 1, 1, 1, 1, 7), "walk": (0, 1)}, _traffic, 400),
    Known(DEBOUNCER, {"sw": (0.5, 0.5, 0.5, 0, 0.05, -0.5)}, _debouncer, 400, {"sw": fixed(-1, 1, "0.05")}),
)
