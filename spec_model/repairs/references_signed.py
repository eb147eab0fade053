"""Motion: y_norm times the limit is the linear reference, also backwards, as §2.2 states it."""

from spec_model.repairs import Repair

_MODE = "It lets the rover move backwards in backward mode only, which §2.2 does not ask for."
_ROTATION = "It takes a stick pulled back for the request to rotate, which here is a command to reverse."

signed = Repair(
    name="references-signed",
    text="Normale_marcia follows a stick pulled back too, and CMD_ROTATE_180 asks for the rotation (S59).",
    fixes=("PB1-21a",),
    readings={"S59": "SIGNED"},
    gives_up={
        **dict.fromkeys(("PB1-26l", "PB1-27a", "PB1-27b"), _MODE),
        "PB1-26i": _ROTATION,
    },
)
