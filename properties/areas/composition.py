"""What must be true of both boards together, step by step: relay, authorisation, stops across the link."""

from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import (
    always,
    costly,
    holds_after,
    leaves_only_if,
    never,
    responds,
    settles,
    until,
)
from rovercheck.spec_model.board1.motion import motion_supervision
from rovercheck.spec_model.composition.motors import board1_powered, connected, followed, motors_zero, runs_1
from rovercheck.spec_model.lang.expr import any_of, implies
from rovercheck.spec_model.lang.time import ms, tick, ticks
from rovercheck.spec_model.lang.words import absolute, held, named, once, previous
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2 as obstacles
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2

drive1 = named("Board 1 actuates", ~b1.give_b2_actuation)
drive2 = named("Board 2 is authorised", b2.autorized_to_send_command)
near_70, near_300 = within(70), within(300)
zero_1 = named("zero references of Board 1", (b1.v_ref == 0) & (b1.omega_ref == 0))
COMMANDS = ("CMD_NORMAL", "CMD_GO_LEFT", "CMD_GO_RIGHT", "CMD_ESTOP")
stop_commanded = b1.cmd == "CMD_ESTOP"

# --- relay and actuation -------------------------------------------------------------------------

PSY_01a = always(
    "PSY-01a", "The motor line is on Board 1 exactly while it has power and keeps the relay closed.",
    that=(connected == "Board1") == (board1_powered & ~b1.give_b2_actuation),
    covers=["B1-REL-01", "B1-REL-03", "B1-REL-05"], on="motors", interpretations=["S47"],
)  # fmt: skip
PSY_01c = always(
    "PSY-01c", "Only commands of the connected board are followed.",
    that=(followed == "nobody") | (followed == connected),
    covers=["B1-REL-01", "B1-REL-03", "B1-REL-05"], on="motors", interpretations=["S47"],
)  # fmt: skip
PSY_02a = never(
    "PSY-02a", "In no step does Board 1 actuate while Board 2 is authorised.",
    that=drive1 & drive2,
    covers=["B1-REL-03", "B2-ACT-01"], on="rover_plain", from_tick=2, interpretations=["E22"],
)  # fmt: skip
PSY_02b = never(
    "PSY-02b",
    "In no four steps in a row in which no frame is lost does Board 1 actuate while Board 2 is authorised.",
    that=held(drive1 & drive2 & b1.rx_update & b2.rx_update, for_=3 * ticks),
    covers=["B1-REL-03", "B2-ACT-01"], on="rover_plain", from_tick=2, interpretations=["E22"],
)  # fmt: skip
PSY_07a = always(
    "PSY-07a", "Without power on Board 1 the motor line is on Board 2.",
    that=implies(~board1_powered, connected == "Board2"),
    covers=["B1-REL-05", "B2-ACT-01"], on="motors", interpretations=["S47"],
)  # fmt: skip
PSY_08 = holds_after(
    "PSY-08", "With the supervisor of Board 1 stopped under power for 500 ms, the motors are at rest.",
    premise=~runs_1 & board1_powered, for_=500 * ms, then=motors_zero,
    covers=["B2-ACT-01", "B1-REL-05"], on="rover_plain_failing", interpretations=["E22"],
)  # fmt: skip
PSY_19 = leaves_only_if(
    "PSY-19", "Board 2 becomes authorised only if Board 1 gave it the actuation in the last four steps.",
    leaving=~drive2,
    only_if=b1.give_b2_actuation
    | previous(b1.give_b2_actuation)
    | previous(previous(b1.give_b2_actuation))
    | previous(previous(previous(b1.give_b2_actuation))),
    covers=["B1-OUT-02", "B2-ACT-01"], on="rover_plain", from_tick=2, interpretations=["E22"],
)  # fmt: skip

# --- stops across the link -----------------------------------------------------------------------

forward = motion.ay_norm > 0
in_time = near_70 & drive1 & ~obstacles.DEG_B1

PSY_10a = holds_after(
    "PSY-10a",
    "Five steps after an obstacle at 70 cm or less, constant, with the user driving forward, Board 1's "
    "linear reference is not positive.",
    premise=in_time & forward, for_=5 * ticks, then=b1.v_ref <= 0,
    covers=["B2-OBS-01", "B1-EST-01"], on="rover_plain_no_loss", from_tick=2, interpretations=["E12"],
)  # fmt: skip
PSY_11 = holds_after(
    "PSY-11",
    "Five steps after an obstacle at 70 cm or less, constant, whatever the user does, Board 1's references "
    "are zero.",
    premise=in_time, for_=5 * ticks, then=zero_1,
    covers=["B2-OBS-01"], on="rover_plain_no_loss", from_tick=2, interpretations=["E11", "S63"],
)  # fmt: skip
PSY_13a = holds_after(
    "PSY-13a",
    "Degraded for 160 ms with an obstacle at 300 cm or less, Board 1 driving, its linear reference is not "
    "positive.",
    premise=near_300 & drive1 & (b1.rover_safety_state == "SAFETY_DEGRADED"), for_=8 * ticks,
    then=b1.v_ref <= 0,
    covers=["B2-OBS-04", "B2-OBS-22"], on="rover_plain", from_tick=2, interpretations=["E09"],
)  # fmt: skip
PSY_15 = holds_after(
    "PSY-15",
    "When Board 2 has received no frame for 200 ms, Board 1 driving and receiving, both references are at "
    "most 0.5.",
    premise=~b2.rx_update & b1.rx_update & drive1, for_=9 * ticks,
    then=(absolute(b1.v_ref) <= 0.5) & (absolute(b1.omega_ref) <= 0.5),
    covers=["B1-REF-05", "B1-REF-07"], on="rover_plain", from_tick=2, interpretations=["S55"],
)  # fmt: skip
PSY_17a = never(
    "PSY-17a", "No speed but zero reaches the motors before Board 2 has read the IMU once.",
    that=~motors_zero & ~once(b2.imu_update),
    covers=["B2-FLT-01"], on="rover_no_loss", interpretations=[],
)  # fmt: skip
PSY_17b = costly(never(
    "PSY-17b", "No speed but zero reaches the motors before Board 2 has read the joystick once.",
    that=~motors_zero & ~once(b2.ble_update),
    covers=["B1-REF-02"], on="rover_no_loss", interpretations=[],
))  # fmt: skip
PSY_20a = always(
    "PSY-20a", "The command that Board 2 sends is NORMAL, GO_LEFT, GO_RIGHT or ESTOP.",
    that=any_of(*(obstacles.command == known for known in COMMANDS)),
    covers=["B1-IN-01"], on="obstacles_free", interpretations=["E04", "E31"],
)  # fmt: skip
PSY_20b = never(
    "PSY-20b", "Board 1 never avoids: neither Evita_sinistra nor Evita_destra is active.",
    that=motion_supervision.active("Evita_sinistra", "Evita_destra"),
    covers=["B1-IN-01"], on="references_commanded", interpretations=["E04", "E31"],
)  # fmt: skip

# --- long runs, and what one board decides alone ---------------------------------------------------------

PSY_05c = always(
    "PSY-05c", "Once no frame of Board 2 comes any more, an open relay stays open.",
    that=implies(previous(b1.give_b2_actuation & ~b1.rx_update) & ~b1.rx_update, b1.give_b2_actuation),
    covers=["B1-RX-03", "B1-REL-02"], on="relay_links", from_tick=2, interpretations=["S38"],
)  # fmt: skip
PSY_07b = always(
    "PSY-07b", "Board 2 is authorised in the first step with a last frame of Board 1 over 120 ms old.",
    that=implies(b2.rx_age > 120, drive2),
    covers=["B1-REL-05", "B2-ACT-01"], on="check_board1_fading", from_tick=2, interpretations=["S47"],
)  # fmt: skip
PSY_07c = holds_after(
    "PSY-07c", "Board 2 is authorised in the second step with a last frame of Board 1 over 120 ms old.",
    premise=b2.rx_age > 120, for_=1 * tick, then=drive2,
    covers=["B1-REL-05", "B2-ACT-01"], on="check_board1_links_free", from_tick=2, interpretations=["S47"],
)  # fmt: skip
PSY_09 = costly(responds(
    "PSY-09",
    "Within 100 ms of Board 1 taking the motors back, both links without loss for 3.02 s, Board 2 is no "
    "longer authorised.",
    trigger=drive1 & previous(~drive1) & held(b1.rx_update & b2.rx_update, for_=151 * ticks),
    response=~drive2, within=5 * ticks,
    covers=["B1-REL-03", "B2-ACT-01"], on="rover_plain", from_tick=2, interpretations=["S45", "E22"],
))  # fmt: skip
PSY_12 = until(
    "PSY-12", "Stopped by CMD_ESTOP, Board 1's linear reference is not positive until another command comes.",
    start=b1.actuate_emergency_stop & stop_commanded, holds=b1.v_ref <= 0, release=~stop_commanded,
    covers=["B2-OBS-01", "B1-EST-01"], on="references_executed", from_tick=2, interpretations=["E10", "S62"],
)  # fmt: skip
PSY_18 = settles(
    "PSY-18",
    "Without any fault and without an obstacle within 300 cm, wheels at rest whenever the references are "
    "zero, Board 1 drives for ever, safe and under CMD_NORMAL, and Board 2 is not authorised.",
    premise=~near_300 & (b1.wheels_below_2_5 | ~zero_1),
    then=drive1 & ~drive2 & (b1.rover_safety_state == "SAFETY_OK") & (b1.cmd == "CMD_NORMAL"),
    covers=["B1-REL-04", "B1-REF-02", "B2-OBS-12"], on="rover_plain_no_loss", interpretations=["S45"],
)  # fmt: skip
