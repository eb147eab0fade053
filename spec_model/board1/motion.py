"""Motion supervision of Board 1: the references, from the command of Board 2, the user and the safety state.

[spec §2.7, Fig 19; S57, S59-S64].  A running superstate with one state per manoeuvre, among them the
180° rotation, and the emergency stop procedure, which is left only after the rover has been at rest.
It is the second region of the reference chart, executed after the toggle of backward mode.
"""

from fractions import Fraction

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import const
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import absolute, duration, maximum, minimum, named
from rovercheck.spec_model.manoeuvres.rotation import Rotation, free, measured, toward_target, turned_around
from rovercheck.spec_model.signals.board1 import (
    OMEGA_GO_LEFT,
    OMEGA_GO_RIGHT,
    OMEGA_MAX,
    V_MAX,
    V_MAX_MANEUVER,
    actuate_emergency_stop,
    angle_err,
    backward_enabled,
    cmd,
    current_action,
    current_yaw,
    estop_recover_enabled,
    invert_y,
    is_rotating180,
    nearly_turned,
    omega_ref,
    omega_user,
    rotation_error,
    rover_is_stopped,
    rover_safety_state,
    targetAngle,
    v_ref,
    v_user,
    wheels_below_2_5,
    x_norm,
    y_norm,
)

critical = rover_safety_state == "SAFETY_CRITICAL"
may_move = backward_enabled | (y_norm > 0)
stop_commanded = (cmd == "CMD_ESTOP") & (v_user > 0) & ~is_rotating180

back_to_normal = to("Normale_marcia", when=cmd == "CMD_NORMAL")

update_user_command = [  # UPD
    assign(v_user, y_norm * V_MAX),
    assign(omega_user, x_norm * OMEGA_MAX),
    turned_around(v_user, invert_y),
]

slowing_down = named(
    "min(OMEGA_MAX, 0.005 * max(abs(angle_err), 15))",
    minimum(OMEGA_MAX, maximum(absolute(angle_err), 15) * const(Fraction("0.005"), "1/°")),
)
rotation_law = when(
    absolute(angle_err) > 45,
    [assign(omega_ref, toward_target(angle_err, OMEGA_MAX))],
    [when(rover_safety_state == "SAFETY_OK", [assign(omega_ref, toward_target(angle_err, slowing_down))])],
)


def motion(rotation: Rotation) -> Chart:
    """The chart, with the rotation that knows its heading or the one with a free error."""
    return Chart(
        "Motion_Supervision",
        [
            State(
                "Stato_marcia_rover",
                entry=update_user_command,
                during=update_user_command,
                exit=[assign(invert_y, False)],
                transitions=[
                    to(
                        "In_frenata_di_emergenza",
                        when=stop_commanded | critical,  # S61, S63
                        do=[assign(estop_recover_enabled, False)],
                    ),
                ],
                default="Normale_marcia",
                states=[
                    State(
                        "Normale_marcia",
                        entry=[assign(current_action, "CMD_NORMAL")],
                        during=[
                            when(may_move, [assign(v_ref, v_user)], [assign(v_ref, 0)]),  # S59
                            assign(omega_ref, omega_user),
                        ],
                        transitions=[
                            to("Schivata_a_sinistra", when=(v_user > 0) & (cmd == "CMD_GO_LEFT")),
                            to("Evita_sinistra", when=(v_user > 0) & (cmd == "CMD_AVOID_LEFT")),
                            to("Evita_destra", when=(v_user > 0) & (cmd == "CMD_AVOID_RIGHT")),
                            to("Schivata_a_destra", when=(v_user > 0) & (cmd == "CMD_GO_RIGHT")),
                            to("Retromarcia_180", when=(y_norm < -0.5) & ~backward_enabled),
                        ],
                    ),
                    State(
                        "Schivata_a_sinistra",
                        entry=[assign(current_action, "CMD_GO_LEFT")],
                        during=[
                            assign(v_ref, minimum(v_user, V_MAX_MANEUVER)),
                            assign(omega_ref, maximum(omega_user, OMEGA_GO_LEFT)),
                        ],
                        transitions=[back_to_normal],
                    ),
                    State(
                        "Schivata_a_destra",
                        entry=[assign(current_action, "CMD_GO_RIGHT")],
                        during=[
                            assign(v_ref, minimum(v_user, V_MAX_MANEUVER)),
                            assign(omega_ref, minimum(omega_user, OMEGA_GO_RIGHT)),
                        ],
                        transitions=[back_to_normal],
                    ),
                    State(
                        "Evita_sinistra",
                        entry=[assign(current_action, "CMD_AVOID_LEFT")],
                        during=[assign(v_ref, v_user), assign(omega_ref, minimum(omega_user, 0))],
                        transitions=[back_to_normal],
                    ),
                    State(
                        "Evita_destra",
                        entry=[assign(current_action, "CMD_AVOID_RIGHT")],
                        during=[assign(v_ref, v_user), assign(omega_ref, maximum(omega_user, 0))],
                        transitions=[back_to_normal],
                    ),
                    State(
                        "Retromarcia_180",
                        entry=[
                            assign(current_action, "CMD_ROTATE_180"),
                            assign(is_rotating180, True),
                            *rotation.start,
                        ],
                        during=[*rotation.measure, rotation_law],
                        exit=[assign(is_rotating180, False)],
                        transitions=[to("turned", when=rotation.turned)],
                    ),
                ],
                junctions=[
                    Junction(
                        "turned",
                        [
                            to("Normale_marcia", when=v_user < 0, do=[assign(invert_y, True)]),
                            to("Normale_marcia"),
                        ],
                    )
                ],
            ),
            State(
                "Procedura_emergency_stop",
                transitions=[
                    to(
                        "Stato_marcia_rover",
                        when=~critical & estop_recover_enabled,
                        do=[assign(actuate_emergency_stop, False)],  # latched until at rest (S62)
                    ),
                ],
                states=[
                    State(
                        "In_frenata_di_emergenza",
                        entry=[
                            assign(current_action, "CMD_ESTOP"),
                            assign(v_ref, 0),
                            assign(omega_ref, 0),
                            assign(actuate_emergency_stop, True),
                        ],
                        during=[assign(rover_is_stopped, wheels_below_2_5)],
                        transitions=[to("Motori_fermi", when=duration(rover_is_stopped) > 1 * sec)],
                    ),
                    State(
                        "Motori_fermi",
                        entry=[assign(current_action, "CMD_STOP"), assign(estop_recover_enabled, True)],
                    ),
                ],
            ),
        ],
        default="Stato_marcia_rover",
        # UPD writes both before any later read, so their values outside the running state mean nothing.
        local_to=[
            (v_user, ["Stato_marcia_rover"]),
            (omega_user, ["Stato_marcia_rover"]),
            *rotation.local_to,
        ],
        text="Linear and angular reference, emergency stop and current action of Board 1.",
    )


motion_supervision = motion(measured(current_yaw, targetAngle, angle_err))
"""The chart as drawn."""

motion_with_free_error = motion(free(rotation_error, angle_err, nearly_turned))
"""The chart alone, where yaw is arbitrary in every step."""
