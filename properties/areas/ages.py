"""How old each source is said to be: 0 in the step of its datum, 20 ms more in every other step.

Each age may stop growing once it exceeds the limit of its source [seed Table 2, §3.1].
"""

from properties.document.sources import BLE, IMU, RX, SUP
from properties.forms import Property, always
from spec_model.lang.expr import TRUE, Var, implies, ite
from spec_model.lang.words import once, previous
from spec_model.signals.board1 import heartbeat_age, heartbeat_update, rx_age, rx_update

STEP = 20


def _age(id: str, what: str, update: Var, age: Var, limit: int, covers: str, on: str) -> Property:
    before = previous(age)
    return always(
        id, f"The age of {what} is 0 in a step that brings it, else 20 ms more, up to its limit.",
        that=ite(update, age == 0, (age == before + STEP) | (age == before) & (before > limit)),
        covers=[covers], on=on, from_tick=2,
    )  # fmt: skip


def _first(id: str, what: str, update: Var, age: Var, covers: str, on: str) -> Property:
    return always(
        id, f"In the first step, 20 ms after power-up, {what} that did not come is said to be 20 ms old.",
        that=implies(~previous(once(TRUE)) & ~update, age == STEP), covers=[covers], on=on,
    )  # fmt: skip


PB1_37_RX = _age(
    "PB1-37-RX", "the last valid frame of Board 2", rx_update, rx_age, 120, "B1-RX-03", "reception"
)
PB1_37_SUP = _age(
    "PB1-37-SUP", "the heartbeat of Board 2", heartbeat_update, heartbeat_age, 120, "B1-SUP-03", "heartbeat"
)
PB1_37_RX_first = _first("PB1-37-RX-first", "a frame", rx_update, rx_age, "B1-RX-03", "reception")
PB1_37_SUP_first = _first(
    "PB1-37-SUP-first", "a heartbeat", heartbeat_update, heartbeat_age, "B1-SUP-03", "heartbeat"
)
PB2_29_SUP, PB2_29_BLE, PB2_29_IMU, PB2_29_RX = (
    _age(
        f"PB2-29-{source.region}", what, source.update, source.age, source.limit,
        "B2-FLT-01", f"monitors_2_{source.region}",
    )
    for source, what in (
        (SUP, "the heartbeat of Board 1"), (BLE, "the joystick"), (IMU, "the IMU"), (RX, "frames of Board 1"),
    )
)  # fmt: skip
