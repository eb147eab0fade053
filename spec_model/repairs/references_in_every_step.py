"""Motion: every state of normal running writes both references in every step, also in that of its entry."""

from collections.abc import Callable
from dataclasses import replace

from spec_model.board1.motion import slowing_down
from spec_model.lang.action import assign, when
from spec_model.lang.chart import Chart, State
from spec_model.lang.edit import edit_state
from spec_model.lang.words import absolute
from spec_model.manoeuvres.rotation import toward_target
from spec_model.repairs import Repair
from spec_model.signals.board1 import OMEGA_MAX, angle_err, omega_ref, v_ref

MANOEUVRES = ("Normale_marcia", "Schivata_a_sinistra", "Schivata_a_destra", "Evita_sinistra", "Evita_destra")


def write_on_entry(state: State) -> State:
    """The during action runs on entry too: in the step of an arrow into the state it would not run."""
    return replace(state, entry=(*state.entry, *state.during))


def rotate_on_the_spot(state: State) -> State:
    """The rotation stops the rover, turns from its first step on, and slows down in every safety state."""
    full = assign(omega_ref, toward_target(angle_err, OMEGA_MAX))
    law = when(absolute(angle_err) > 45, [full], [assign(omega_ref, toward_target(angle_err, slowing_down))])
    measure = state.during[:-1]
    return replace(state, entry=(*state.entry, assign(v_ref, 0), full), during=(*measure, law))


def writing_in_every_step(chart: Chart) -> Chart:
    changes: dict[str, Callable[[State], State]] = dict.fromkeys(MANOEUVRES, write_on_entry)
    for name, change in {**changes, "Retromarcia_180": rotate_on_the_spot}.items():
        chart = edit_state(chart, name, change)
    return chart


in_every_step = Repair(
    name="references-in-every-step",
    text=(
        "The states of Stato_marcia_rover write v_ref and omega_ref on entry as they do during their stay; "
        "the rotation sets v_ref to 0 and slows down near its target in every safety state."
    ),
    fixes=("PB1-20a", "PB1-20b", "PB1-20c", "PB1-20d", "PB1-20e"),
    charts={"Motion_Supervision": writing_in_every_step},
)
