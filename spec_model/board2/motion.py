"""Motion supervision of Board 2: the references with which it moves the rover while Board 1 cannot.

The second region of the reference chart.  It is that of Board 1 at half speed (E25), without dodging
and avoiding, and it does not wait for wheel speeds that no longer arrive: with the reception critical
an emergency stop counts as done after 2 s.
"""

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import all_of, const, ite
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import absolute, after, duration, named
from rovercheck.spec_model.manoeuvres.rotation import Rotation, free, measured, toward_target, turned_around
from rovercheck.spec_model.signals.board2_motion import (
    actuate_emergency_stop,
    angle_err,
    ay_norm,
    backward_enabled,
    bx_norm,
    current_action,
    estop_recover_enabled,
    invert_y,
    is_rotating180,
    nearly_turned,
    omega_ref_actuation,
    omega_user,
    rotation_error,
    rover_is_stopped,
    targetAngle,
    v_ref_actuation,
    v_user,
    wheels_below_2_5,
    yaw,
)
from rovercheck.spec_model.signals.board2_supervisor import (
    cmd,
    rover_safety_state,
    rx_status,
    wheel_speed_rpm,
)

v_ref, omega_ref = v_ref_actuation, omega_ref_actuation

may_move = backward_enabled | (ay_norm > 0)
critical = rover_safety_state == "SAFETY_CRITICAL"
V_MAX = named("V_MAX", ite(critical, const(0), const(0.5)))
OMEGA_MAX = named("OMEGA_MAX", ite(critical, const(0), const(0.5)))

update_user_command = [  # UPD (E25)
    assign(v_user, ay_norm * V_MAX),
    assign(omega_user, bx_norm * OMEGA_MAX),
    turned_around(v_user, invert_y),
]


def motion(rotation: Rotation) -> Chart:
    """The chart, with the rotation that knows its heading or the one with a free error."""
    return Chart(
        "Motion_Supervision_2",
        [
            State(
                "Stato_marcia_rover",
                entry=update_user_command,
                during=update_user_command,
                exit=[assign(invert_y, False)],
                transitions=[
                    to(
                        "In_frenata_di_emergenza",
                        when=((cmd == "CMD_ESTOP") & (v_user > 0) & ~is_rotating180) | critical,
                        do=[assign(estop_recover_enabled, False)],
                    ),
                ],
                default="Normale_marcia",
                states=[
                    State(
                        "Normale_marcia",
                        entry=[assign(current_action, "CMD_NORMAL")],
                        during=[
                            when(may_move, [assign(v_ref, v_user)], [assign(v_ref, 0)]),
                            assign(omega_ref, omega_user),
                        ],
                        transitions=[to("Retromarcia_180", when=(ay_norm < -0.5) & ~backward_enabled)],
                    ),
                    State(
                        "Retromarcia_180",
                        entry=[
                            assign(current_action, "CMD_ROTATE_180"),
                            assign(is_rotating180, True),
                            *rotation.start,
                        ],
                        during=[
                            *rotation.measure,
                            when(
                                absolute(angle_err) > 45,
                                [assign(omega_ref, toward_target(angle_err, OMEGA_MAX))],
                            ),
                        ],
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
                        do=[assign(actuate_emergency_stop, False)],
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
                        transitions=[
                            to("Motori_fermi", when=(rx_status == "RX_CRITICAL") & after(2 * sec)),
                            to("Motori_fermi", when=duration(rover_is_stopped) > 1 * sec),
                        ],
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
        text="Linear and angular reference, emergency stop and current action of Board 2.",
    )


motion_supervision_2 = motion(measured(yaw, targetAngle, angle_err))
"""The chart as drawn."""

motion_2_with_free_error = motion(free(rotation_error, angle_err, nearly_turned))
"""The chart alone, where yaw is arbitrary in every step."""

check_stop_2 = Block(
    "checkStop_2",
    [assign(wheels_below_2_5, all_of(*(absolute(speed) < 2.5 for speed in wheel_speed_rpm.values())))],
    text="All four wheels slower than 2.5 rpm, as Board 1 last reported.",
)
