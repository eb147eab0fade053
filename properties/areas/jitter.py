"""What must be true of lengths of time where steps last 19 to 21 ms, in the milliseconds of the document.

Timers of states count executed steps: 3 s are 150 of them, whatever these last.  Where a length of the
document is missed by that, what is true is stated beside it.
"""

from collections.abc import Iterable

from rovercheck.properties.areas import battery, temperature
from rovercheck.properties.areas.board2_motion import braking as braking_2
from rovercheck.properties.areas.motion import braking as braking_1
from rovercheck.properties.document import battery as flat
from rovercheck.properties.document import temperature as hot_or_cold
from rovercheck.properties.document.causes import q
from rovercheck.properties.document.sources import BLE, IMU, RX, SUP, Source
from rovercheck.properties.forms import (
    Property,
    always,
    enters_only_if,
    holds_after,
    holds_for,
    leaves_only_if,
    never,
    reachable,
)
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.board2.jitter_systems import b1_sup_age_ms
from rovercheck.spec_model.board2.obstacles import drawn_n
from rovercheck.spec_model.environment.jitter import in_a_row, rx_lag, step_ms
from rovercheck.spec_model.lang.expr import Expr, all_of, const, implies, ite
from rovercheck.spec_model.lang.time import Span, ms, sec
from rovercheck.spec_model.lang.words import held, minimum, named, once, previous
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board1_fine import heartbeat_age_ms, rx_age_ms
from rovercheck.spec_model.signals.board2 import B2Decision, obj1Detected, obj2Detected

DOCUMENT = (SUP, BLE, IMU, RX)
SAID = ("the supervisor of Board 1", "the joystick link", "the IMU", "the reception from Board 1")

# --- reception of Board 1 [spec Table 2] ----------------------------------------------------------------

CRITICAL = b1.rx_status == "RX_CRITICAL"
PB1_43a = always(
    "PB1-43a", "With jitter, the age of the last frame is its lag, else as long more as the step.",
    that=rx_age_ms == ite(
        b1.rx_update, rx_lag, minimum(ite(STEPPED, previous(rx_age_ms), const(0, "ms")) + step_ms, 121)
    ),
    covers=["B1-RX-03"], on="reception_jitter",
)  # fmt: skip
PB1_43b = always(
    "PB1-43b",
    "With jitter, the reception is critical exactly while older than 120 ms, else degraded if slow.",
    that=all_of(
        CRITICAL == (rx_age_ms > 120),
        (b1.rx_status == "RX_DEGRADED") == ((rx_age_ms <= 120) & b1.rx_slow),
    ),
    covers=["B1-RX-05", "B1-RX-03"], on="reception_jitter", from_tick=2,
    interpretations=["S34", "S37", "S38"],
)  # fmt: skip
PB1_43c = always(
    "PB1-43c", "With jitter, the last frame is 19 to 21 ms old for each one lost since, up to 20 ms more.",
    that=(rx_age_ms + const(18, "ms") >= minimum(in_a_row * const(19, "ms"), 121))  # from power-up: 1 ms
    & (rx_age_ms <= in_a_row * const(21, "ms") + const(20, "ms")),
    covers=["B1-RX-03"], on="frames_jitter",
)  # fmt: skip


def _lost(id: str, frames: int) -> Property:
    return always(
        id, f"With jitter on both boards, at most {frames} frames lost in a row are not critical.",
        that=implies(~once(in_a_row > frames), ~CRITICAL),
        covers=["B1-RX-03"], on="frames_jitter", from_tick=2, interpretations=["S37"],
    )  # fmt: skip


PB1_43d = _lost("PB1-43d", 5)
PB1_43e = _lost("PB1-43e", 4)

# --- the relay, the authorisation [spec §2.5, Fig 16] ---------------------------------------------------

heard = named("frames and heartbeats came within 120 ms", (rx_age_ms <= 120) & (heartbeat_age_ms <= 120))
uncritical = named("neither link is critical", ~CRITICAL & (b1.b2_sup_status != "SUP_CRITICAL"))
RELAY, SILENCE = "relay_jitter", "relay_silence_jitter"
REQUIRED, LEAST, MOST = 3 * sec, 2869 * ms, 3171 * ms
"""3 s are 151 steps, which last 2.869 to 3.171 s."""

PB1_44a = leaves_only_if(
    "PB1-44a",
    "With jitter, Board 1 takes the motors back only if for 3 s frames and heartbeats came within "
    "120 ms.",
    leaving=b1.give_b2_actuation, only_if=held(heard, for_=REQUIRED),
    covers=["B1-REL-04"], on=SILENCE, from_tick=2, interpretations=["S37", "S45"],
)  # fmt: skip
PB1_44b = leaves_only_if(
    "PB1-44b",
    "With jitter, Board 1 takes the motors back only if for 2.869 s no link was critical.",
    leaving=b1.give_b2_actuation, only_if=held(uncritical, for_=LEAST),
    covers=["B1-REL-04"], on=RELAY, from_tick=2, interpretations=["S44", "S45"],
)  # fmt: skip
PB1_44c = holds_after(
    "PB1-44c", "With jitter, Board 1 has the motors once no link was critical for 3.171 s.",
    premise=uncritical, for_=MOST, then=~b1.give_b2_actuation,
    covers=["B1-REL-04"], on=RELAY, from_tick=2, interpretations=["S44", "S45"],
)  # fmt: skip
REACH_RELAY_EARLY = reachable(
    "REACH-RELAY-EARLY", "Board 1 can take the motors back after 2.869 s: the bound of PB1-44b is the least.",
    that=previous(b1.give_b2_actuation) & ~b1.give_b2_actuation & ~held(heard, for_=2870 * ms),
    covers=["B1-REL-04"], on=SILENCE, interpretations=["S37", "S45"],
)  # fmt: skip

autorized = b2.autorized_to_send_command
PB2_58a = leaves_only_if(
    "PB2-58a",
    "With jitter, Board 2 loses the authorisation only after 3 s without request and critical link.",
    leaving=autorized, only_if=held(~q, for_=REQUIRED),
    covers=["B2-ACT-01"], on="check_board1_requests_jitter", from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_58b = leaves_only_if(
    "PB2-58b", "With jitter, Board 2 loses the authorisation only after 2.869 s without either.",
    leaving=autorized, only_if=held(~q, for_=LEAST),
    covers=["B2-ACT-01"], on="check_board1_jitter", from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_58c = holds_after(
    "PB2-58c", "With jitter, Board 2 is not authorised once there was neither for 3.171 s.",
    premise=~q, for_=MOST, then=~autorized,
    covers=["B2-ACT-01"], on="check_board1_jitter", from_tick=2, interpretations=["E22"],
)  # fmt: skip

# --- what is held for 4 s and 5 s, measured by time stamps [spec Table 2] -------------------------------


def _held(
    numbers: str, what: str, seconds: int, critical: Expr, in_range: Expr, on: str, covers: str
) -> Iterable[Property]:
    """The length is that of the document, neither less nor more."""
    yield holds_after(
        f"PB1-45{numbers[0]}", f"With jitter, {what} critical once it was in its range for {seconds} s.",
        premise=in_range, for_=seconds * sec, then=critical, covers=[covers], on=on,
    )  # fmt: skip
    yield enters_only_if(
        f"PB1-45{numbers[1]}", f"With jitter, {what} critical only after {seconds} s in its range.",
        entering=critical, only_if=held(in_range, for_=seconds * sec), covers=[covers], on=on, from_tick=2,
    )  # fmt: skip


PB1_45a, PB1_45b = _held(
    "ab", "the temperature becomes", 4, temperature.CRITICAL, hot_or_cold.critical_range,
    "temperature_jitter", "B1-TEMP-03",
)  # fmt: skip
PB1_45c, PB1_45d = _held(
    "cd", "the battery becomes", 5, battery.CRITICAL, flat.critical_range, "battery_jitter", "B1-BATT-03",
)  # fmt: skip

# --- how long a stop lasts [spec §2.3] ------------------------------------------------------------------

PB1_46a = holds_for(
    "PB1-46a", "With jitter, an emergency stop of Board 1 lasts at least 1 s.",
    start=braking_1, that=braking_1, for_=1 * sec,
    covers=["B1-EST-01"], on="stop_jitter", from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB1_46b = holds_for(
    "PB1-46b", "With jitter, an emergency stop of Board 1 lasts at least 0.968 s.",
    start=braking_1, that=braking_1, for_=968 * ms,
    covers=["B1-EST-01"], on="references_jitter", from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB2_59a = holds_for(
    "PB2-59a", "With jitter, a stop of Board 2, deaf and on turning wheels, lasts at least 2 s.",
    start=braking_2, that=braking_2, for_=1999 * ms,
    covers=["B2-REF-01"], on="deaf_jitter", interpretations=["S62"],
)  # fmt: skip
PB2_59b = holds_for(
    "PB2-59b", "With jitter, a stop of Board 2, deaf and on turning wheels, lasts at least 1.9 s.",
    start=braking_2, that=braking_2, for_=1899 * ms,
    covers=["B2-REF-01"], on="deaf_jitter", interpretations=["S62"],
)  # fmt: skip

# --- the monitors of Board 2 [spec §3.1] ----------------------------------------------------------------

AGES = {
    SUP.region: b1_sup_age_ms,
    BLE.region: b2.ble_age_ms,
    IMU.region: b2.imu_age_ms,
    RX.region: b2.rx_age_ms,
}


def _status(source: Source, level: int) -> Expr:
    return source.status == source.levels[level]


def _silent(source: Source) -> Expr:
    return named(f"now_ms - ts > {source.limit} ms", AGES[source.region] > source.limit)


def _on(source: Source, free: bool = False) -> str:
    return f"monitors_2_{source.region}_jitter{'_free' if free else ''}"


def _at_once(id: str, source: Source, what: str) -> Property:
    return always(
        id, f"With jitter, {what}, OK and not slow, is critical once over {source.limit} ms old.",
        that=implies(previous(_status(source, 0) & ~source.deg) & _silent(source), _status(source, 2)),
        covers=["B2-FLT-01"], on=_on(source), from_tick=2,
    )  # fmt: skip


def _only_silent(id: str, source: Source, what: str) -> Property:
    return enters_only_if(
        id, f"With jitter, {what} becomes critical only when over {source.limit} ms old.",
        entering=_status(source, 2), only_if=_silent(source),
        covers=["B2-FLT-01"], on=_on(source), from_tick=2,
    )  # fmt: skip


def _recovers(id: str, source: Source, what: str, for_: Span, free: bool = False) -> Property:
    critical = _status(source, 2)
    return leaves_only_if(
        id, f"With jitter, {what} leaves critical only after {for_} with a short mean gap.",
        leaving=critical, only_if=held(previous(critical & ~source.deg), for_=for_),
        covers=["B2-FLT-01"], on=_on(source, free), from_tick=2, interpretations=["E29"],
    )  # fmt: skip


PB2_60a, PB2_60b, PB2_60c, PB2_60d = (
    _at_once(f"PB2-60{letter}", source, what)
    for letter, source, what in zip("abcd", DOCUMENT, SAID, strict=True)
)
PB2_60e, PB2_60f, PB2_60g, PB2_60h = (
    _only_silent(f"PB2-60{letter}", source, what)
    for letter, source, what in zip("efgh", DOCUMENT, SAID, strict=True)
)
WITHOUT_LOSS = "frames_2_jitter"
PB2_60m = always(
    "PB2-60m", "With jitter on both boards, without loss, the reception of Board 2 is OK.",
    that=_status(RX, 0), covers=["B2-FLT-01"], on=WITHOUT_LOSS, interpretations=["E26"],
)  # fmt: skip
PB2_60n = always(
    "PB2-60n", "With jitter on both boards, without loss, the last frame for Board 2 is at most 20 ms old.",
    that=b2.rx_age_ms <= 20, covers=["B2-FLT-01"], on=WITHOUT_LOSS,
)  # fmt: skip
PB2_60i = _recovers("PB2-60i", RX, "the reception from Board 1", 1 * sec)
PB2_60j = _recovers("PB2-60j", RX, "the reception from Board 1", 950 * ms, free=True)
PB2_60k = _recovers("PB2-60k", SUP, "the supervisor of Board 1", 2 * sec)
PB2_60l = _recovers("PB2-60l", SUP, "the supervisor of Board 1", 1900 * ms, free=True)

# --- the windows of 3 s for a passing obstacle [spec §3.4.1 (2b), Figs 24-27] ---------------------------

PASSING, WINDOW = "obstacles_passing_jitter", "obstacles_n_12_jitter"
lost_1 = named("S1 loses its object", previous(obj1Detected) & ~obj1Detected)
found_2 = named("S2 detects", obj2Detected & ~previous(obj2Detected))
toward_1 = B2Decision == 2
OBSTACLE = ["B2-OBS-18", "B2-OBS-19"]


def _in_time(id: str, for_: Span) -> Property:
    return holds_for(
        id, "With jitter, an obstacle that S1 has lost and S2 detects at most "
        f"{for_} later makes the rover turn toward S1.",
        start=lost_1, that=implies(found_2, toward_1), for_=for_,
        covers=OBSTACLE, on=PASSING, from_tick=2, interpretations=["E14", "E15"],
    )  # fmt: skip


def _too_late(id: str, after: Span) -> Property:
    return enters_only_if(
        id, f"With jitter, the rover turns toward S1 only for an obstacle lost by S1 in the last {after}.",
        entering=toward_1, only_if=~held(~lost_1, for_=after),
        covers=OBSTACLE, on=PASSING, from_tick=2, interpretations=["E14", "E15"],
    )  # fmt: skip


PB2_61a = _in_time("PB2-61a", 2999 * ms)
PB2_61b = _in_time("PB2-61b", 2849 * ms)
PB2_61c = _too_late("PB2-61c", 3 * sec)
PB2_61d = _too_late("PB2-61d", 3109 * ms)

open_12 = named("the window of S1 and S2 is open", drawn_n.active("timerSonar12.Fall1Detected"))
PB2_61e = leaves_only_if(
    "PB2-61e", "With jitter, the window of S1 and S2 ends without a detection by S2 only after 2.831 s.",
    leaving=open_12, only_if=obj2Detected | held(previous(open_12), for_=2831 * ms),
    covers=OBSTACLE, on=WINDOW, from_tick=2, interpretations=["E14", "E15", "E16"],
)  # fmt: skip
PB2_61f = never(
    "PB2-61f", "With jitter, the window of S1 and S2 is never open for 3.13 s.",
    that=held(open_12, for_=3130 * ms),
    covers=OBSTACLE, on=WINDOW, interpretations=["E14", "E16"],
)  # fmt: skip
