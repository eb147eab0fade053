"""What must be true of the manoeuvres of Board 1, state by state [spec §2.7, Fig 20]."""

from rovercheck.properties.areas.references import drives, running
from rovercheck.properties.forms import Property, always
from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.board1.motion import motion_supervision
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of, implies
from rovercheck.spec_model.lang.words import maximum, minimum, once, previous
from rovercheck.spec_model.signals.board1 import (
    actuate_emergency_stop,
    backward_enabled,
    cmd,
    current_action,
    invert_y,
    omega_ref,
    rover_safety_state,
    v_ref,
    x_norm,
    y_norm,
)

ON = "references"
OK, DEGRADED = rover_safety_state == "SAFETY_OK", rover_safety_state == "SAFETY_DEGRADED"
ACTIONS = {
    "Normale_marcia": "CMD_NORMAL",
    "Schivata_a_sinistra": "CMD_GO_LEFT",
    "Schivata_a_destra": "CMD_GO_RIGHT",
    "Evita_sinistra": "CMD_AVOID_LEFT",
    "Evita_destra": "CMD_AVOID_RIGHT",
    "Retromarcia_180": "CMD_ROTATE_180",
    "In_frenata_di_emergenza": "CMD_ESTOP",
    "Motori_fermi": "CMD_STOP",
}
"""The action that the rover is said to do in each state."""


def during(state: str) -> Expr:
    """The state is executed: active before and after a step in which Board 1 drives."""
    active = motion_supervision.active(state)
    return drives & active & previous(active)


def _forward(state: str) -> Expr:
    """The same with the stick forward, which means forward."""
    return during(state) & (y_norm > 0) & ~invert_y


def _moves(id: str, text: str, state: str, v: Expr, omega: Expr) -> Property:
    """The references of a healthy rover while a state is executed with the stick forward."""
    return always(
        f"PB1-39{id}", text, that=implies(_forward(state) & OK, (v_ref == v) & (omega_ref == omega)),
        covers=["B1-ACT-01", "B1-REF-04"], on=ON, from_tick=2, interpretations=["S57", "S59", "S60"],
    )  # fmt: skip


PB1_38 = always(
    "PB1-38", "From the second step in which Board 1 drives, its current action is that of its state.",
    that=implies(
        drives & previous(drives),
        all_of(*(implies(motion_supervision.active(s), current_action == a) for s, a in ACTIONS.items())),
    ),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_38b = always(
    "PB1-38b", "The emergency stop is actuated in the stop procedure and nowhere else.",
    that=implies(drives, actuate_emergency_stop == ~running),
    covers=["B1-EST-01"], on=ON, from_tick=2, interpretations=["S62"],
)  # fmt: skip
PB1_39a = _moves(
    "a", "In normal running with the stick forward the healthy rover moves as the stick says.",
    "Normale_marcia", v=y_norm, omega=x_norm,
)  # fmt: skip
PB1_39b = _moves(
    "b", "Avoiding the left, the rover moves as the stick says, but does not turn to the left.",
    "Evita_sinistra", v=y_norm, omega=minimum(x_norm, 0),
)  # fmt: skip
PB1_39c = _moves(
    "c", "Avoiding the right, the rover moves as the stick says, but does not turn to the right.",
    "Evita_destra", v=y_norm, omega=maximum(x_norm, 0),
)  # fmt: skip
PB1_39d = always(
    "PB1-39d", "Avoiding a side, the rover never turns to it, healthy or degraded.",
    that=all_of(
        implies(during("Evita_sinistra"), omega_ref <= 0), implies(during("Evita_destra"), omega_ref >= 0)
    ),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_39e = always(
    "PB1-39e", "A manoeuvre begins only from normal running, by its command.",
    that=all_of(*(
        implies(
            motion_supervision.active(state) & ~previous(motion_supervision.active(state)),
            (cmd == ACTIONS[state]) & previous(motion_supervision.active("Normale_marcia")),
        )
        for state in ("Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra")
    )),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_39f = always(
    "PB1-39f", "CMD_NORMAL ends a manoeuvre in the same step.",
    that=implies(
        drives & (cmd == "CMD_NORMAL"),
        ~any_of(*(
            motion_supervision.active(state)
            for state in ("Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra")
        )),
    ),
    covers=["B1-ACT-01"], on=ON, from_tick=2, interpretations=["S60"],
)  # fmt: skip
PB1_39g = always(
    "PB1-39g", "In backward mode the healthy rover follows the stick forward and back.",
    that=implies(
        during("Normale_marcia") & backward_enabled & ~invert_y & ~previous(invert_y) & OK, v_ref == y_norm
    ),
    covers=["B1-REF-02"], on=ON, from_tick=2, interpretations=["S59"],
)  # fmt: skip
PB1_39h = always(
    "PB1-39h", "A rover that is degraded for a second step runs at half of what the stick says.",
    that=implies(
        _forward("Normale_marcia") & DEGRADED & previous(DEGRADED),
        v_ref == choose("S57", {"SCALE": y_norm * 0.5, "CLIP": minimum(y_norm, 0.5)}),
    ),
    covers=["B1-GEN-05", "B1-REF-05"], on=ON, from_tick=2, interpretations=["S57", "S59"],
)  # fmt: skip
PB1_38c = always(
    "PB1-38c",
    "Before Board 1 drives for the first time, in its first step where the relay is (PB1-14b), it stands, "
    "without stop or changed stick.",
    that=implies(
        ~once(drives),
        all_of(
            (v_ref == 0) & (omega_ref == 0), current_action == "CMD_NORMAL",
            ~actuate_emergency_stop, ~invert_y,
        ),
    ),
    covers=["B1-ACT-01"], on=ON,
)  # fmt: skip
PB1_38d = always(
    "PB1-38d", "The stop procedure takes back what a pulled stick means.",
    that=implies(drives & ~running, ~invert_y), covers=["B1-EST-01"], on=ON, from_tick=2,
    interpretations=["S59"],
)  # fmt: skip
