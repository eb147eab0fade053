"""Motion: every state of normal running writes both references in every step, also in that of its entry."""

from dataclasses import replace

from rovercheck.spec_model.board1.motion import slowing_down
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.edit import edit_state
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.words import absolute
from rovercheck.spec_model.manoeuvres.rotation import toward_target
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.signals.board1 import OMEGA_MAX, angle_err, backward_enabled, omega_ref, v_ref

MANOEUVRES = ("Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra")


def write_on_entry(state: State) -> State:
    """The during action runs on entry too: in the step of a transition into the state it would not run."""
    return replace(state, entry=(*state.entry, *state.during))


def rotate_on_the_spot(
    state: State, *, v_ref: Var, omega_ref: Var, angle_err: Var, fast: Expr, slow: Expr
) -> State:
    """The rotation stops the rover, turns from its first step on, and slows down in every safety state."""
    at_full_speed = assign(omega_ref, toward_target(angle_err, fast))
    law = when(absolute(angle_err) > 45, [at_full_speed], [assign(omega_ref, toward_target(angle_err, slow))])
    *measure, _ = state.during
    return replace(state, entry=(*state.entry, assign(v_ref, 0), at_full_speed), during=(*measure, law))


def forward_only(state: State) -> State:
    """A manoeuvre that goes on with the stick pulled back would move the rover backwards in any mode."""
    limit = when((v_ref < 0) & ~backward_enabled, [assign(v_ref, 0)])
    return replace(state, during=(*state.during, limit))


def writing_in_every_step(chart: Chart) -> Chart:
    for name in MANOEUVRES:
        chart = edit_state(chart, name, forward_only)
    for name in ("Normale_marcia", *MANOEUVRES):
        chart = edit_state(chart, name, write_on_entry)
    return edit_state(
        chart,
        "Retromarcia_180",
        lambda state: rotate_on_the_spot(
            state, v_ref=v_ref, omega_ref=omega_ref, angle_err=angle_err, fast=OMEGA_MAX, slow=slowing_down
        ),
    )


in_every_step = Repair(
    name="references-in-every-step",
    text=(
        "The states of Stato_marcia_rover write v_ref and omega_ref on entry as they do during their stay; "
        "the manoeuvres go backwards in backward mode only; the rotation sets v_ref to 0 and slows down near "
        "its target in every safety state."
    ),
    fixes=(
        *("PB1-20a", "PB1-20b", "PB1-20c", "PB1-20d", "PB1-20e", "PB1-26", "PB1-26f", "PB1-27a"),
        "P-WEATHER-WHEEL-STEERED",
    ),
    charts={"Motion_Supervision": writing_in_every_step},
    gives_up={
        "PB1-26b": "It says that the rotation keeps the linear reference, which PB1-26 wants zero.",
        **dict.fromkeys(
            ("PSY-10m", "P-STOP-OBEYED"),
            "The step in which the emergency stop ends writes the reference before CMD_ESTOP is tested, "
            "unless stop-unconditional keeps the stop while CMD_ESTOP lasts.",
        ),
    },
)
