"""Board 2 without its obstacle charts under other interpretations: acquisition, monitors, masks."""

from collections.abc import Callable
from dataclasses import replace

from rovercheck.spec_model.board2.acquisition import (
    axis_x,
    axis_y,
    button1,
    button2,
    captured,
    centimetres,
    distance,
    flags,
)
from rovercheck.spec_model.board2.failure_check import rx_critical, sup_critical
from rovercheck.spec_model.board2.masks import COMPONENTS
from rovercheck.spec_model.board2.slow2 import GAPS, enough
from rovercheck.spec_model.interpretations import Change, alternative
from rovercheck.spec_model.lang.action import Action, If, assign
from rovercheck.spec_model.lang.change import (
    assigned,
    at_once,
    constantly,
    doing,
    formula,
    formulas,
    guard_of,
    guards,
)
from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var, all_of, const, ite
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board2 import sonar_fault
from rovercheck.spec_model.signals.board2_supervisor import (
    b1_requests_switch,
    b1_sup_status,
    crit_mask_b1,
    degr_mask_b1,
    rx_status,
)

SONAR, JOYSTICK = "SonarTask", "BleTask"
MONITORS, TWINS = "Monitors_2", "Twin_monitors_2"
MASKS, CHECK = "Fault_masks_2", "Check_Board1"

# --- acquisition (E13, E28) ------------------------------------------------------------------------------

complete = all_of(*flags)
"""All three echoes have come."""


def published(value: Callable[[Var, Var, Var], Expr]) -> tuple[Change, ...]:
    """Another distance of each sonar, from the old one, the flag and the pulse."""
    values = map(value, distance, flags, captured)
    return tuple(assigned(d, constantly(new)) for d, new in zip(distance, values, strict=True))


def report(do: tuple[Action, ...]) -> tuple[Action, ...]:
    *distances, published = do
    return (*distances, assign(sonar_fault, ~complete), published)


def neutral_otherwise(block: Block) -> Block:
    neutral = (assign(axis_x, 0), assign(axis_y, 0), assign(button1, FALSE), assign(button2, FALSE))
    do = [replace(a, otherwise=neutral) if isinstance(a, If) else a for a in block.do]
    return Block(block.name, do, text=block.text, place=block.place)


ACQUISITION = (
    alternative("E13", "HOLD", "A scan without all three echoes leaves the old values.", SONAR,
        *published(lambda old, seen, pulse: ite(complete, centimetres(pulse), old))),
    alternative("E13", "NEAR", "A missing echo counts as an obstacle at 70 cm.", SONAR,
        *published(lambda old, seen, pulse: ite(seen, centimetres(pulse), const(70, "cm")))),
    alternative("E13", "FAULT", "A missing echo is a fault.", SONAR, doing("Scanning", "Idle", report)),
    alternative("E28", "NEUTRAL", "An incomplete read puts the stick at rest.", JOYSTICK, neutral_otherwise),
)  # fmt: skip

# --- monitors (E26, E29) ---------------------------------------------------------------------------------


def recovers_at_once(chart: Chart) -> Chart:
    """A critical source returns as soon as it is not silent, a degraded one as soon as its mean is short."""
    for region in chart.root.states:
        silent = guard_of(chart, f"{region.name}.OK", "CRIT")
        chart = guards(f"{region.name}.DEG", "OK", at_once)(chart)
        chart = guards(f"{region.name}.CRIT", "OK", constantly(~silent))(chart)
    return chart


def gaps_in(chart: Chart) -> list[Var]:
    return [v for v in chart.read.values() if v.name.endswith("_gaps")]


def ten_gaps(chart: Chart) -> Chart:
    return formulas(*((enough(gaps), gaps >= GAPS) for gaps in gaps_in(chart)))(chart)


def counts_gaps(system: System) -> bool:
    """Its records know how many gaps they hold; one that forgets the gaps does not."""
    return any(gaps_in(chart) for chart in system.charts)


MONITOR_ALTERNATIVES = (
    *(alternative("E26", "WAIT-10", "A mean needs ten gaps.", chart, ten_gaps, among=counts_gaps)
      for chart in (MONITORS, TWINS)),
    *(alternative("E29", "INSTANT", "A source returns without delay.", chart, recovers_at_once)
      for chart in (MONITORS, TWINS)),
)  # fmt: skip

# --- masks and authorisation (E22 to E24, S43 to S45) ----------------------------------------------------

(_, *supervisor) = COMPONENTS[3]
reflected = [
    (b1_sup_status == level, (b1_sup_status == level) | (mask != 0))
    for level, mask in zip(supervisor, (crit_mask_b1, degr_mask_b1), strict=True)
]
"""Bit 3 by either mask of Board 1."""
untabled = [status == level for status, *levels in COMPONENTS if status is not rx_status for level in levels]
"""Joystick and IMU have no bit in Table 1, and bit 7, the supervisor, is beyond the four modelled."""

both_ok = (rx_status == "RX_OK") & (b1_sup_status == "SUP_OK")


def asks(condition: Expr) -> Change:
    """When Board 2 drives."""
    return guards("B1_actuating", "B2_trying_to_actuate", lambda _: named("q", condition))


def returns(condition: Expr) -> Change:
    return formula("!q", named("!q", condition))


ALTERNATIVES = (
    *ACQUISITION,
    *MONITOR_ALTERNATIVES,
    alternative("E23", "REMOTE", "Bit 3 also reflects the faults that Board 1 reports.", MASKS,
        formulas(*reflected)),
    alternative("E24", "SAME-AS-B1", "The bits are those of Table 1.", MASKS,
        formulas(*((level, FALSE) for level in untabled))),
    alternative("S43", "AND", "Both, reception and supervisor, must be critical.", CHECK,
        asks(b1_requests_switch | (rx_critical & sup_critical)),
        returns(~(b1_requests_switch | rx_critical | sup_critical))),
    alternative("S44", "STRICT-OK-KEPT", "The motors return when both are OK.", CHECK,
        returns(~b1_requests_switch & both_ok)),
    alternative("S44", "STRICT-OK-1", "Board 2 drives unless both are OK.", CHECK,
        asks(b1_requests_switch | ~both_ok),
        returns(~b1_requests_switch & both_ok)),
    alternative("E22", "B1-ONLY", "Only Board 1 authorises, by its request.", CHECK,
        asks(b1_requests_switch),
        returns(~b1_requests_switch)),
    alternative("S45", "IMMEDIATE", "The motors return without delay.", CHECK,
        guards("B2_trying_to_actuate", "B1_actuating", at_once)),
)  # fmt: skip
