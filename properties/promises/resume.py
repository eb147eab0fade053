"""Resume: what has ended no longer stops the rover, nor slows it."""

from collections.abc import Sequence

from rovercheck.properties.forms import Property, holds_after
from rovercheck.properties.promises.promise import Promise
from rovercheck.spec_model.composition.motors import connected, motors_zero
from rovercheck.spec_model.composition.weather import SPELLS
from rovercheck.spec_model.lang.time import Span, ms
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import v_ref

full_speed = named("Board 1 drives at full speed", (connected == "Board1") & ~motors_zero & (v_ref == 1))


def _after(fault: str, what: str, within: Span, covers: Sequence[str]) -> Property:
    return holds_after(
        f"P-RESUME-{fault.upper()}",
        f"Once {what}, the rover drives at full speed again within {within}, stick forward.",
        premise=SPELLS[fault] == "over", for_=within, then=full_speed,
        covers=covers, on=f"weather_{fault}", from_tick=2,
    )  # fmt: skip


NEAR = _after("near", "an obstacle at 70 cm has gone", 1140 * ms, ["B2-OBS-01", "B1-EST-01"])
HOT = _after("hot", "a temperature of 64 °C has ended", 1140 * ms, ["B1-TEMP-03", "B1-EST-01"])
FLAT = _after("flat", "a battery at 10 % has recovered", 1140 * ms, ["B1-BATT-03", "B1-EST-01"])
JOYSTICK = _after("joystick", "the joystick has come back", 1300 * ms, ["B2-FLT-01", "B1-EST-01"])
IMU = _after("imu", "the IMU has come back", 1300 * ms, ["B2-FLT-01", "B1-EST-01"])
LINK12 = _after("link12", "frames of Board 1 arrive again", 3020 * ms, ["B2-ACT-01", "B1-REL-04"])
LINK21 = _after("link21", "frames of Board 2 arrive again", 3020 * ms, ["B1-REL-04", "B1-RX-03"])

RESUME = Promise(
    "RESUME",
    "Resume",
    "When the cause has gone, and the wheels have stood for a second, the rover obeys the joystick again; "
    "the relay closes when reception and supervisor of Board 2 have been well for 3 s.",
    "Fig 16, Fig 21, §2.7",
    "after a second at rest, after 3 s with the relay",
    "at full speed after 1.14 s, after 1.3 s where a monitor of Board 2 has to recover, after 3.02 s where a "
    "link was lost, with both boards and one failure; but a rotation that does not end stays (PB1-25), and "
    "the second at rest is 0.969 s in steps of 19 ms (PB1-46b)",
    ("PB1-25", "PB1-25a", "PB1-46a"),
    (NEAR, HOT, FLAT, JOYSTICK, IMU, LINK12, LINK21),
)
