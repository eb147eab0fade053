"""What surrounds Board 2 when it is checked: when sonar data change, how the rover turns; both optional.

Without ``sonar_scan`` the three distances are arbitrary in every step, which covers every sonar.  With
it they are replaced in the first step, then again after one to three steps (the phase of the sonar
task is a constant nobody knows), and from then on in every third step: assumptions A01 and A07.  The
scan time of up to 20 ms, by which one replacement may come a step later, is left out.

Without ``turns_as_told`` the heading is arbitrary in every step, which covers every rover.
"""

from rovercheck.spec_model.ambiguity import choose, under
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of, any_of, flag, implies, ite, var
from rovercheck.spec_model.lang.words import maximum, wrap
from rovercheck.spec_model.signals.board2 import SONARS, B2Decision, number, sonar_fault

# One distance for each set that no limit of the charts divides: ..70, 71..100, 101..300, 301..
cell = chosen([70, 100, 300, 301], "cm")

echo = tuple(var(f"echo{i}", cell, doc=f"distance sonar S{i} would measure in this step") for i in (1, 2, 3))
scan_phase = var("scan_phase", integer(0, 2), doc="steps between the first step and the next scan, less one")
until_scan = var("until_scan", integer(0, 2), doc="steps until the sonar data are replaced")
scanned = flag("scanned", "the first scan has been read")

other = tuple(flag(f"other{i}", f"echo{i} stands for its part beyond a limit of E02, E03") for i in (1, 2, 3))
missing = tuple(
    flag(f"missing{i}", f"S{i} hears no echo at all, cable cut for instance (E13)") for i in (1, 2, 3)
)


def _measured(i: int) -> Expr:
    """A distance for each set that the limits divide under E02 and E03."""
    below_70 = ite((echo[i] == 70) & other[i], 0, echo[i])
    exactly_70 = ite(echo[i] == 70, 0, echo[i])
    inside = ite((echo[i] == 300) & other[i], 299, echo[i])
    outside = ite(echo[i] == 100, 71, echo[i])
    below = choose("E02", {"B70-STOP": echo[i], "B70-BOTH": below_70, "B70-LT": exactly_70})
    return choose("E03", {"OPEN": inside, "CLOSED": outside, "HALF": below, "UNBOUNDED": echo[i]})


def _replaced(d: Var, i: int) -> Expr:
    """What a scan leaves: a missing echo is 301 cm, like the absence of an obstacle (E13).

    HOLD: without all three echoes there is no notification, and the old values stay.
    """
    measured = _measured(i)
    return choose("E13", {
        "FAR": measured,
        "HOLD": ite(any_of(*missing), d, measured),
        "NEAR": ite(missing[i], 70, measured),
        "FAULT": ite(missing[i], 301, measured),
    })  # fmt: skip


sonar_scan = Block("SonarScan", [
    when(until_scan == 0, [
        *(assign(d, _replaced(d, i)) for i, d in enumerate(SONARS)),
        when(under("E13", "FAULT"), [assign(sonar_fault, any_of(*missing))]),
        assign(until_scan, ite(scanned, 2, scan_phase)),
        assign(scanned, TRUE),
    ], [
        assign(until_scan, maximum(until_scan - 1, 0)),
    ]),
], text="Sonar data are replaced every 60 ms (A07), the first time in the first step (A01)")  # fmt: skip


def turns_as_told(yaw: Var, *, least: int, most: int) -> tuple[Block, Expr]:
    """Assumption A06: during a deviation yaw moves ``least`` to ``most`` degrees a step, as commanded.

    The block remembers the heading, after the chart; the condition is the assumption on the next step.
    """
    last_yaw = var("last_yaw", yaw.domain, doc="yaw in the step before, while the rover deviates")
    to_the_left, to_the_right = B2Decision == number(2), B2Decision == number(4)
    turn = wrap(yaw - last_yaw)
    remember = Block("RememberYaw", [
        assign(last_yaw, ite(to_the_left | to_the_right, yaw, 0)),
    ], text="What the assumption about turning compares with (A06)")  # fmt: skip
    return remember, all_of(
        implies(to_the_left, (turn <= -least) & (turn >= -most)),
        implies(to_the_right, (turn >= least) & (turn <= most)),
    )
