"""Obstacles in the non-degraded state: the stop at 70 cm, the deviations, the output of the chart.

The systems named ``..._free``, ``..._straight`` and so on have every run of the chart as drawn and
more, so that what is proved on them holds for the chart; ``obstacles_n`` is the chart as drawn.
"""

from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import always, enters_only_if, holds_after, leaves_only_if, never, responds
from rovercheck.spec_model.board2.obstacles import drawn_n as chart
from rovercheck.spec_model.board2.systems import targetAngle, yaw
from rovercheck.spec_model.environment.sonars import echo
from rovercheck.spec_model.lang.expr import all_of, any_of, implies
from rovercheck.spec_model.lang.time import sec, tick, ticks
from rovercheck.spec_model.lang.words import held, named, previous, wrap
from rovercheck.spec_model.signals.board2 import (
    DEG_B1,
    B2Dec,
    B2Decision,
    command,
    obj1Detected,
    obj2Detected,
    obj3Detected,
    prevDEG_B1,
    stop,
)

DETECTED = (obj1Detected, obj2Detected, obj3Detected)
near = within(70)
echo_near = named("nearest echo <= 70", any_of(*(e <= 70 for e in echo)))
stopped = named("DEC = 1", B2Decision == 1)
deviating = named("DEC in {2, 3, 4}", any_of(*(B2Decision == n for n in (2, 3, 4))))
cut_short = named("emergency or prevDEG_B1", chart.active("InEmergency") | prevDEG_B1)

# --- the stop [spec §3.4, §3.4.1 (2a), Fig 26] ----------------------------------------------------

STOP = ("B2-OBS-01", "B2-OBS-11", "B2-OBS-12")

PB2_01 = always(
    "PB2-01", "With an obstacle at 70 cm or less the decision is to stop in the same step.",
    that=implies(near & ~DEG_B1, B2Dec == 1),
    covers=STOP, on="obstacles", from_tick=2, interpretations=("E02", "E12"),
)  # fmt: skip

PB2_02_n1 = responds(
    "PB2-02-n1", "An obstacle at 70 cm or less leads to the decision to stop within 1 step.",
    trigger=near, response=stopped, within=1 * tick,
    covers=STOP, on="obstacles_n_free", interpretations=("E10", "E12"),
)  # fmt: skip

PB2_02_n2 = responds(
    "PB2-02-n2", "An obstacle at 70 cm or less leads to the decision to stop within 2 steps.",
    trigger=near, response=stopped, within=2 * ticks,
    covers=STOP, on="obstacles_n_free", interpretations=("E10", "E12"),
)  # fmt: skip

PB2_02_n3 = responds(
    "PB2-02-n3", "An obstacle at 70 cm or less leads to the decision to stop within 3 steps.",
    trigger=near, response=stopped, within=3 * ticks,
    covers=STOP, on="obstacles_n_free", interpretations=("E10", "E12"),
)  # fmt: skip

PB2_02b = always(
    "PB2-02b", "With an obstacle at 70 cm or less the decision is to stop in the next step.",
    that=implies(previous(near), stopped),
    covers=STOP, on="obstacles_n_free", from_tick=2, interpretations=("E10", "E12"),
)  # fmt: skip

PB2_02c = holds_after(
    "PB2-02c", "While an obstacle stays at 70 cm or less the decision is to stop, from the second step on.",
    premise=near, for_=1 * tick, then=stopped,
    covers=STOP, on="obstacles_n_free", interpretations=("E10", "E12"),
)  # fmt: skip

PB2_02d = always(
    "PB2-02d", "While non-degraded, an obstacle at 70 cm or less makes B2Dec = 1 within 1 step.",
    that=implies(previous(near & ~DEG_B1) & ~DEG_B1, (B2Dec == 1) | (previous(B2Dec) == 1)),
    covers=STOP, on="obstacles_free", from_tick=2, interpretations=("E12", "E32"),
)  # fmt: skip

PB2_02e = holds_after(
    "PB2-02e", "An obstacle at 70 cm or less in two steps running means CMD_ESTOP, degraded or not.",
    premise=near, for_=1 * tick, then=command == "CMD_ESTOP",
    covers=(*STOP, "B2-OBS-04"), on="obstacles_free", interpretations=("E04", "E12", "E32"),
)  # fmt: skip

PB2_02_scan = holds_after(
    "PB2-02-scan", "With a sonar scan every 60 ms, an obstacle at 70 cm or less for 3 steps stops it.",
    premise=echo_near, for_=3 * ticks, then=command == "CMD_ESTOP",
    covers=STOP, on="obstacles_scan_free", interpretations=("E04", "E12", "E32"),
)  # fmt: skip

PB2_02_scan_2 = holds_after(
    "PB2-02-scan-2", "With a sonar scan every 60 ms, an obstacle at 70 cm or less for 2 steps stops it.",
    premise=echo_near, for_=2 * ticks, then=command == "CMD_ESTOP",
    covers=STOP, on="obstacles_scan_free", interpretations=("E04", "E12", "E32"),
)  # fmt: skip

PB2_03 = always(
    "PB2-03", "The decision is to stop only with an obstacle at 70 cm or less now or one step ago.",
    that=implies(stopped, near | previous(near)),
    covers=("B2-OBS-11", "B2-OBS-12"), on="obstacles_n_free", from_tick=2, interpretations=("E10", "E12"),
)  # fmt: skip

PB2_03b_n1 = holds_after(
    "PB2-03b-n1", "The stop ends at the latest 1 step after the obstacle is beyond 70 cm.",
    premise=~near, for_=1 * tick, then=~stopped,
    covers=("B2-OBS-11", "B2-OBS-12"), on="obstacles_n_free", interpretations=("E10", "E12"),
)  # fmt: skip

PB2_03b_n2 = holds_after(
    "PB2-03b-n2", "The stop ends at the latest 2 steps after the obstacle is beyond 70 cm.",
    premise=~near, for_=2 * ticks, then=~stopped,
    covers=("B2-OBS-11", "B2-OBS-12"), on="obstacles_n_free", interpretations=("E10", "E12"),
)  # fmt: skip

# --- no deviation beside an obstacle at 70 cm [spec §3.4.1 (2b)] -----------------------------------

PB2_04 = always(
    "PB2-04", "One step after an obstacle at 70 cm or less the chart does not deviate.",
    that=implies(previous(near), ~deviating),
    covers=["B2-OBS-15"], on="obstacles_n_free", from_tick=2, interpretations=("E02", "E27"),
)  # fmt: skip

PB2_04_same = always(
    "PB2-04-same", "In the very step of an obstacle at 70 cm or less the chart does not deviate.",
    that=implies(near, ~deviating),
    covers=["B2-OBS-15"], on="obstacles_n", from_tick=2, interpretations=("E02", "E12", "E27"),
)  # fmt: skip

PB2_04_start = enters_only_if(
    "PB2-04-start", "No deviation begins in a step with an obstacle at 70 cm or less.",
    entering=deviating, only_if=~near,
    covers=["B2-OBS-15"], on="obstacles_n_free", from_tick=2, interpretations=("E02", "E27"),
)  # fmt: skip

PB2_04b = always(
    "PB2-04b", "While an obstacle is at 70 cm or less the three detection flags do not change.",
    that=implies(stop, all_of(*(seen == previous(seen) for seen in DETECTED))),
    covers=["B2-OBS-15"], on="obstacles_n_free", interpretations=("E02", "E18", "E27"),
)  # fmt: skip

# --- the end of a deviation [spec §3.4.1 (1), Fig 25] ----------------------------------------------

turned = named("turn since entry", wrap(yaw - previous(targetAngle) - 45))
turned_right = named("turn since entry", wrap(yaw - previous(targetAngle) + 45))

PB2_08_left = leaves_only_if(
    "PB2-08-left", "Moving toward sonar 1 ends only 45 degrees to the left, by emergency or prevDEG_B1.",
    leaving=chart.active("MoveToS1"), only_if=(turned <= -45) | cut_short,
    covers=["B2-OBS-09"], on="obstacles_heading_free", interpretations=("E06", "E07"),
)  # fmt: skip

PB2_08_right = leaves_only_if(
    "PB2-08-right", "Moving toward sonar 3 ends only 45 degrees to the right, by emergency or prevDEG_B1.",
    leaving=chart.active("MoveToS3"), only_if=(turned_right >= 45) | cut_short,
    covers=["B2-OBS-09"], on="obstacles_heading_free", interpretations=("E06", "E07"),
)  # fmt: skip

PB2_08_135 = leaves_only_if(
    "PB2-08-135", "Moving toward sonar 1 ends only after 45 degrees to the left or over 135 to the right.",
    leaving=chart.active("MoveToS1"), only_if=(turned <= -45) | (turned > 135) | cut_short,
    covers=["B2-OBS-09"], on="obstacles_heading_free", interpretations=("E06", "E07"),
)  # fmt: skip

PB2_08_target = enters_only_if(
    "PB2-08-target", "The target stored on entry of MoveToS1 is 45 degrees to the left of the heading.",
    entering=chart.active("MoveToS1"), only_if=wrap(yaw - targetAngle) == 45,
    covers=["B2-OBS-09"], on="obstacles_heading_free", interpretations=["E07"],
)  # fmt: skip

PB2_08_left_told = leaves_only_if(
    "PB2-08-left-told", "A rover that turns as told has turned 45 degrees when moving toward sonar 1 ends.",
    leaving=chart.active("MoveToS1"), only_if=(turned <= -45) | cut_short,
    covers=["B2-OBS-09"], on="obstacles_turning_free", interpretations=("E06", "E07"),
)  # fmt: skip

PB2_08_right_told = leaves_only_if(
    "PB2-08-right-told", "A rover that turns as told has turned 45 degrees when moving toward sonar 3 ends.",
    leaving=chart.active("MoveToS3"), only_if=(turned_right >= 45) | cut_short,
    covers=["B2-OBS-09"], on="obstacles_turning_free", interpretations=("E06", "E07"),
)  # fmt: skip

PB2_09c_left = responds(
    "PB2-09c-left", "If the rover turns as told, 15 degrees a step or more, decision 2 ends within 3 steps.",
    trigger=B2Decision == 2, response=B2Decision != 2, within=3 * ticks,
    covers=["B2-OBS-09"], on="obstacles_turning_free", interpretations=("E06", "E08"),
)  # fmt: skip

PB2_09c_right = responds(
    "PB2-09c-right", "If the rover turns as told, 15 degrees a step or more, decision 4 ends within 3 steps.",
    trigger=B2Decision == 4, response=B2Decision != 4, within=3 * ticks,
    covers=["B2-OBS-09"], on="obstacles_turning_free", interpretations=("E06", "E08"),
)  # fmt: skip

PB2_09b = responds(
    "PB2-09b", "Moving toward sonar 1 ends within 10 s.",
    trigger=B2Decision == 2, response=B2Decision != 2, within=10 * sec,
    covers=["B2-OBS-09"], on="obstacles_n_left", interpretations=["E08"],
)  # fmt: skip

PB2_09b_straight = responds(
    "PB2-09b-straight", "Moving toward sonar 2 ends within 10 s.",
    trigger=B2Decision == 3, response=B2Decision != 3, within=10 * sec,
    covers=["B2-OBS-09"], on="obstacles_n_sides", interpretations=("E05", "E08"),
)  # fmt: skip

PB2_10_least = leaves_only_if(
    "PB2-10-least", "Moving toward sonar 2 lasts at least 25 steps unless cut short.",
    leaving=B2Decision == 3, only_if=previous(held(B2Decision == 3, 24 * ticks)) | cut_short,
    covers=["B2-OBS-08"], on="obstacles_n_straight", interpretations=["E05"],
)  # fmt: skip

PB2_10_most = never(
    "PB2-10-most", "Moving toward sonar 2 lasts at most 25 steps.",
    that=held(B2Decision == 3, 25 * ticks),
    covers=["B2-OBS-08"], on="obstacles_n_sides", interpretations=["E05"],
)  # fmt: skip

# --- the output [spec §3.4.1 (1), Figs 24, 25] -----------------------------------------------------

DECISIONS = ("Waiting", "InEmergency", "MoveToS1", "MoveToS2", "MoveToS3")

PB2_11 = always(
    "PB2-11", "The output of the chart is 0 to 4 and names the active state of B2Decisions.",
    that=any_of(*(
        chart.active(f"B2Decisions.{state}") & (B2Decision == number)
        for number, state in enumerate(DECISIONS)
    )),
    covers=("B2-OBS-05", "B2-OBS-07", "B2-OBS-08"), on="obstacles_n_free", interpretations=["E04"],
)  # fmt: skip
