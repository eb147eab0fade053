"""How old each source is said to be: 0 in the step of its datum, 20 ms more in every other step.

Each age may stop growing at the first one above the limit of its source [spec Table 2, §3.1]: logs have
older ones.
"""

from rovercheck.properties.document.sources import BLE, IMU, RX, SUP
from rovercheck.properties.forms import Property, always
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.expr import Expr, Var, const, ite
from rovercheck.spec_model.lang.words import previous
from rovercheck.spec_model.signals.board1 import (
    batt_age,
    batt_update,
    heartbeat_age,
    heartbeat_update,
    rx_age,
    rx_update,
    temp_age,
    temp_update,
)
from rovercheck.spec_model.signals.board2_supervisor import sonar_age, sonar_update

STEP = 20


def _above(limit: int) -> Expr:
    """The first age above the limit."""
    return const((limit // STEP + 1) * STEP, "ms")


def _age(id: str, what: str, update: Var, age: Var, most: Expr, covers: str, on: str) -> Property:
    before = ite(STEPPED, previous(age), 0)
    return always(
        id, f"The age of {what} is 0 in a step that brings it, else 20 ms more, up to its limit.",
        that=ite(update, age == 0, (age == before + STEP) | (age == before) & (before >= most)),
        covers=[covers], on=on,
    )  # fmt: skip


PB1_37_RX = _age(
    "PB1-37-RX", "the last valid frame of Board 2", rx_update, rx_age, _above(120), "B1-RX-03", "reception"
)
PB1_37_SUP = _age(
    "PB1-37-SUP", "the heartbeat of Board 2", heartbeat_update, heartbeat_age, _above(120),
    "B1-SUP-03", "heartbeat",
)  # fmt: skip
PB1_37_TEMP = _age(
    "PB1-37-TEMP", "the temperature", temp_update, temp_age,
    choose("S09", {"FROM-LAST": _above(81_000), "FROM-0.5": _above(81_500)}), "B1-TEMP-04", "temperature",
)  # fmt: skip
"""At 1 °C/s even the coldest reading, -16 °C, is above 65 °C after 81 s [spec Table 2]."""
PB1_37_BATT = _age(
    "PB1-37-BATT", "the battery", batt_update, batt_age,
    choose("S24", {
        "FROM-LAST-INSTANT": _above(154_761),
        "FROM-0.5-INSTANT": _above(155_261),
        "FROM-LAST-SUSTAINED": _above(154_761),
    }),
    "B1-BATT-05", "battery",
)  # fmt: skip
"""At 0.42 %/s even a charge of 80 % is below 15 % after 154.762 s [spec Table 2]."""
PB2_29_SUP, PB2_29_BLE, PB2_29_IMU, PB2_29_RX = (
    _age(
        f"PB2-29-{source.region}", what, source.update, source.age, _above(source.limit),
        "B2-FLT-01", f"monitors_2_{source.region}",
    )
    for source, what in (
        (SUP, "the heartbeat of Board 1"), (BLE, "the joystick"), (IMU, "the IMU"), (RX, "frames of Board 1"),
    )
)  # fmt: skip
PB2_77_SUP, PB2_77_BLE, PB2_77_IMU, PB2_77_RX, PB2_77_SONARS = (
    _age(f"PB2-77-{name}", what, update, age, _above(limit), covers, "inputs_2")
    for name, what, update, age, limit, covers in (
        *(
            (s.region, what, s.update, s.age, s.limit, "B2-FLT-01")
            for s, what in (
                (SUP, "the heartbeat of Board 1, on all of Board 2,"),
                (BLE, "the joystick, on all of Board 2,"),
                (IMU, "the IMU, on all of Board 2,"),
                (RX, "frames of Board 1, on all of Board 2,"),
            )
        ),
        ("Sonars", "the distances", sonar_update, sonar_age, 280, "B2-GEN-03"),
    )
)
"""As PB2-29, of the clocks that all of Board 2 shares; 300 ms stand for the age of any older scan."""
