"""What a snapshot holds: the datum that came last, until another comes [spec §1.1, Fig 13, §1.3.1]."""

from collections.abc import Sequence
from dataclasses import replace

from rovercheck.properties.document.sources import BLE, IMU, RX
from rovercheck.properties.forms import Property, always
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.composition.motors import started
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, implies, ite
from rovercheck.spec_model.lang.words import once, previous
from rovercheck.spec_model.signals.board1 import (
    batt_reading,
    batt_update,
    battery_pct,
    cmd,
    crit_mask_b2,
    current_yaw,
    degr_mask_b2,
    is_motion_consistent,
    rx_update,
    temp_reading,
    temp_update,
    temperature_degC,
    x_norm,
    y_norm,
)
from rovercheck.spec_model.signals.board1 import btn1 as b1_btn1
from rovercheck.spec_model.signals.board1 import btn2 as b1_btn2
from rovercheck.spec_model.signals.board2 import SONARS
from rovercheck.spec_model.signals.board2_motion import ay_norm, btn1, btn2, bx_norm, yaw
from rovercheck.spec_model.signals.board2_supervisor import (
    crit_mask_b1,
    degr_mask_b1,
    gz_dps,
    sonar_update,
    wheel_speed_rpm,
)


def _arriving(datum: Var) -> Var:
    """The free input that an update brings for a datum."""
    return Var(f"new_{datum.name}", datum.domain, datum.init, f"{datum.name} of the update")


def _kept(update: Var, datum: Var, new: Var) -> Expr:
    """An update brings the new value; without one the datum stays, once there is one."""
    return ite(update, datum == new, implies(STEPPED, datum == previous(datum)))


def _at_first(update: Var, datum: Var) -> Expr:
    """0, or false, before the first reading [design]."""
    return implies(~once(update), ~datum if isinstance(datum.sort, Bool) else datum == 0)


def _reading(id: str, what: str, update: Var, datum: Var, new: Var, covers: str, on: str) -> Property:
    return always(
        id, f"{what} is the reading that came last: a new one replaces it at once, and nothing else does; it "
        "is 0 before the first one.",
        that=_kept(update, datum, new) & _at_first(update, datum),
        covers=[covers], on=on,
    )  # fmt: skip


PB1_42_TEMP = _reading(
    "PB1-42-TEMP", "The temperature", temp_update, temperature_degC, temp_reading, "B1-TEMP-04", "temperature"
)
PB1_42_BATT = _reading(
    "PB1-42-BATT", "The battery", batt_update, battery_pct, batt_reading, "B1-BATT-05", "battery"
)


def _payload(letter: str, text: str, at_first: Expr, data: Sequence[Var], covers: list[str]) -> Property:
    new = [Var(f"frame_{d.name}", d.domain, d.init, f"{d.name} of the frame") for d in data]
    return always(
        f"PB1-47{letter}", text,
        that=all_of(*(_kept(rx_update, d, frame) for d, frame in zip(data, new, strict=True)))
        & implies(~once(rx_update), at_first),
        covers=covers, on="board1",
    )  # fmt: skip


PB1_47a = _payload(
    "a", "A frame replaces the command of Board 2; without one it stays, CMD_NORMAL at first.",
    cmd == "CMD_NORMAL", [cmd], ["B1-IN-01"],
)  # fmt: skip
PB1_47b = _payload(
    "b", "A frame replaces the stick, the heading and the buttons; without one they stay, at rest, 0 and "
    "released at first.",
    all_of(x_norm == 0, y_norm == 0, current_yaw == 0, ~b1_btn1, ~b1_btn2),
    [x_norm, y_norm, current_yaw, b1_btn1, b1_btn2], ["B1-IN-01"],
)  # fmt: skip
PB1_47c = _payload(
    "c", "A frame replaces the two masks of Board 2, each by its own; without one they stay, 0 at first.",
    (crit_mask_b2 == 0) & (degr_mask_b2 == 0), [crit_mask_b2, degr_mask_b2], ["B1-IN-01"],
)  # fmt: skip
PB1_47d = _payload(
    "d", "A frame replaces what Board 2 says of wheels and rotation; without one it stays, consistent at "
    "first [modelling choice].",
    is_motion_consistent, [is_motion_consistent], ["B1-IN-01"],
)  # fmt: skip


def _snapshot(letter: str, text: str, update: Var, data: Sequence[Var], covers: list[str]) -> Property:
    return always(
        f"PB2-57{letter}", text,
        that=all_of(*(_kept(update, d, _arriving(d)) & _at_first(update, d) for d in data)),
        covers=covers, on="inputs_2",
    )  # fmt: skip


PB2_57a = _snapshot(
    "a", "A scan replaces the three distances, each by its own; without one they stay, 0 at first.",
    sonar_update, SONARS, ["B2-GEN-03", "B2-OBS-01"],
)  # fmt: skip
PB2_57b = replace(
    _snapshot(
        "b", "A complete read of the joystick replaces axes and buttons, each by its own; without one "
        "they stay, at rest at first.",
        BLE.update, (ay_norm, bx_norm, btn1, btn2), ["B2-GEN-03"],
    ),
    interpretations=("E28",),
)  # fmt: skip
PB2_57c = _snapshot(
    "c", "A datum of the IMU replaces heading and yaw rate; without one they stay, 0 at first.",
    IMU.update, (yaw, gz_dps), ["B2-GEN-03"],
)  # fmt: skip
PB2_57d = _snapshot(
    "d", "A frame replaces the four wheel speeds, each by its own; without one they stay, 0 at first.",
    RX.update, [wheel_speed_rpm[wheel] for wheel in ("FL", "FR", "RL", "RR")], ["B2-FLT-01"],
)  # fmt: skip
PB2_57e, PB2_57f = (
    _snapshot(
        letter, f"A frame replaces the {kind} mask of Board 1; without one it stays, 0 at first.",
        RX.update, [mask], ["B2-FLT-01"],
    )
    for letter, kind, mask in (("e", "critical", crit_mask_b1), ("f", "degraded", degr_mask_b1))
)  # fmt: skip
PSY_29 = always(
    "PSY-29", "From the first step on both boards have started, so that a supervisor can stop.",
    that=started, covers=["B1-REL-05"], on="weather_joystick",
)  # fmt: skip
