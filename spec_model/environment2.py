"""What surrounds Board 2 when it is checked: when sonar data change, how the rover turns; both optional.

Without ``sonar_scan`` the three distances are arbitrary in every step, which covers every sonar.  With
it they are replaced in the first step, then again after one to three steps (the phase of the sonar
task is a constant nobody knows), and from then on in every third step: assumptions A01 and A07.  The
scan time of up to 20 ms, by which one replacement may come a step later, is left out.

Without ``turns_as_told`` the heading is arbitrary in every step, which covers every rover.
"""

from spec_model.lang.action import assign, when
from spec_model.lang.chart import Block
from spec_model.lang.domain import chosen, integer
from spec_model.lang.expr import TRUE, Expr, Var, all_of, flag, implies, ite, var
from spec_model.lang.words import maximum, wrap
from spec_model.signals.board2 import SONARS, B2Decision

# One distance for each set that no limit of the charts divides: ..70, 71..100, 101..300, 301..
cell = chosen([70, 100, 300, 301], "cm")

echo = tuple(var(f"echo{i}", cell, doc=f"distance sonar S{i} would measure in this step") for i in (1, 2, 3))
scan_phase = var("scan_phase", integer(0, 2), doc="steps between the first step and the next scan, less one")
until_scan = var("until_scan", integer(0, 2), doc="steps until the sonar data are replaced")
scanned = flag("scanned", "the first scan has been read")

sonar_scan = Block("SonarScan", [
    when(until_scan == 0, [
        *(assign(d, measured) for d, measured in zip(SONARS, echo, strict=True)),
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
    deviating = (B2Decision == 2) | (B2Decision == 4)
    turn = wrap(yaw - last_yaw)
    remember = Block("RememberYaw", [
        assign(last_yaw, ite(deviating, yaw, 0)),
    ], text="What the assumption about turning compares with (A06)")  # fmt: skip
    return remember, all_of(
        implies(B2Decision == 2, (turn <= -least) & (turn >= -most)),
        implies(B2Decision == 4, (turn >= least) & (turn <= most)),
    )
