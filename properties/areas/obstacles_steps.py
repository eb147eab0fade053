"""What one step of the non-degraded obstacle chart makes of the readings: flags, windows, decisions.

From the readings of the three sonars follow the flags, from these the windows of 3 s, and from the
windows the decision [spec §3.4.1, Figs 25-27].
"""

from rovercheck.properties.areas.obstacles_pairs import (
    DETECTED,
    PAIR_12,
    PAIR_21,
    PAIR_23,
    PAIR_32,
    PAIRS,
    SONARS,
    Pair,
    lost,
)
from rovercheck.properties.document.distances import in_range, within
from rovercheck.properties.forms import Property, always, leaves_only_if, never, precedes
from rovercheck.spec_model.board2.heading import turned_45
from rovercheck.spec_model.board2.obstacles import drawn_n as chart
from rovercheck.spec_model.lang.expr import Expr, all_of, implies, ite
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, previous
from rovercheck.spec_model.signals.board2 import B2Decision, prevDEG_B1, stop

ON = "obstacles_n"
near = within(70)

# --- from the readings to the flags ----------------------------------------------------------------

PB2_40 = always(
    "PB2-40", "In every step the flag stop is up exactly if some sonar measures 70 cm or less.",
    that=stop == near,
    covers=["B2-OBS-11"], on=ON, interpretations=("E02", "E27"),
)  # fmt: skip


def _flag(id: str, sonar: int) -> Property:
    """The flag follows the range of one step ago, unless an obstacle suspends the detection."""
    d, detected = SONARS[sonar - 1], DETECTED[sonar - 1]
    return always(
        id, f"S{sonar} holds a detection exactly if it measured an object in range one step ago; with an "
            "obstacle at 70 cm or less, exactly if it held one then.",
        that=detected == ite(near, previous(detected), previous(in_range(d))),
        covers=("B2-OBS-15", "B2-OBS-16", "B2-OBS-17"), on=ON, from_tick=2,
        interpretations=("E01", "E02", "E03", "E17", "E18", "E27"),
    )  # fmt: skip


def _only_after_range(id: str, sonar: int) -> Property:
    return precedes(
        id, f"S{sonar} holds a detection only if it has measured an object in range.",
        first=in_range(SONARS[sonar - 1]), then=DETECTED[sonar - 1],
        covers=["B2-OBS-16"], on=ON, interpretations=("E01", "E03"),
    )  # fmt: skip


PB2_41_S1, PB2_41_S2, PB2_41_S3 = (_flag(f"PB2-41-S{i}", i) for i in (1, 2, 3))
PB2_42_S1, PB2_42_S2, PB2_42_S3 = (_only_after_range(f"PB2-42-S{i}", i) for i in (1, 2, 3))

# --- from the flags to the windows -----------------------------------------------------------------


def _begins(id: str, pair: Pair) -> Property:
    return always(
        id, f"A window of pair {pair.name} that was closed is open after a step exactly if S{pair.first} "
            f"lost its object in it and S{pair.name[1]} holds none.",
        that=implies(~previous(pair.open), pair.open == (lost[pair.first - 1] & ~pair.confirming)),
        covers=("B2-OBS-18", "B2-OBS-19", "B2-OBS-21"), on=ON, interpretations=("E15", "E17"),
    )  # fmt: skip


def _confirmed(id: str, pair: Pair) -> Property:
    return always(
        id, f"After no step is the window of pair {pair.name} open while S{pair.name[1]} holds a detection.",
        that=implies(pair.open, ~pair.confirming),
        covers=("B2-OBS-19", "B2-OBS-21"), on=ON, interpretations=["E15"],
    )  # fmt: skip


def _lasts(id: str, pair: Pair) -> Property:
    return leaves_only_if(
        id, f"The window of pair {pair.name} closes only after 150 steps, or when S{pair.name[1]} holds a "
            "detection.",
        leaving=pair.open, only_if=previous(held(pair.open, 149 * ticks)) | pair.confirming,
        covers=("B2-OBS-18", "B2-OBS-20", "B2-OBS-21"), on=ON, interpretations=("E14", "E15"),
    )  # fmt: skip


def _expires(id: str, pair: Pair) -> Property:
    return never(
        id, f"The window of pair {pair.name} is not open in 150 steps running in which S{pair.first} loses "
            "no object.",
        that=held(pair.open & ~lost[pair.first - 1], 149 * ticks),
        covers=("B2-OBS-18", "B2-OBS-20", "B2-OBS-21"), on=ON, interpretations=("E14", "E16"),
    )  # fmt: skip


PB2_43_12, PB2_43_21, PB2_43_23, PB2_43_32 = (_begins(f"PB2-43-{p.name}", p) for p in PAIRS)
PB2_44_12, PB2_44_21, PB2_44_23, PB2_44_32 = (_confirmed(f"PB2-44-{p.name}", p) for p in PAIRS)
PB2_45_12, PB2_45_21, PB2_45_23, PB2_45_32 = (_lasts(f"PB2-45-{p.name}", p) for p in PAIRS)
PB2_54_12, PB2_54_21, PB2_54_23, PB2_54_32 = (_expires(f"PB2-54-{p.name}", p) for p in PAIRS)

# --- from the windows to the decision --------------------------------------------------------------

FREE = "obstacles_n_free"
waiting, in_emergency = chart.active("B2Decisions.Waiting"), chart.active("InEmergency")
to_S1, to_S2, to_S3 = (chart.active(f"MoveToS{i}") for i in (1, 2, 3))

PB2_46 = always(
    "PB2-46", "The chart is in InEmergency exactly if an obstacle was at 70 cm or less one step ago.",
    that=in_emergency == previous(near),
    covers=("B2-OBS-11", "B2-OBS-12"), on=FREE, from_tick=2, interpretations=("E02", "E10", "E27"),
)  # fmt: skip

PB2_47 = always(
    "PB2-47", "While prevDEG_B1 is true the chart is in Waiting or InEmergency.",
    that=implies(prevDEG_B1, waiting | in_emergency),
    covers=["B2-OBS-09"], on=FREE, interpretations=("E05", "E08"),
)  # fmt: skip


def _goes_on(id: str, state: str, moving: Expr) -> Property:
    undisturbed = ~turned_45 & ~previous(near) & ~prevDEG_B1
    return always(
        id, f"{state} goes on in a step in which turned_45 and prevDEG_B1 are false, unless an obstacle was "
            "at 70 cm or less one step ago.",
        that=implies(previous(moving) & undisturbed, moving),
        covers=["B2-OBS-09"], on=FREE, from_tick=2, interpretations=("E06", "E08", "E19"),
    )  # fmt: skip


PB2_48_S1, PB2_48_S3 = _goes_on("PB2-48-S1", "MoveToS1", to_S1), _goes_on("PB2-48-S3", "MoveToS3", to_S3)

PB2_49_S1 = always(
    "PB2-49-S1", "MoveToS1 ends in the first step after its begin in which turned_45 is true.",
    that=implies(previous(to_S1) & turned_45, ~to_S1),
    covers=["B2-OBS-09"], on=FREE, from_tick=2, interpretations=("E06", "E08"),
)  # fmt: skip

# Of decision 4 PB2-09c-right asks the same without the exception, and is violated.
PB2_49_S3 = always(
    "PB2-49-S3", "MoveToS3 ends in the first step after its begin in which turned_45 is true, unless a "
                 "window of pair 32 is confirmed in that step.",
    that=implies(previous(to_S3) & turned_45 & ~PAIR_32.sends, ~to_S3),
    covers=["B2-OBS-09"], on=FREE, from_tick=2, interpretations=("E06", "E08"),
)  # fmt: skip


def _at_once(id: str, pair: Pair, moving: Expr) -> Property:
    """As PB2-06, for an object that leaves one sonar in the very step in which the other detects it."""
    earlier = PAIRS[: PAIRS.index(pair)]
    ready = previous(waiting) & ~near & ~previous(near) & ~prevDEG_B1
    premise = all_of(ready, pair.opens, pair.confirming, *(~p.sends for p in earlier))
    return always(
        id, f"In Waiting, an object that S{pair.first} loses while S{pair.name[1]} holds a detection and the "
            f"window of pair {pair.name} is closed leads to decision {pair.decision} in the same step, if no "
            "obstacle is or was at 70 cm or less, prevDEG_B1 is false and no earlier pair sends its signal.",
        that=implies(premise, moving & (B2Decision == pair.decision)),
        covers=("B2-OBS-03", "B2-OBS-19", "B2-OBS-21"), on=FREE, from_tick=2,
        interpretations=("E05", "E15", "E20"),
    )  # fmt: skip


PB2_55_12 = _at_once("PB2-55-12", PAIR_12, to_S1)
PB2_55_21 = _at_once("PB2-55-21", PAIR_21, to_S2)
PB2_55_23 = _at_once("PB2-55-23", PAIR_23, to_S2)
PB2_55_32 = _at_once("PB2-55-32", PAIR_32, to_S3)

# That it lasts at most 25 steps, PB2-10-most, is violated: two signals in its last step begin it again.
PB2_50 = never(
    "PB2-50", "Decision 3 does not hold in 25 steps running in which no window of pair 21 or 23 is "
              "confirmed.",
    that=held((B2Decision == 3) & ~(PAIR_21.sends | PAIR_23.sends), 24 * ticks),
    covers=["B2-OBS-08"], on="obstacles_n_straight", interpretations=["E05"],
)  # fmt: skip
