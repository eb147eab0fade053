"""What must be true of the authorisation of Board 2 and of the state it then works in (E22) [spec §3.1]."""

from rovercheck.properties.document.causes import emergency, q
from rovercheck.properties.document.distances import within
from rovercheck.properties.document.sources import RX, SUP, silent
from rovercheck.properties.forms import (
    always,
    enters_only_if,
    holds_after,
    holds_for,
    leaves_only_if,
    reachable,
)
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.board2.failure_check import check_board1
from rovercheck.spec_model.board2.safety import safety_state_2
from rovercheck.spec_model.lang.expr import implies
from rovercheck.spec_model.lang.time import tick, ticks
from rovercheck.spec_model.lang.words import held, named, previous
from rovercheck.spec_model.signals.board2_supervisor import (
    autorized_to_send_command,
    cmd,
    rover_safety_state,
)

ON, LINKS, DRIVING = "check_board1", "check_board1_links_free", "safety_2"
REQUESTS = "check_board1_requests"
autorized = autorized_to_send_command
CRITICAL = rover_safety_state == "SAFETY_CRITICAL"
cause = named("emergency while authorised", autorized & emergency)
close = named("obstacle within 3 m while authorised", autorized & within(300))
STOP = cmd == "CMD_ESTOP"

PB2_14a = always(
    "PB2-14a", "Board 2 is authorised in every step with a request to switch or a critical link.",
    that=implies(q, autorized),
    covers=["B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_14b = enters_only_if(
    "PB2-14b", "Board 2 becomes authorised only in a step with a request to switch or a critical link.",
    entering=autorized, only_if=q,
    covers=["B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_14_first = always(
    "PB2-14-first", "In the very first step Board 2 is not authorised, whatever it hears.",
    that=implies(~STEPPED, ~autorized),
    covers=["B2-ACT-01"], on=ON,
)  # fmt: skip
PB2_14c = always(
    "PB2-14c", "Board 2 is authorised in every step in which Board 1 is silent.",
    that=implies(silent(RX) | silent(SUP), autorized),
    covers=["B2-ACT-01"], on="check_board1_fading", from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_14d = holds_after(
    "PB2-14d", "Board 2 is authorised when the reception from Board 1 is silent for two steps.",
    premise=silent(RX), for_=1 * tick, then=autorized,
    covers=["B2-ACT-01"], on=LINKS, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_15a = leaves_only_if(
    "PB2-15a", "Board 2 loses the authorisation only after 3.02 s without request and critical link.",
    leaving=autorized, only_if=held(~q, for_=151 * ticks),
    covers=["B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_15b = holds_after(
    "PB2-15b", "After 3.02 s without request and critical link Board 2 is not authorised.",
    premise=~q, for_=151 * ticks, then=~autorized,
    covers=["B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_15c = holds_for(
    "PB2-15c", "Once given, the authorisation lasts for at least 3.02 s.",
    start=autorized, that=autorized, for_=151 * ticks,
    covers=["B2-ACT-01"], on=ON, from_tick=2, interpretations=["E22"],
)  # fmt: skip
PB2_15d = leaves_only_if(
    "PB2-15d", "Board 2 does not lose the authorisation where Board 1 has been silent for two steps.",
    leaving=autorized, only_if=~held(silent(RX), for_=1 * tick) & ~held(silent(SUP), for_=1 * tick),
    covers=["B2-ACT-01"], on=LINKS, from_tick=2, interpretations=["E22", "E29"],
)  # fmt: skip

PB2_17s = always(
    "PB2-17s", "While Board 2 is authorised, an emergency makes its safety state critical in the same step.",
    that=implies(cause, CRITICAL),
    covers=["B2-REF-01", "B1-REF-06"], on=DRIVING, from_tick=2,
)  # fmt: skip
PB2_17t = holds_after(
    "PB2-17t",
    "An emergency in two successive authorised steps makes the safety state critical in the second.",
    premise=cause, for_=1 * tick, then=CRITICAL,
    covers=["B2-REF-01", "B1-REF-06"], on=DRIVING, from_tick=2,
)  # fmt: skip
PB2_17u = always(
    "PB2-17u", "While Board 2 is authorised, the safety state is critical only with an emergency.",
    that=implies(autorized & CRITICAL, emergency),
    covers=["B2-REF-01"], on=DRIVING, from_tick=2,
)  # fmt: skip
PB2_13s = always(
    "PB2-13s", "While Board 2 is authorised, an obstacle within 3 m commands a stop in the same step.",
    that=implies(close, STOP),
    covers=["B2-OBS-04", "B2-OBS-22"], on=DRIVING, from_tick=2, interpretations=["E09", "E12"],
)  # fmt: skip
PB2_13t = holds_after(
    "PB2-13t", "An obstacle within 3 m in two successive authorised steps commands a stop in the second.",
    premise=close, for_=1 * tick, then=STOP,
    covers=["B2-OBS-04", "B2-OBS-22"], on=DRIVING, from_tick=2, interpretations=["E09", "E12"],
)  # fmt: skip
PB2_13u = always(
    "PB2-13u", "While Board 2 is authorised, it commands a stop only for an obstacle within 3 m.",
    that=implies(autorized & ~within(300), cmd == "CMD_NORMAL"),
    covers=["B2-OBS-22"], on=DRIVING, from_tick=2, interpretations=["E09"],
)  # fmt: skip

REACH_B2_AUTORIZED = reachable(
    "REACH-B2-AUTORIZED", "Board 2 can become authorised.",
    that=check_board1.active("B2_trying_to_actuate"), covers=["B2-ACT-01"], on=REQUESTS,
)  # fmt: skip
REACH_B2_LAST_STEP = reachable(
    "REACH-B2-LAST-STEP", "Board 2 can still be authorised after 3.00 s without any cause.",
    that=autorized & held(~q, for_=150 * ticks), covers=["B2-ACT-01"], on=REQUESTS,
)  # fmt: skip
REACH_B2_GIVES_UP = reachable(
    "REACH-B2-GIVES-UP", "Board 2 can lose the authorisation.",
    that=~autorized & previous(autorized), covers=["B2-ACT-01"], on=REQUESTS,
)  # fmt: skip
REACH_B2_SAFETY_CRITICAL = reachable(
    "REACH-B2-SAFETY-CRITICAL", "The safety state of Board 2 can be critical and return to degraded.",
    that=safety_state_2.active("Rover_Degraded_State")
    & previous(safety_state_2.active("Rover_Critical_State")),
    covers=["B2-REF-01"], on=DRIVING,
)  # fmt: skip
REACH_B2_DRIVING_STOP = reachable(
    "REACH-B2-DRIVING-STOP", "The obstacle command of Board 2 can be a stop.",
    that=STOP & autorized, covers=["B2-OBS-22"], on=DRIVING,
)  # fmt: skip
