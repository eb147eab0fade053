"""A lift, an abort system and a checksum as courses on Stateflow draw them, each simulated by hand."""

from collections.abc import Iterable, Iterator, Sequence

from tests.simulink.known.models import Known, Row
from tests.simulink.known.packages import ChartText

Outs = Iterator[tuple[float, ...]]

ELEVATOR = ChartText(
    "elevator",
    """
    in calls[4] boolean
    in closed boolean
    out floor_ uint8 = 1
    out dir int8
    out open boolean
    local wanted[4] boolean = [false false false false]
    function d = next(w, at, before)
        takes w[4] boolean
        takes at uint8
        takes before int8
        gives d int8
        script %%SCRIPT%%
    -> Rest
    state Rest: en: dir = int8(0);
    state Move: on every(2, tick): floor_ = floor_ + double(dir);
    state Open: en: open = true; wanted(floor_) = false;\\nex: open = false;
    Rest -> Open: [latch() && wanted(floor_)]
    Rest -> Move: [any(wanted)]{dir = next(wanted, floor_, dir);}
    Move -> Open: [latch() && wanted(floor_) && temporalCount(tick) >= 2]
    Open -> Rest: [after(2, tick) && closed && latch() && ~any(wanted)]
    Open -> Move: [after(2, tick) && closed && latch() && any(wanted)]{dir = next(wanted, floor_, dir);}
    function y = latch()
        gives y boolean
        script function y = latch()\\nfor k = 1:4\\nwanted(k) = wanted(k) || calls(k);\\nend\\ny = true;\\nend
    """.replace(
        "%%SCRIPT%%",
        "function d = next(w, at, before)\\nabove = false; below = false;\\nfor k = 1:4\\n"
        "  if w(k) && k > at, above = true; end\\n  if w(k) && k < at\\n    below = true;\\n  end\\nend\\n"
        "switch before\\n  case 1\\n    if above, d = int8(1); else d = int8(-1); end\\n"
        "  case -1\\n    if below, d = int8(-1); else, d = int8(1); end\\n  otherwise\\n"
        "    d = int8(above) - int8(~above & below);\\nend",
    ),
    "MATLAB",
)


def _next(wanted: Sequence[bool], at: int, before: int) -> int:
    above, below = any(wanted[at:]), any(wanted[: at - 1])
    if before == 1:
        return 1 if above else -1
    if before == -1:
        return -1 if below else 1
    return int(above) - int(not above and below)


def _elevator(rows: Iterable[Row]) -> Outs:
    state, at, go, opened, wanted, ticks = "", 1, 0, 0, [False] * 4, 0
    for row in rows:
        calls = [bool(row[f"calls({k})"]) for k in range(1, 5)]
        ticks += 1
        to = ""
        if not state:
            to = "Rest"
        elif state == "Rest":
            wanted = [a or b for a, b in zip(wanted, calls, strict=True)]
            if wanted[at - 1]:
                to = "Open"
            elif any(wanted):
                go, to = _next(wanted, at, go), "Move"
        elif state == "Move":
            wanted = [a or b for a, b in zip(wanted, calls, strict=True)]
            if wanted[at - 1] and ticks >= 2:
                to = "Open"
            elif ticks % 2 == 0:
                at += go
        elif ticks >= 2 and row["closed"]:
            wanted = [a or b for a, b in zip(wanted, calls, strict=True)]
            if any(wanted):
                go = _next(wanted, at, go)
                to = "Move"
            else:
                to = "Rest"
            opened = 0
        if to:
            state, ticks = to, 0
            if to == "Rest":
                go = 0
            elif to == "Open":
                opened = 1
                wanted[at - 1] = False
        yield at, go, opened


CHECKSUM = ChartText(
    "checksum",
    """
    in byte_ uint8
    in valid boolean
    out crc uint8
    out reg uint16
    out bad boolean
    local k uint8
    local n uint8
    -> Idle
    state Idle: en: crc = 0xFF; n = 0;
    state Run: du: reg = (reg << 1) | (byte_ & 0x01); reg ^= 0x8001; reg &= ~0x10;
    junction head
    junction body
    junction shift
    junction end
    Idle -> Run: [valid]
    Run -> head: [valid]{crc ^= byte_; k = 0; n++;}
    head -> body: [k < 5]
    head -> Idle: [n > 3]{bad = crc & 0x80;}
    head -> end
    body -> shift: [(crc & 0x80) != 0]{crc = (crc << 1) ^ 0x31;}
    body -> shift: {crc <<= 1;}
    shift -> head: {k = k + 1;}
    """.replace("crc <<= 1;", "crc = crc << 1;"),
)


def _checksum(rows: Iterable[Row]) -> Outs:
    state, crc, reg, bad, n = "", 0, 0, 0, 0
    for row in rows:
        byte, valid = int(row["byte_"]), row["valid"]
        if not state:
            state, crc, n = "Idle", 255, 0
        elif state == "Idle":
            if valid:
                state = "Run"
        else:
            back = False
            if valid:
                crc ^= byte
                n += 1
                for _ in range(5):
                    crc = ((crc << 1) ^ (0x31 if crc & 0x80 else 0)) & 255
                if n > 3:
                    bad, back = int(bool(crc & 0x80)), True
                    state, crc, n = "Idle", 255, 0
            if not back:
                reg = ((((reg << 1) | (byte & 1)) & 0xFFFF) ^ 0x8001) & ~0x10 & 0xFFFF
        yield crc, reg, bad


ABORT = ChartText(
    "abort",
    """
    in go boolean
    in fault uint8
    in alt uint16
    in safe boolean
    out mode uint8
    out armed boolean
    event ABORT
    -> Pad
    state Pad: en: mode = 0; armed = false;
    subchart Flight
        region Monitor
            -> Ok
            state Ok
            state Bad
            Ok -> Bad: [duration(fault > 0) >= 0.2]
            Bad -> Ok: [fault == 0]
            Bad -> Bad: [after(3, tick)]/send(ABORT)
        region Modes
            -> Low
            state Low: en: mode = 1;\\nen: armed = true;
            state High: en: mode = 2;
            Low -> High: [alt > 100 && crossing(alt) == 0]
            Low -> Tower: ABORT
            High -> Coast: ABORT[alt > 200]
            High -> Tower: ABORT
    state Tower: en: mode = 3; armed = false;
    state Coast: en: mode = 4;
    Pad -> Flight: [go]
    Tower -> Pad: [safe]
    Coast -> Pad: [safe && alt < 50]
    Flight -> Pad: [safe && fault > 8]
    """,
    "MATLAB",
)


def _abort(rows: Iterable[Row]) -> Outs:
    state, monitor, mode, armed, held, ticks, before = "", "", 0, 0, 0, 0, None
    for row in rows:
        fault, alt, safe = row["fault"], row["alt"], row["safe"]
        crossed = before == 0 < alt  # it is never below
        before = alt
        ticks += 1
        if not state or (state in ("Low", "High") and safe and fault > 8):
            state, mode, armed = "Pad", 0, 0
        elif state == "Pad":
            if row["go"]:
                state, monitor, mode, armed, held = "Low", "Ok", 1, 1, 0
        elif state in ("Tower", "Coast"):
            if safe and (state == "Tower" or alt < 50):
                state, mode, armed = "Pad", 0, 0
        else:
            abort = False
            if monitor == "Ok":
                if fault <= 0:
                    held = 0
                if held >= 2:
                    monitor, ticks = "Bad", 0
            elif fault == 0:
                monitor, held = "Ok", 0
            elif ticks >= 3:
                abort = True
            if abort and state == "Low" and alt > 100 and not crossed:  # tried before the one on ABORT
                state, mode, ticks = "High", 2, 0
            elif abort and state == "High" and alt > 200:
                state, mode = "Coast", 4
            elif abort:
                state, mode, armed = "Tower", 3, 0
            elif state == "Low" and alt > 100 and not crossed:
                state, mode = "High", 2
        held = held + 1 if fault > 0 else 0
        yield mode, armed


CONTROLS = (
    Known(
        ELEVATOR, {**{f"calls({k})": (0, 0, 0, 0, 1) for k in range(1, 5)}, "closed": (0, 1)}, _elevator, 300
    ),
    Known(
        ABORT, {"go": (0, 1, 1), "fault": (0, 1, 1, 1, 9), "alt": (0, 10, 150, 250), "safe": (0, 0, 0, 1)},
        _abort, 400,
    ),
    Known(CHECKSUM, {"byte_": (0, 1, 0x55, 0x80, 0xFF), "valid": (0, 1, 1, 1)}, _checksum, 200),
)  # fmt: skip
