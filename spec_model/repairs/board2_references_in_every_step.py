"""Motion of Board 2: both references are written in every step, and the rotation turns to its end."""

from dataclasses import replace

from rovercheck.spec_model.board2.motion import OMEGA_MAX, omega_ref, v_ref
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.edit import edit_state
from rovercheck.spec_model.manoeuvres.rotation import toward_target
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.repairs.references_in_every_step import write_on_entry
from rovercheck.spec_model.signals.board2_motion import angle_err


def turn_to_the_end(state: State) -> State:
    """At 45 degrees and less the chart of Board 2 writes no angular reference, so that any is kept."""
    turn = assign(omega_ref, toward_target(angle_err, OMEGA_MAX))
    *measure, _ = state.during
    return replace(state, entry=(*state.entry, assign(v_ref, 0), turn), during=(*measure, turn))


def writing_in_every_step(chart: Chart) -> Chart:
    chart = edit_state(chart, "Normale_marcia", write_on_entry)
    return edit_state(chart, "Retromarcia_180", turn_to_the_end)


board2_in_every_step = Repair(
    name="board2-references-in-every-step",
    text=(
        "Normale_marcia of Board 2 writes its references on entry too; the rotation sets v_ref to 0 and "
        "turns with OMEGA_MAX toward its target until it ends."
    ),
    fixes=("PB2-16e", "PB2-16f"),
    charts={"Motion_Supervision_2": writing_in_every_step},
)
