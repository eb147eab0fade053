"""Appliances as courses on Stateflow draw them, each with a simulation by hand."""

from collections.abc import Iterable, Iterator

from tests.simulink.known.models import Known, Row
from tests.simulink.known.packages import ChartText

Outs = Iterator[tuple[float, ...]]

WINDOW = ChartText(
    "window",
    """
    in up boolean
    in down boolean
    in obstacle boolean
    in endstop boolean
    out moveUp boolean
    out moveDown boolean
    -> safe
    state safe: en: moveUp = false; moveDown = false;\\nex: moveUp = false, moveDown = false
        -> neutral
        state neutral: en: moveUp = 0; moveDown = 0;
        state moving
            junction start
            -> start
            start -> auto_up: [up]
            start -> auto_down
            state auto_up: en: moveUp = 1; moveDown = 0;
            state auto_down: en: moveDown = 1; moveUp = 0;
            state hold_up: en: moveUp = 1;
            auto_up -> hold_up: after(3, tick)[up]
            auto_up -> auto_down: [down && !up]
        moving -> neutral: [endstop || (in(hold_up) && !up)]
        neutral -> moving: [up != down]
        safe -> neutral: [up && down]/* both */{moveUp = 0; moveDown = 0;}
    state emergency: entry: moveDown = 1; moveUp = 0;\\nexit: moveDown = 0;
    moving -> emergency: [obstacle && moveUp]
    emergency -> safe: [endstop]
    emergency -> safe: after(4, tick)
    """,
    "C",
)


def _window(rows: Iterable[Row]) -> Outs:
    state, up_out, down_out, ticks = "", 0, 0, 0
    for row in rows:
        up, down, stop = row["up"], row["down"], row["endstop"]
        ticks += 1
        go = ""
        if not state:
            go = "neutral"
        elif state == "emergency":
            if stop or ticks >= 4:
                go = "neutral"
                down_out = 0
        elif up and down:  # the inner transition comes before the children
            go = "neutral"
        elif state == "neutral":
            if up != down:
                go = "auto_up" if up else "auto_down"
        elif stop or (state == "hold_up" and not up):
            go = "neutral"
        elif row["obstacle"] and up_out:
            go = "emergency"
        elif state == "auto_up" and ticks >= 3 and up:
            go = "hold_up"
        elif state == "auto_up" and down and not up:
            go = "auto_down"
        if go:
            state, ticks = go, 0
            up_out = int(go in ("auto_up", "hold_up"))
            down_out = int(go in ("auto_down", "emergency"))
        yield up_out, down_out


WASHER = ChartText(
    "washer",
    """
    in start boolean
    in door boolean
    in prog uint8
    out phase Enum: Phase
    out motor int8
    out minutes int16 = 0
    local cycles int8 = 0
    -> Idle
    state Idle: en: phase = Phase.IDLE; motor = int8(0); minutes = 0;
    subchart Busy: du: minutes = minutes + 1;\\nex: motor(:) = 0;
        -> Fill: {switch prog, case {1, 2}, cycles = 2; case 3, cycles = 1; otherwise, cycles = 0; end}
        state Fill: en: phase = Phase.FILL;
        state Wash: en:\\nphase = WASH; %% both\\nmotor = int8(1);\\non every(2, tick): motor = -motor;
        state Spin: en: phase = SPIN;\\nmotor = int8(100)
        history H
        Fill -> Wash: after(2, tick)
        Wash -> Fill: [after(4, tick) && cycles > 0]...\\n{cycles = cycles - 1;}
        Wash -> Spin: after(4, tick)
        Spin -> Done: [after(3, tick)]
    state Paused: en: phase = Phase.PAUSED;
    state Done: entry, during: phase = Phase.DONE; if door, minutes = -1; end
    Idle -> Busy: [start && ~door]{minutes = 0;}
    Busy -> Paused: [door]
    Paused -> Busy: [~door && start]
    Done -> Idle: [door]
    """,
    "MATLAB",
    files={
        "Phase.m": "classdef Phase < Simulink.IntEnumType\n  % phases\n  enumeration\n    IDLE(0)\n"
        "    FILL (1)\n"
        "    WASH(2)  % the long one\n    SPIN(5)\n    PAUSED(7), DONE(9)\n  end\nend\n"
    },
)


def _washer(rows: Iterable[Row]) -> Outs:
    state, last, motor, minutes, cycles, ticks, phase = "", "", 0, 0, 0, 0, 0
    for row in rows:
        start, door = row["start"], row["door"]
        ticks += 1
        go = ""
        if not state or (state == "Done" and door):
            go = "Idle"
        elif state == "Idle" and start and not door:
            minutes, go = 0, "Busy"
        elif state in ("Fill", "Wash", "Spin"):
            if door:
                go, last, motor = "Paused", state, 0
            else:
                minutes += 1
                if state == "Fill" and ticks >= 2:
                    go = "Wash"
                elif state == "Wash" and ticks >= 4 and cycles > 0:
                    cycles, go = cycles - 1, "Fill"
                elif state == "Wash" and ticks >= 4:
                    go = "Spin"
                elif state == "Wash" and ticks % 2 == 0:
                    motor = -motor
                elif state == "Spin" and ticks >= 3:
                    go, last, motor = "Done", "Spin", 0
        elif state == "Paused" and start and not door:
            go = "Busy"
        elif state == "Done":
            phase = 9
        if go == "Busy":
            if last:
                go = last
            else:
                cycles, go = {1: 2, 2: 2, 3: 1}.get(int(row["prog"]), 0), "Fill"
        if go:
            state, ticks = go, 0
            phase = {"Idle": 0, "Fill": 1, "Wash": 2, "Spin": 5, "Paused": 7, "Done": 9}[go]
            if go == "Idle":
                motor = minutes = 0
            elif go == "Wash":
                motor = 1
            elif go == "Spin":
                motor = 100
            elif go == "Done" and door:
                minutes = -1
        yield phase, motor, minutes


VENDING = ChartText(
    "vending",
    """
    in coin uint8
    in choice uint8
    out credit uint16
    out change uint16
    out stock[3] uint8 = 2
    local price[3] uint16 = [20 35 50]
    local i int32
    constant NONE uint8 = 0
    function r = worth(c)
        takes c uint8
        gives r uint16
        junction a
        junction b
        -> a
        a -> b: [c == 1]{r = 5;}
        a -> b: [c == 2]{r = 10;}
        a -> b: [c == 0x3]{r = 50u;}
        a -> b: {r = 0;}
    function sell(k)
        takes k int32
        junction p
        junction q
        junction n
        -> p
        p -> q: [stock[k] > 0 && credit >= price[k]]{stock[k]--; credit -= price[k];}
        q -> n: {change = credit; credit = 0;}
    -> Wait
    state Wait: en: change = 0; du: credit = credit + worth(coin);
    state Sold
    junction loop
    Wait -> loop: [choice != NONE]{i = 0;}
    loop -> loop: [i < 3 && i != choice - 1]{i++;}
    loop -> Sold: [i < 3]{sell(i);}/i = 100;
    Sold -> Wait: [choice == NONE]
    """,
)


def _vending(rows: Iterable[Row]) -> Outs:
    state, credit, change, stock = "", 0, 0, [2, 2, 2]
    for row in rows:
        coin, choice = int(row["coin"]), int(row["choice"])
        if not state:
            state = "Wait"
        elif state == "Wait":
            if 1 <= choice <= 3:
                price = (20, 35, 50)[choice - 1]
                if stock[choice - 1] and credit >= price:
                    stock[choice - 1] -= 1
                    change, credit = credit - price, 0
                state = "Sold"
            else:
                credit = (credit + {1: 5, 2: 10, 3: 50}.get(coin, 0)) % 65536
        elif choice == 0:
            state, change = "Wait", 0
        yield credit, change, *stock


APPLIANCES = (
    Known(WINDOW, {name: (0, 0, 1) for name in ("up", "down", "obstacle", "endstop")}, _window, 400),
    Known(WASHER, {"start": (0, 1), "door": (0, 0, 0, 0, 0, 1), "prog": (0, 1, 2, 3)}, _washer, 400),
    Known(VENDING, {"coin": (0, 1, 2, 3), "choice": (0, 0, 0, 1, 2, 3, 4)}, _vending, 300),
)  # fmt: skip
