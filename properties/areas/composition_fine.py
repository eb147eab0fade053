"""Latencies through both boards in milliseconds, for arbitrary phases [system: chains of hops]."""

from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import always, holds_after, responds, until
from rovercheck.spec_model.composition.fine_systems import (
    actuates,
    asks_switch,
    critical_sent,
    forward,
    frame_accepted,
    near,
    nonzero,
    rx_age_ms,
    sends,
    sup2_executes,
    v_positive,
)
from rovercheck.spec_model.lang.expr import implies
from rovercheck.spec_model.lang.time import ms, tick
from rovercheck.spec_model.lang.words import named, previous
from rovercheck.spec_model.signals.board1 import (
    cmd,
    give_b2_actuation,
    is_rotating180,
    rx_status,
    v_ref,
    y_norm,
)
from rovercheck.spec_model.signals.board2 import command
from rovercheck.spec_model.signals.board2_supervisor import autorized_to_send_command, sends_speeds

driven_forward = named(
    "Board 1 actuates, the user drives forward, no rotation",
    ~give_b2_actuation & (y_norm > 0) & ~is_rotating180,
)
opens = named("Board 1 opens the relay", give_b2_actuation & ~previous(give_b2_actuation))

PSY_01b = always(
    "PSY-01b", "While the relay is open, Board 1 sends no motor command.",
    that=implies(give_b2_actuation, ~sends),
    covers=["B1-REL-01", "B1-REL-03", "B1-REL-05"], on="silence_fine",
)  # fmt: skip
PSY_03a = responds(
    "PSY-03a", "Within 61 ms of the step in which Board 1 opens the relay, Board 2 is authorised.",
    trigger=opens, response=autorized_to_send_command, within=61 * ms,
    covers=["B1-REL-02", "B2-ACT-01"], on="handover_fine", interpretations=["S45", "E22"],
)  # fmt: skip
PSY_03b = responds(
    "PSY-03b", "Within 81 ms of the step in which Board 1 opens the relay, Board 2 sends wheel speeds.",
    trigger=opens, response=sends_speeds, within=81 * ms,
    covers=["B1-REL-02", "B2-ACT-01"], on="handover_fine", interpretations=["S45", "E22"],
)  # fmt: skip
PSY_03c = responds(
    "PSY-03c", "Within 41 ms of the step in which Board 1 opens the relay, Board 2 is authorised.",
    trigger=opens, response=autorized_to_send_command, within=41 * ms,
    covers=["B1-REL-02", "B2-ACT-01"], on="handover_fine", interpretations=["S45", "E22"],
)  # fmt: skip
PSY_03d = holds_after(
    "PSY-03d",
    "Within 61 ms of the step in which Board 1 asks to switch, as long as it does, Board 2 is authorised.",
    premise=asks_switch, for_=61 * ms, then=autorized_to_send_command,
    covers=["B1-REL-02", "B2-ACT-01"], on="handover_fine", interpretations=["S45", "E22"],
)  # fmt: skip
PSY_04a = holds_after(
    "PSY-04a", "Within 140 ms of the last accepted frame of Board 2, Board 1 opens the relay.",
    premise=~frame_accepted, for_=139 * ms, then=give_b2_actuation,
    covers=["B1-RX-03", "B1-REL-02"], on="silence_fine", interpretations=["S37"],
)  # fmt: skip
PSY_04b = holds_after(
    "PSY-04b", "From 150 ms after the last accepted frame of Board 2 on, Board 1 sends no motor command.",
    premise=~frame_accepted, for_=149 * ms, then=~sends,
    covers=["B1-RX-03", "B1-REL-02"], on="silence_fine", interpretations=["S37"],
)  # fmt: skip
PSY_05a = until(
    "PSY-05a", "A critical reception stays critical until a frame of Board 2 is accepted.",
    start=(rx_status == "RX_CRITICAL") & (rx_age_ms > 120), holds=rx_status == "RX_CRITICAL",
    release=frame_accepted,
    covers=["B1-RX-03", "B1-RX-05"], on="silence_fine", interpretations=["S38"],
)  # fmt: skip
PSY_05b = until(
    "PSY-05b", "A relay open while the reception is critical stays open until a frame is accepted.",
    start=give_b2_actuation & (rx_status == "RX_CRITICAL") & (rx_age_ms > 120), holds=give_b2_actuation,
    release=frame_accepted,
    covers=["B1-RX-03", "B1-REL-02"], on="silence_fine", interpretations=["S38"],
)  # fmt: skip
PSY_06 = holds_after(
    "PSY-06", "Within 181 ms of the last execution of the Board 2 supervisor, Board 1 opens the relay.",
    premise=~sup2_executes, for_=180 * ms, then=give_b2_actuation,
    covers=["B1-SUP-01", "B1-SUP-03", "B1-REL-02"], on="heartbeat_fine", interpretations=["S40", "S41"],
)  # fmt: skip
PSY_10e = holds_after(
    "PSY-10e",
    "Within 101 ms of a sonar snapshot with an obstacle at 70 cm or less, constant, the linear reference "
    "is not positive, if Board 1 actuates, the user drives forward and no rotation is active meanwhile.",
    premise=near & forward, for_=101 * ms, then=~v_positive,
    covers=["B2-OBS-01", "B1-EST-01"], on="stop_fine", interpretations=["E12"],
)  # fmt: skip
PSY_10f = holds_after(
    "PSY-10f",
    "Within 81 ms of a sonar snapshot with an obstacle at 70 cm or less, constant, the linear reference "
    "is not positive, if Board 1 actuates, the user drives forward and no rotation is active meanwhile.",
    premise=near & forward, for_=81 * ms, then=~v_positive,
    covers=["B2-OBS-01", "B1-EST-01"], on="stop_fine", interpretations=["E12"],
)  # fmt: skip
PSY_10o = holds_after(
    "PSY-10o",
    "Within 101 ms of a sonar snapshot with an obstacle at 70 cm or less, constant, both references of Board "
    "1 are zero, if it actuates, the user drives forward and no rotation is active meanwhile.",
    premise=near & forward, for_=101 * ms, then=~nonzero,
    covers=["B2-OBS-01", "B1-EST-01"], on="stop_obeyed_fine", interpretations=["E12"],
)  # fmt: skip
PSY_10d = holds_after(
    "PSY-10d",
    "With the repair degraded-by-either, the same of an obstacle at 300 cm or less and a fault in a mask of "
    "Board 2, both constant, in the place of one at 70 cm.",
    premise=near & forward, for_=101 * ms, then=~nonzero,
    covers=["B2-OBS-04", "B1-EST-01"], on="stop_obeyed_fine", interpretations=["E09", "E12"],
)  # fmt: skip
PSY_10u = holds_after(
    "PSY-10u",
    "With the repair stop-unconditional: within 81 ms of a sonar snapshot with an obstacle at 70 cm or less, "
    "constant, both references of Board 1 are zero, if it actuates meanwhile, whatever the user does.",
    premise=near & actuates, for_=81 * ms, then=~nonzero,
    covers=["B2-OBS-01", "B1-EST-01"], on="stop_unconditional_fine", interpretations=["E12"],
)  # fmt: skip

PSY_14a = holds_after(
    "PSY-14a",
    "Within 61 ms of the step in which joystick link or IMU becomes critical, Board 1 driving, its "
    "references are zero, for as long as that lasts.",
    premise=critical_sent, for_=61 * ms, then=~nonzero,
    covers=["B2-FLT-02", "B1-REF-06", "B1-REF-07"], on="critical_2_to_1", interpretations=["S55", "E29"],
)  # fmt: skip
PSY_14b = holds_after(
    "PSY-14b",
    "Within 61 ms of the step in which a critical component of Board 1 stops the rover, Board 2 driving, "
    "its references are zero, for as long as that lasts.",
    premise=critical_sent, for_=61 * ms, then=~nonzero,
    covers=["B2-FLT-02", "B2-REF-01"], on="critical_1_to_2", interpretations=["S55", "E29"],
)  # fmt: skip

# --- what the contracts rest on ----------------------------------------------------------------------

PSY_10m = always(
    "PSY-10m",
    "With the user driving forward in two successive steps of actuation and no rotation, CMD_ESTOP in the "
    "second leaves no positive linear reference.",
    that=implies(previous(driven_forward) & driven_forward & (cmd == "CMD_ESTOP"), v_ref <= 0),
    covers=["B1-EST-01"], on="references", from_tick=2, interpretations=["S63"],
)  # fmt: skip
PSY_10s = holds_after(
    "PSY-10s", "An obstacle at 70 cm or less in two successive steps makes Board 2 command CMD_ESTOP.",
    premise=within(70), for_=1 * tick, then=command == "CMD_ESTOP",
    covers=["B2-OBS-01"], on="obstacles_free", interpretations=["E04", "E12"],
)  # fmt: skip
