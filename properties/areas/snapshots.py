"""What a snapshot holds: the datum that came last, until another comes [seed §1.1, Fig 13, §1.3.1]."""

from properties.forms import Property, always
from properties.past import STEPPED
from spec_model.lang.expr import Expr, Var, all_of, implies, ite
from spec_model.lang.words import once, previous
from spec_model.signals.board1 import (
    batt_reading,
    batt_update,
    battery_pct,
    temp_reading,
    temp_update,
    temperature_degC,
)
from spec_model.signals.board2 import SONARS
from spec_model.signals.board2_supervisor import sonar_update


def _arriving(datum: Var) -> Var:
    """The free input that an update brings for a datum."""
    return Var(f"new_{datum.name}", datum.domain, datum.init, f"{datum.name} of the update")


def _kept(update: Var, datum: Var, new: Var) -> Expr:
    """An update brings the new value; without one the datum stays, once there is one."""
    return ite(update, datum == new, implies(STEPPED, datum == previous(datum)))


def _at_first(update: Var, datum: Var) -> Expr:
    """0 before the first reading [design]."""
    return implies(~once(update), datum == 0)


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
PB2_57 = always(
    "PB2-57", "A scan replaces the three distances, each by its own; without one they stay.",
    that=all_of(*(_kept(sonar_update, d, _arriving(d)) for d in SONARS)),
    covers=["B2-GEN-03", "B2-OBS-01"], on="sonar_silence", readings=["E13"],
)  # fmt: skip
