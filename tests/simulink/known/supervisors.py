"""Supervisors as companies draw them: regions in regions, MATLAB functions with memory, single precision."""

from collections.abc import Iterable, Iterator
from struct import pack, unpack

from rovercheck.spec_model.lang.domain import fixed
from tests.simulink.known.models import Known, Row
from tests.simulink.known.packages import ChartText

Outs = Iterator[tuple[float, ...]]

FUEL = ChartText(
    "fuel",
    """
    in throttle int16
    in speed int16
    in ego int16
    in press int16
    out mode uint8
    out fails uint8
    out o2_normal boolean
    constant max_ego int16 = 12
    constant zero_thresh int16 = 250
    parameter max_press int16
    event INC
    event DEC
    region O2
        -> O2_warmup
        state O2_warmup: entry: o2_normal = false;
        state O2_normal: entry: o2_normal = true;\\nexit: o2_normal = false;
        state O2_fail: entry: Fail.INC\\nexit: Fail.DEC
        O2_warmup -> O2_normal: after(4, tick)
        O2_normal -> O2_fail: [ego > max_ego]
        O2_fail -> O2_normal: [ego < max_ego]
    region Pressure
        -> press_norm
        state press_norm
        state press_fail: entry: Fail.INC;\\nexit: Fail.DEC;
        press_norm -> press_fail: [press > max_press || press < 2]
        press_fail -> press_norm: [press > 2 && press < max_press]{}
    region Throttle
        -> throt_norm
        state throt_norm
        state throt_fail: en: Fail.INC; ex: Fail.DEC;
        throt_norm -> throt_fail: [throttle>90|throttle<3]
        throt_fail -> throt_norm: [throttle>3&throttle<90]
    region Speed
        -> speed_norm
        state speed_norm
        state speed_fail: en: Fail.INC;\\nex: Fail.DEC;
        speed_norm -> speed_fail: [speed==0 & press < zero_thresh]
        speed_fail -> speed_norm: [speed > 0]
    region Fail
        -> None
        state None: entry: fails = 0;
        state One: entry: fails = 1;
        state Multi
            -> Two
            state Two: entry: fails = 2;
            state Three: entry: fails = 3;
            state Four: en: fails = 4;
            Two -> Three: INC
            Three -> Two: DEC
            Three -> Four: INC
            Four -> Three: DEC
        None -> One: INC
        One -> None: DEC
        One -> Two: INC
        Two -> One: DEC
    region Fueling_Mode
        -> Running
        state Running
            -> Low_Emissions
            state Low_Emissions
                -> Warmup
                state Warmup: en: mode = 1;
                state Normal: en: mode = 2;
                history H
                Warmup -> Normal: [in(O2.O2_normal)]
            state Rich_Mixture
                -> Single_Failure
                state Single_Failure: en: mode = 3;
            Low_Emissions -> Rich_Mixture: [in(Fail.One)]
            Rich_Mixture -> Low_Emissions: [in(Fail.None)]
        state Fuel_Disabled: en: mode = 0;
            -> Shutdown
            state Overspeed
            state Shutdown
            Overspeed -> Shutdown: [in(Fail.Multi)]
        Running -> Shutdown: [in(Fail.Multi)]
        Running -> Overspeed: [in(Speed.speed_norm) && speed > 600]
        Overspeed -> Running: [in(Speed.speed_norm) && speed < 500]
        Shutdown -> Rich_Mixture: [!in(Fail.Multi)]
    """,
    "C",
    "0.01",
    files={"limits.m": "% limits of the sensors\nmax_press = int16(100); "},
)


def _fuel(rows: Iterable[Row]) -> Outs:
    first, o2, ticks, press, throt, spd = True, "warmup", 0, False, False, False
    fails, mode, sub, warm = 0, "Low", "", "Warmup"
    shown = 0
    for row in rows:
        ticks += 1
        if first:
            first, shown, ticks = False, 1, 0
            yield shown, 0, 0
            continue
        count = fails
        if o2 == "warmup" and ticks >= 4:
            o2 = "normal"
        elif o2 == "normal" and row["ego"] > 12:
            o2, count = "fail", count + 1
        elif o2 == "fail" and row["ego"] < 12:
            o2, count = "normal", count - 1
        if not press and (row["press"] > 100 or row["press"] < 2):
            press, count = True, count + 1
        elif press and 2 < row["press"] < 100:
            press, count = False, count - 1
        if not throt and (row["throttle"] > 90 or row["throttle"] < 3):
            throt, count = True, count + 1
        elif throt and 3 < row["throttle"] < 90:
            throt, count = False, count - 1
        if not spd and row["speed"] == 0 and row["press"] < 250:
            spd, count = True, count + 1
        elif spd and row["speed"] > 0:
            spd, count = False, count - 1
        fails = count
        if mode in ("Low", "Rich"):
            if fails >= 2:
                mode, sub, shown = "Disabled", "Shutdown", 0
            elif not spd and row["speed"] > 600:
                mode, sub, shown = "Disabled", "Overspeed", 0
            elif mode == "Low":
                if fails == 1:
                    mode, shown = "Rich", 3
                elif warm == "Warmup" and o2 == "normal":
                    warm, shown = "Normal", 2
            elif fails == 0:
                mode, shown = "Low", 1 if warm == "Warmup" else 2
        elif sub == "Overspeed":
            if fails >= 2:
                sub = "Shutdown"
            elif not spd and row["speed"] < 500:
                mode, shown = "Low", 1 if warm == "Warmup" else 2
        elif fails < 2:
            mode, shown = "Rich", 3
        yield shown, fails, int(o2 == "normal")


RING = ChartText(
    "ring",
    """
    in x int8
    in push boolean
    out mean int8
    out full boolean
    out level uint8
    function [m, f] = ring(v, keep)
        takes v Inherit: From definition in chart
        takes keep boolean
        gives m Inherit: From definition in chart
        gives f boolean
        script %%SCRIPT%%
    -> Wait
    state Wait: entry: level = uint8(0);
    state Fill
        during:
    Wait -> Fill: [push]{[mean, full] = ring(x, true);}
    Fill -> Fill: [push && ~full]{...\\n[mean, full] = ring(x, push); level = level + 1;}
    Fill -> Wait: [full && push]{[mean, ~] = ring(x, false);}
    """.replace("        during:\n", ""),
    "MATLAB",
)
SCRIPT = """function [m, f] = ring(v, keep)
%#codegen
% a ring of four values
persistent buf n at; % what is kept
if isempty(buf)
    buf = zeros(1, 4, 'int8'); n = uint8(0); at = 1;
end
if ~keep
    n = uint8(0); at = 1; buf(:) = 0;
    m = int8(0); f = false;
    return
end
buf(at) = v;
at = next(at);
n = min(n + 1, uint8(4));
total = int16(0);
for k = 1:numel(buf)
    if k > n, continue; end
    total = total + int16(buf(k));
end
m = int8(total / int16(n));
f = n >= 4;
end

function y = next(x)
y = mod(x, 4) + 1;
end
"""
RING.text = RING.text.replace("%%SCRIPT%%", SCRIPT.replace("\n", "\\n"))


def _ring(rows: Iterable[Row]) -> Outs:
    state, buf, mean, full, level = "", list[int](), 0, 0, 0
    for row in rows:
        if not state:
            state = "Wait"
        elif (state == "Wait" and row["push"]) or (state == "Fill" and row["push"] and not full):
            level += state == "Fill"
            buf = [*buf, int(row["x"])][-4:]
            total = sum(buf)
            mean = (2 * abs(total) + len(buf)) // (2 * len(buf)) * (1 if total >= 0 else -1)
            full, state = int(len(buf) >= 4), "Fill"
        elif state == "Fill" and full and row["push"]:
            buf, mean, state, level = [], 0, "Wait", 0
        yield mean, full, level


SINGLE = ChartText(
    "single",
    """
    in u single
    in rate single
    out y single
    out high boolean
    local acc single = 0
    -> Integrate
    state Integrate
        during:
    state Hold: en: acc = single(0); y = acc; high = false;
    Integrate -> Hold: [acc >= 0.3 || acc < -0.3]
    Hold -> Integrate: [u < 0.1]{acc = acc + rate * 0.5; y = acc;}
    Integrate -> Integrate: [rate > 0]{acc = acc + u * single(0.25); high = acc > 0.1; y = acc;}
    """.replace("        during:\n", ""),
    "MATLAB",
)


def _f32(value: float) -> float:
    found: float = unpack("f", pack("f", value))[0]
    return found


def _single(rows: Iterable[Row]) -> Outs:
    state, acc, y, high = "", 0.0, 0.0, 0
    for row in rows:
        u, rate = row["u"], row["rate"]
        if not state:
            state = "I"
        elif state == "I" and (acc >= _f32(0.3) or acc < -_f32(0.3)):
            state, acc, y, high = "H", 0.0, 0.0, 0
        elif state == "I" and rate > 0:
            acc = y = _f32(acc + _f32(u * 0.25))
            high = int(acc > _f32(0.1))
        elif state == "H" and u < _f32(0.1):
            acc = y = _f32(acc + _f32(rate * 0.5))
            state = "I"
        yield y, high


SUPERVISORS = (
    Known(
        FUEL,
        {
            "throttle": (2, 50, 50, 50, 95), "speed": (0, 300, 300, 700, 450), "ego": (5, 5, 5, 13),
            "press": (50, 50, 50, 50, 120),
        },
        _fuel, 400,
    ),
    Known(RING, {"x": (-3, 0, 1, 5, 100), "push": (0, 1, 1)}, _ring, 300),
    Known(
        SINGLE, {"u": (-0.5, 0, 0.25, 0.5), "rate": (0, 0.25, 0.5)}, _single, 200,
        {"u": fixed(-1, 1, "0.25"), "rate": fixed(0, 1, "0.25"), "acc": fixed(-1, 1, "0.0625")},
    ),
)  # fmt: skip
