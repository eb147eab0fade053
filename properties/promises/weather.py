"""What the motors do while something has failed, on both boards, at every phase, alone or with another."""

from collections.abc import Sequence
from dataclasses import replace

from rovercheck.properties.forms import HoldsAfter, Property, costly, holds_after, reachable
from rovercheck.properties.promises.driving import half_1
from rovercheck.properties.promises.promise import Promise
from rovercheck.spec_model.composition.motors import connected, motors_zero
from rovercheck.spec_model.composition.weather import SPELLS, for_a_step, other
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.time import Span, ms, sec
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import v_ref

at_rest = named("the motors stand", motors_zero)
slow = named(
    "the motors stand, or turn at half speed at most", (connected == "Board2") | half_1 | motors_zero
)
"""Board 2 never drives faster (P-LIMITS-BOARD-2)."""


def _with(fault: str, what: str, after: Span, then: Expr, covers: Sequence[str]) -> Property:
    wanted = "the motors stand" if then is at_rest else "the motors stand, or turn at half speed at most"
    return holds_after(
        f"P-WEATHER-{fault.upper()}", f"With {what} for {after}, {wanted}.",
        premise=SPELLS[fault] == "present", for_=after, then=then,
        covers=covers, on=f"weather_{fault}", from_tick=2,
    )  # fmt: skip


def _and_another(alone: Property) -> Property:
    """The same, whatever else fails, but the supervisor of Board 1 (PSY-08)."""
    assert isinstance(alone.form, HoldsAfter)
    premise = alone.form.premise & (other != "supervisor1")
    return costly(replace(
        alone,
        id=f"{alone.id}-2",
        text=f"{alone.text[:-1]}, whatever else fails but the supervisor of Board 1.",
        on=f"{alone.on}_2",
        form=replace(alone.form, premise=premise),
    ))  # fmt: skip


JOYSTICK = _with("joystick", "no joystick datum", 500 * ms, at_rest, ["B2-FLT-01", "B1-REF-06"])
IMU = _with("imu", "no IMU datum", 500 * ms, at_rest, ["B2-FLT-01", "B1-REF-06"])
LINK12 = _with("link12", "no frame for Board 2", 500 * ms, slow, ["B2-FLT-01", "B1-REF-05"])
LINK21 = _with("link21", "no frame for Board 1", 500 * ms, slow, ["B1-RX-03", "B1-REF-05"])
SUPERVISOR1 = _with(
    "supervisor1", "a supervisor of Board 1 that has stopped", 500 * ms, at_rest, ["B2-ACT-01"]
)
SUPERVISOR2 = _with(
    "supervisor2", "a supervisor of Board 2 that has stopped", 500 * ms, at_rest, ["B1-SUP-03"]
)
POWER = _with("power", "a Board 1 without power", 500 * ms, slow, ["B1-REL-05", "B2-ACT-01"])
WHEEL = _with("wheel", "a wheel without feedback", 500 * ms, slow, ["B1-WHL-01", "B1-REF-05"])
HOT = _with("hot", "64 °C", 4500 * ms, at_rest, ["B1-TEMP-03", "B1-REF-06"])
FLAT = _with("flat", "a battery at 10 %", 5500 * ms, at_rest, ["B1-BATT-03", "B1-REF-06"])
NEAR = _with("near", "an obstacle at 70 cm", 80 * ms, at_rest, ["B2-OBS-01", "B1-EST-01"])
TEMPERATURE = _with("temperature", "no temperature", 1 * sec, slow, ["B1-TEMP-04", "B1-REF-05"])
BATTERY = _with("battery", "no battery level", 1 * sec, slow, ["B1-BATT-04", "B1-REF-05"])

NO_TEMPERATURE = replace(
    _with("temperature", "no temperature, the last one 25 °C or 0 °C,", 66 * sec, at_rest, ["B1-TEMP-04"]),
    id="P-WEATHER-TEMPERATURE-LONG",
)
NO_BATTERY = replace(
    _with("battery", "no battery level, the last one 80 % or 0 %,", 156 * sec, at_rest, ["B1-BATT-04"]),
    id="P-WEATHER-BATTERY-LONG",
)
FULL_SPEED = reachable(
    "REACH-WEATHER-FULL-SPEED", "Before anything fails the rover drives at full speed.",
    that=(SPELLS["joystick"] == "ahead") & ~motors_zero & (v_ref == 1),
    covers=["B1-REF-04"], on="weather_joystick",
)  # fmt: skip

JOYSTICK_LINK21, IMU_LINK21 = (
    holds_after(
        f"P-WEATHER-{source}-LINK21",
        f"With no {what} datum for {500 * ms}, the motors stand, or turn at half speed at most, also when a "
        "frame for Board 1 is lost.",
        premise=(SPELLS[source.lower()] == "present") & for_a_step, for_=500 * ms, then=slow,
        covers=["B2-FLT-01", "B1-REF-06"], on=f"weather_{source.lower()}_link21", from_tick=2,
    )
    for source, what in (("JOYSTICK", "joystick"), ("IMU", "IMU"))
)  # fmt: skip

JOYSTICK_2, IMU_2, LINK12_2 = map(_and_another, (JOYSTICK, IMU, LINK12))
SUPERVISOR2_2, WHEEL_2 = map(_and_another, (SUPERVISOR2, WHEEL))


def _and_another_heard(alone: Property, after: Span) -> Property:
    """The same, whatever else fails that leaves Board 2 hearing Board 1."""
    assert isinstance(alone.form, HoldsAfter)
    return costly(replace(
        alone,
        id=f"{alone.id}-2",
        text=f"{alone.text.replace(str(alone.form.for_), str(after))[:-1]}, whatever else fails while "
        "Board 2 hears Board 1.",
        on=f"{alone.on}_2",
        form=replace(alone.form, for_=after),
    ))  # fmt: skip


NEAR_2 = _and_another_heard(NEAR, 500 * ms)
HOT_2, FLAT_2 = _and_another_heard(HOT, 4500 * ms), _and_another_heard(FLAT, 5500 * ms)
LINK21_2 = _and_another_heard(LINK21, 500 * ms)
"""Of the others no second one is asked for.  Where no scan comes nothing is promised; without a supervisor of
Board 1 nothing holds (PSY-08); readings that stay away degrade only after half a minute, and a Board 2 that
drives is never faster than half speed (P-LIMITS-BOARD-2)."""

LOSS = Promise(
    "LOSS",
    "Loss of a sensor, a link or a board",
    "Critical faults of either board set the references to zero, degraded ones halve the limits; Board 2 "
    "moves the rover when Board 1 cannot.",
    "§2.4 to §2.7, Fig 20, Fig 21, Tables 1 to 3",
    "within 500 ms of the failure (4.5 s at 64 °C, 5.5 s at 10 %)",
    "as required for one fault at a time, but for frames that Board 2 misses (full speed 2.2 s later), the "
    "supervisor of Board 1 (PSY-08) and readings that stay away (66 s and 156 s); two faults defeat the stop "
    "of a dead joystick or IMU",
    tuple(
        prop.id
        for prop in (
            LINK12, JOYSTICK_LINK21, IMU_LINK21,
            SUPERVISOR1, TEMPERATURE, BATTERY, JOYSTICK_2, IMU_2, LINK12_2,
        )
    ),
    (
        JOYSTICK, IMU, LINK21, SUPERVISOR2, POWER, WHEEL, HOT, FLAT,
        NO_TEMPERATURE, NO_BATTERY, SUPERVISOR2_2, WHEEL_2, HOT_2, FLAT_2, LINK21_2,
    ),
)  # fmt: skip
