"""What must be true of the four monitors of Board 2: each notices a silence, and only its own [spec §3.1].

`silent` is an age above the limit of the source.  Stamps carry the time of the step that sees them.
"""

from collections.abc import Sequence

from rovercheck.properties.document.sources import BLE, IMU, RX, SUP, Source, silent
from rovercheck.properties.forms import (
    Property,
    always,
    holds_after,
    holds_for,
    leaves_only_if,
    precedes,
    reachable,
    until,
)
from rovercheck.spec_model.board2.monitor_systems import (
    twin_esp_status,
    twin_imu_status,
    twin_rx_status,
    twin_sup_status,
)
from rovercheck.spec_model.board2.monitors import monitor_sources
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, any_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, previous

TICK = 20


def alone(source: Source) -> str:
    """The system with the monitor of the source alone."""
    return f"monitors_2_{source.region}"


def ok(source: Source) -> Expr:
    return source.status == source.levels[0]


def degraded(source: Source) -> Expr:
    return source.status == source.levels[1]


def critical(source: Source) -> Expr:
    return source.status == source.levels[2]


def _before(condition: Expr, count: int) -> Sequence[Expr]:
    """The condition one, two, ... ``count`` ticks ago."""
    past = [condition]
    for _ in range(count):
        past.append(previous(past[-1]))
    return past[1:]


def periodic(source: Source) -> Expr:
    """Stamps at the shortest constant period above the largest mean of the source."""
    return source.update == all_of(*(~earlier for earlier in _before(source.update, source.mean // TICK)))


def eleven(source: Source) -> int:
    """The ticks of eleven such periods."""
    return 11 * (source.mean // TICK + 1)


# --- PB2-19: a silence is noticed ------------------------------------------------------------------


def _noticed(id: str, source: Source, what: str) -> Property:
    return holds_after(
        id, f"{what} silent in three successive steps is critical in one of them.",
        premise=silent(source), for_=2 * ticks, then=any_of(critical(source), *_before(critical(source), 2)),
        covers=["B2-FLT-01"], on=alone(source), from_tick=2, interpretations=["E29"],
    )  # fmt: skip


PB2_19a = _noticed("PB2-19a", SUP, "The supervisor of Board 1,")
PB2_19b = _noticed("PB2-19b", BLE, "The joystick link,")
PB2_19c = _noticed("PB2-19c", IMU, "The IMU,")
PB2_19d = _noticed("PB2-19d", RX, "The reception from Board 1,")
PB2_19e = always(
    "PB2-19e", "The reception from Board 1 becomes critical only in a step in which it is silent.",
    that=implies(critical(RX) & ~previous(critical(RX)), silent(RX)),
    covers=["B2-FLT-01"], on=alone(RX), from_tick=2,
)  # fmt: skip
PB2_19f = leaves_only_if(
    "PB2-19f", "The reception leaves critical only after its mean gap was short enough for 1.00 s.",
    leaving=critical(RX), only_if=held(previous(critical(RX) & ~RX.deg), for_=50 * ticks),
    covers=["B2-FLT-01"], on=alone(RX), from_tick=2, interpretations=["E29"],
)  # fmt: skip
PB2_19g = holds_for(
    "PB2-19g", "The supervisor of Board 1, once critical, is so for at least 2.02 s.",
    start=critical(SUP), that=critical(SUP), for_=100 * ticks,
    covers=["B2-FLT-01"], on=alone(SUP), from_tick=2, interpretations=["E29"],
)  # fmt: skip


def _at_once(id: str, source: Source, what: str) -> Property:
    fine = previous(ok(source) & ~source.deg)
    return always(
        id, f"{what}, OK and not slow, is critical as soon as its stamp is over {source.limit} ms old.",
        that=implies(fine & silent(source), critical(source)),
        covers=["B2-FLT-01"], on=alone(source), from_tick=2,
    )  # fmt: skip


def _only_silent(id: str, source: Source, what: str) -> Property:
    return always(
        id, f"{what} becomes critical only with a stamp that is over {source.limit} ms old.",
        that=implies(critical(source) & ~previous(critical(source)), silent(source)),
        covers=["B2-FLT-01"], on=alone(source), from_tick=2,
    )  # fmt: skip


PB2_19h = _at_once("PB2-19h", SUP, "The supervisor of Board 1")
PB2_19i = _at_once("PB2-19i", BLE, "The joystick link")
PB2_19j = _at_once("PB2-19j", IMU, "The IMU")
PB2_19k = _at_once("PB2-19k", RX, "The reception from Board 1")
PB2_19l = _only_silent("PB2-19l", SUP, "The supervisor of Board 1")
PB2_19m = _only_silent("PB2-19m", BLE, "The joystick link")
PB2_19n = _only_silent("PB2-19n", IMU, "The IMU")

# --- PB2-20: while the silence lasts the source stays critical -----------------------------------------


def _stays(id: str, source: Source, what: str) -> Property:
    return until(
        id, f"{what}, critical and silent, stays critical until a stamp arrives.",
        start=critical(source) & silent(source), holds=critical(source), release=~silent(source),
        covers=["B2-FLT-01", "B2-FLT-02"], on=alone(source), from_tick=2, interpretations=["E29"],
    )  # fmt: skip


PB2_20a = _stays("PB2-20a", SUP, "The supervisor of Board 1")
PB2_20b = _stays("PB2-20b", BLE, "The joystick link")
PB2_20c = _stays("PB2-20c", IMU, "The IMU")
PB2_20d = _stays("PB2-20d", RX, "The reception from Board 1")
PB2_20e = holds_after(
    "PB2-20e", "A joystick link silent in four successive steps is critical in the last or the one before.",
    premise=silent(BLE), for_=3 * ticks, then=critical(BLE) | previous(critical(BLE)),
    covers=["B2-FLT-01", "B2-FLT-02"], on=alone(BLE), from_tick=2, interpretations=["E29"],
)  # fmt: skip

# --- PB2-21: a slow source is noticed, and only the source itself ---------------------------------------


def _slow(id: str, source: Source, what: str) -> Property:
    period = source.mean + TICK
    return holds_after(
        id, f"{what} updated every {period} ms for eleven periods is degraded.",
        premise=periodic(source), for_=eleven(source) * ticks, then=degraded(source),
        covers=["B2-FLT-01"], on=alone(source), from_tick=2, interpretations=["E26"],
    )  # fmt: skip


def _slow_not_critical(id: str, source: Source, what: str) -> Property:
    period = source.mean + TICK
    return holds_after(
        id, f"{what} updated every {period} ms for eleven periods, not critical meanwhile, is degraded.",
        premise=periodic(source) & ~critical(source), for_=eleven(source) * ticks, then=degraded(source),
        covers=["B2-FLT-01"], on=alone(source), from_tick=2, interpretations=["E26"],
    )  # fmt: skip


PB2_21a = _slow("PB2-21a", SUP, "The supervisor of Board 1")
PB2_21b = _slow("PB2-21b", BLE, "The joystick link")
PB2_21c = _slow("PB2-21c", IMU, "The IMU")
PB2_21d = _slow("PB2-21d", RX, "The reception from Board 1")
PB2_21e = _slow_not_critical("PB2-21e", SUP, "The supervisor of Board 1")
PB2_21f = _slow_not_critical("PB2-21f", BLE, "The joystick link")
PB2_21g = _slow_not_critical("PB2-21g", IMU, "The IMU")
PB2_21h = _slow_not_critical("PB2-21h", RX, "The reception from Board 1")
PB2_21i = holds_after(
    "PB2-21i", "A joystick link updated every 60 ms for eleven periods is not OK.",
    premise=periodic(BLE), for_=eleven(BLE) * ticks, then=~ok(BLE),
    covers=["B2-FLT-01"], on=alone(BLE), from_tick=2, interpretations=["E26"],
)  # fmt: skip
PB2_21j = precedes(
    "PB2-21j", "The joystick link is not OK only if there was a gap of more than 40 ms.",
    first=BLE.age > 40 - TICK, then=~ok(BLE),
    covers=["B2-FLT-01"], on=alone(BLE), interpretations=["E26"],
)  # fmt: skip


def _alone(id: str, source: Source, twin: Var, what: str) -> Property:
    return always(
        id, f"Two boards that see the same stamps of {what} give it the same status, whatever else they see.",
        that=source.status == twin,
        covers=["B2-FLT-01"], on=f"monitors_2_twice_{source.region}",
    )  # fmt: skip


PB2_21k = _alone("PB2-21k", SUP, twin_sup_status, "the supervisor of Board 1")
PB2_21l = _alone("PB2-21l", BLE, twin_esp_status, "the joystick link")
PB2_21m = _alone("PB2-21m", IMU, twin_imu_status, "the IMU")
PB2_21n = _alone("PB2-21n", RX, twin_rx_status, "the reception")

# --- reachability --------------------------------------------------------------------------------------


def _transition(id: str, source: Source, came: str, went: str, text: str) -> Property:
    region, active = source.region, monitor_sources.active
    return reachable(
        id, text,
        that=active(f"{region}.{went}") & previous(active(f"{region}.{came}")),
        covers=["B2-FLT-01"], on=alone(source),
    )  # fmt: skip


REACH_B2_SUP_OK_DEG = _transition("REACH-B2-SUP-OK-DEG", SUP, "OK", "DEG", "Board 1 can become slow.")
REACH_B2_SUP_OK_CRIT = _transition("REACH-B2-SUP-OK-CRIT", SUP, "OK", "CRIT", "Board 1 can fall silent.")
REACH_B2_SUP_DEG_CRIT = _transition(
    "REACH-B2-SUP-DEG-CRIT", SUP, "DEG", "CRIT", "A slow Board 1 can fall silent."
)
REACH_B2_SUP_RETURN = _transition("REACH-B2-SUP-RETURN", SUP, "CRIT", "OK", "Board 1 can recover.")
REACH_B2_BLE_OK_DEG = _transition(
    "REACH-B2-BLE-OK-DEG", BLE, "OK", "DEG", "The joystick link can become slow."
)
REACH_B2_RX_DEG_OK = reachable(
    "REACH-B2-RX-DEG-OK", "A slow reception can recover.",
    that=monitor_sources.active("Rx.OK") & previous(monitor_sources.active("Rx.DEG")),
    covers=["B2-FLT-01"], on="check_board1_fading",
)  # fmt: skip
REACH_B2_BLE_CRIT = _transition("REACH-B2-BLE-CRIT", BLE, "OK", "CRIT", "The joystick link can fall silent.")
REACH_B2_IMU_CRIT = _transition("REACH-B2-IMU-CRIT", IMU, "OK", "CRIT", "The IMU can fall silent.")
REACH_B2_RX_CRIT = _transition("REACH-B2-RX-CRIT", RX, "OK", "CRIT", "The reception can fall silent.")
NOT_SHARED = ((SUP, twin_sup_status), (IMU, twin_imu_status), (RX, twin_rx_status))
REACH_B2_TWICE = reachable(
    "REACH-B2-TWICE", "With the same joystick stamps the two boards can differ in everything else.",
    that=all_of(ok(BLE), *(ok(s) & (twin == s.levels[2]) for s, twin in NOT_SHARED)),
    covers=["B2-FLT-01"], on="monitors_2_apart_BLE",
)  # fmt: skip
REACH_B2_BLE_PERIODIC = reachable(
    "REACH-B2-BLE-PERIODIC", "The joystick link can be updated every 60 ms for eleven periods.",
    that=held(periodic(BLE), for_=eleven(BLE) * ticks) & degraded(BLE),
    covers=["B2-FLT-01"], on=alone(BLE),
)  # fmt: skip
