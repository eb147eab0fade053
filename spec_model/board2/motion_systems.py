"""The systems in which the reference charts of Board 2 are checked, alone and behind what they follow."""

from rovercheck.spec_model.board2 import DRIVING
from rovercheck.spec_model.board2.backward import toggle_2
from rovercheck.spec_model.board2.motion import check_stop_2, motion_2_with_free_error
from rovercheck.spec_model.board2.obstacle_command import obstacle_command, obstacles_driving
from rovercheck.spec_model.board2.safety import safety_state_2
from rovercheck.spec_model.lang.chart import Enabled
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.signals.board2_supervisor import autorized_to_send_command
from rovercheck.spec_model.system_table import SystemTable

FREE_BACKWARD = "Backward mode is free in every step, which allows every run of its toggle and more."
FREE_ERROR = (
    "In Retromarcia_180 what is left to turn is free in every step after that of entry, where it is -180 "
    "degrees; for a chart that meets an arbitrary yaw this adds and loses no run."
)
EXECUTED = "While Board 2 is not authorised nothing here changes (E22); those steps are left out."

FREE_CAUSES = (
    "The authorisation, both emergencies, the reception status and the distances are free in every step."
)
COMES_BEFORE = (safety_state_2, obstacles_driving, obstacle_command)

SYSTEMS = SystemTable(
    in_order(
        "references_2_drawn",
        check_stop_2,
        DRIVING,
        text="Safety state, obstacle command and references of Board 2 as drawn, for any authorisation.",
        notes=(FREE_CAUSES, "Headings are multiples of 2.5 degrees, arbitrary in every step."),
        over=True,
        concrete="board2_plain",
    ),
    in_order(
        "references_2",
        Enabled(autorized_to_send_command, *COMES_BEFORE, motion_2_with_free_error),
        text="As references_2_drawn, with less to remember.",
        notes=(FREE_CAUSES, FREE_BACKWARD, FREE_ERROR),
        over=True,
        concrete="board2_plain",
    ),
    in_order(
        "references_2_executed",
        *COMES_BEFORE,
        motion_2_with_free_error,
        text="As references_2, alone, in the steps in which Board 2 is authorised: time in executed steps.",
        notes=(FREE_CAUSES, "Backward mode is free in every step.", FREE_ERROR, EXECUTED),
    ),
    in_order(
        "backward_2",
        toggle_2,
        text="The toggle of backward mode of Board 2 for any buttons and stick.",
        notes=(EXECUTED,),
    ),
)
