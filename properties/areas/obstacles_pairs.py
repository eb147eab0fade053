"""Obstacles moving between two sonars: the windows of 3 s and the signals they send [spec §3.4.1 (2b)].

A pair is named by its sonars, first seen first: pair 12 sees an obstacle move from sonar 1 to 2.
"""

from dataclasses import dataclass

from rovercheck.properties.document.distances import in_range, within
from rovercheck.properties.forms import Property, always, enters_only_if, until
from rovercheck.spec_model.board2.obstacles import drawn_n as chart
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, any_of, implies
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, named, previous
from rovercheck.spec_model.signals.board2 import (
    B2Decision,
    d1,
    d2,
    d3,
    isClose,
    obj1Detected,
    obj2Detected,
    obj3Detected,
    prevDEG_B1,
)

SONARS, DETECTED = (d1, d2, d3), (obj1Detected, obj2Detected, obj3Detected)
near = within(70)
lost = tuple(named(f"S{i} loses its object", previous(d) & ~d) for i, d in enumerate(DETECTED, 1))


@dataclass(frozen=True)
class Pair:
    """One ordered pair: its first sonar, the flag that confirms, the decision it leads to."""

    name: str
    first: int
    confirming: Var
    decision: int

    @property
    def on(self) -> str:
        """The system in which the window of this pair is counted."""
        return f"obstacles_n_{self.name}"

    @property
    def open(self) -> Expr:
        """The window is open at the end of the step."""
        return chart.active(f"timerSonar{self.name}.Fall1Detected")

    @property
    def opens(self) -> Expr:
        """The first sonar loses its object while no window of the pair is open."""
        return lost[self.first - 1] & ~previous(self.open)

    @property
    def was_open(self) -> Expr:
        """The window was open when the timers looked at it in this step."""
        return previous(self.open) | self.opens

    @property
    def sends(self) -> Expr:
        """The window was closed with the confirming flag up."""
        return self.was_open & ~self.open & self.confirming


PAIR_12 = Pair("12", 1, obj2Detected, 2)
PAIR_21 = Pair("21", 2, obj1Detected, 3)
PAIR_23 = Pair("23", 2, obj3Detected, 3)
PAIR_32 = Pair("32", 3, obj2Detected, 4)
PAIRS = (PAIR_12, PAIR_21, PAIR_23, PAIR_32)


def recently(event: Expr) -> Expr:
    """The event was in this step or one of the 149 before it."""
    return ~held(~event, 149 * ticks)


# --- the range in which a moving obstacle is looked for --------------------------------------------

PB2_05c = always(
    "PB2-05c", "A sonar is said to be close at the end of a step if it measures more than 100, up to 300 cm.",
    that=all_of(*(said == in_range(d) for said, d in zip(isClose, SONARS, strict=True))),
    covers=["B2-OBS-16"], on="obstacles_n", interpretations=("E01", "E03"),
)  # fmt: skip

# --- no signal without its cause -------------------------------------------------------------------

WINDOW = ("B2-OBS-16", "B2-OBS-17", "B2-OBS-18", "B2-OBS-19", "B2-OBS-20")


def within_the_window(id: str, pair: Pair) -> Property:
    """The decision of a pair needs its window, opened in [k-149, k], and its second sonar.

    For decision 3, which has two pairs, this is said of the steps in which the other pair cannot
    be the cause.
    """
    # A window of these two cannot end and open again in one step; saying so needs far fewer states.
    cause = pair.opens if pair in (PAIR_12, PAIR_21) else lost[pair.first - 1]
    others = [p for p in PAIRS if p is not pair and p.decision == pair.decision]
    another = any_of(*(p.was_open & p.confirming for p in others))
    return enters_only_if(
        id, f"The signal of pair {pair.name} is sent only if sonar {pair.name[0]} lost an object in the "
            f"last 3 s and sonar {pair.name[1]} has one.",
        entering=B2Decision == pair.decision,
        only_if=(recently(cause) & pair.confirming) | another,
        covers=WINDOW, on=pair.on, interpretations=("E05", "E14", "E15", "E16"),
    )  # fmt: skip


PB2_05_12 = within_the_window("PB2-05-12", PAIR_12)
PB2_05_21 = within_the_window("PB2-05-21", PAIR_21)
PB2_05_23 = within_the_window("PB2-05-23", PAIR_23)
PB2_05_32 = within_the_window("PB2-05-32", PAIR_32)


def from_an_open_window(id: str, *pairs: Pair) -> Property:
    """After a window has closed unconfirmed, its pair is silent until its first sonar loses an object."""
    decision = pairs[0].decision
    return enters_only_if(
        id, f"Decision {decision} is taken only from a window of 3 s that is open in that step.",
        entering=B2Decision == decision, only_if=any_of(*(p.was_open & p.confirming for p in pairs)),
        covers=("B2-OBS-18", "B2-OBS-20", "B2-OBS-21"), on="obstacles_n_free",
        interpretations=("E15", "E16"),
    )  # fmt: skip


PB2_05b_12 = from_an_open_window("PB2-05b-12", PAIR_12)
PB2_05b_2x = from_an_open_window("PB2-05b-2x", PAIR_21, PAIR_23)
PB2_05b_32 = from_an_open_window("PB2-05b-32", PAIR_32)

# --- no cause without its signal -------------------------------------------------------------------


def confirmed(id: str, pair: Pair) -> Property:
    """The decision follows in the step of the confirmation, unless an earlier window takes it."""
    earlier = PAIRS[: PAIRS.index(pair)]
    ready = chart.active("B2Decisions.Waiting")
    premise = all_of(
        pair.was_open & recently(pair.opens) & pair.confirming,
        ~near & ~previous(near),
        previous(ready) & ~prevDEG_B1,
        *(~p.sends for p in earlier),
    )
    return always(
        id, f"An obstacle that moves from sonar {pair.name[0]} to {pair.name[1]} within 3 s "
            f"leads to decision {pair.decision} in the step of its detection.",
        that=implies(premise, B2Decision == pair.decision),
        covers=("B2-OBS-03", "B2-OBS-18", "B2-OBS-19", "B2-OBS-21"), on=pair.on, from_tick=2,
        interpretations=("E05", "E14", "E15", "E20"),
    )  # fmt: skip


PB2_06_12 = confirmed("PB2-06-12", PAIR_12)
PB2_06_21 = confirmed("PB2-06-21", PAIR_21)
PB2_06_23 = confirmed("PB2-06-23", PAIR_23)
PB2_06_32 = confirmed("PB2-06-32", PAIR_32)

# --- the object left sideways, not toward the rover ------------------------------------------------


def left_sideways(id: str, sonar: int, decision: int) -> Property:
    """Once the reading of the first sonar is 100 cm or less, no signal before it is in range again."""
    d = SONARS[sonar - 1]
    begins = (B2Decision == decision) & (previous(B2Decision) != decision)
    return until(
        id, f"Decision {decision} is not taken for an object that S{sonar} lost by its coming nearer "
            "than 100 cm.",
        start=d <= 100, holds=~begins, release=in_range(d),
        covers=("B2-OBS-02", "B2-OBS-17"), on="obstacles_n", from_tick=2, interpretations=["E17"],
    )  # fmt: skip


PB2_07_S1 = left_sideways("PB2-07-S1", 1, 2)
PB2_07_S2 = left_sideways("PB2-07-S2", 2, 3)
PB2_07_S3 = left_sideways("PB2-07-S3", 3, 4)
