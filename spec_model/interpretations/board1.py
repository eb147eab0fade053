"""What Board 1 makes of its statuses under other interpretations: masks, relay, safety, what is computed."""

from rovercheck.spec_model.board1 import computed, safety_computed
from rovercheck.spec_model.board1.classify import degraded_required, stop_required
from rovercheck.spec_model.board1.masks import COMPONENTS
from rovercheck.spec_model.board1.relay import neither_critical, rx_critical, sup_critical
from rovercheck.spec_model.board1.safety import critical, degraded
from rovercheck.spec_model.interpretations import alternative
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.change import at_once, formula, formulas, guards, lasting
from rovercheck.spec_model.lang.chart import Block, Enabled
from rovercheck.spec_model.lang.edit import swap
from rovercheck.spec_model.lang.expr import TRUE, Expr, Named, all_of, any_of
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.words import bit, named
from rovercheck.spec_model.signals.board1 import (
    b2_sup_status,
    crit_mask_b2,
    critical_mask,
    degr_mask_b2,
    give_b2_actuation,
    omega_ref,
    rx_status,
    temp_status,
    v_ref,
    wheel_status,
)

MASKS, CLASSES, RELAY, SAFETY = "Fault_masks", "Process_B2_masks", "Relay", "Safety_state"

# --- masks (S33, S51, S52) -------------------------------------------------------------------------------

wheels = wheel_status.values()
printed = [
    (status == level, temp_status == temperature)
    for status, *levels in COMPONENTS
    for level, temperature in zip(levels, ("TEMP_HEALTH_CRITICAL", "TEMP_HEALTH_DEGRADED"), strict=True)
    if status is not rx_status and status is not temp_status
]
"""Each level with that of the temperature, which Table 3 prints on every row but reception's."""


def worst(level: str) -> Expr:
    """A wheel has that level, and none a worse one."""
    some = any_of(*(wheel == level for wheel in wheels))
    if level == "WHEEL_CRITICAL_MOTOR":
        return some
    return all_of(some, *(wheel != "WHEEL_CRITICAL_MOTOR" for wheel in wheels))


MASK_ALTERNATIVES = (
    alternative("S52", "BOTH", "A critical component is degraded too.", MASKS,
        formulas(*((s == degr, (s == degr) | (s == crit)) for s, crit, degr in COMPONENTS))),
    alternative("S51", "LITERAL", "Each row of Table 3 means the levels that it prints.", MASKS,
        formulas(*printed)),
    alternative("S33", "AGGREGATE", "All four wheels have the level of the worst.", MASKS,
        formulas(*((wheel == level, worst(level))
                   for wheel in wheels for level in ("WHEEL_CRITICAL_MOTOR", "WHEEL_DEGRADED_ENCODER")))),
    alternative("S54", "SAME-AS-B1", "The bits of Board 2 are those of Table 1.", CLASSES,
        # of which the link (2) slows down and the others stop; bits 4 to 7 are beyond the four modelled
        formula(stop_required, named(stop_required.name, any_of(*(bit(crit_mask_b2, i) for i in (0, 1, 3))))),
        formula(degraded_required,
                named(degraded_required.name, bit(crit_mask_b2, 2) | (degr_mask_b2 != 0)))),
    alternative("S55", "ANY-BIT", "Any critical bit of Board 2 stops the rover.", CLASSES,
        formula(stop_required, named(stop_required.name, crit_mask_b2 != 0)),
        formula(degraded_required, named(degraded_required.name, degr_mask_b2 != 0))),
)  # fmt: skip

# --- relay (S43 to S45, S50) -----------------------------------------------------------------------------

both_ok = (rx_status == "RX_OK") & (b2_sup_status == "SUP_OK")


RELAY_ALTERNATIVES = (
    alternative("S43", "AND", "Both, reception and supervisor, must be critical.", RELAY,
        formula(rx_critical | sup_critical, rx_critical & sup_critical)),
    alternative("S44", "STRICT-OK-KEPT", "The motors return when both are OK.", RELAY,
        formula(neither_critical, both_ok)),
    alternative("S44", "STRICT-OK-1", "The motors are given unless both are OK.", RELAY,
        guards("B1_actuating", "B2_actuating", lambda _: ~both_ok),
        formula(neither_critical, both_ok)),
    alternative("S50", "ANY-CRITICAL", "Any critical component gives the motors.", RELAY,
        guards("B1_actuating", "B2_actuating", lambda given: given | (critical_mask != 0)),
        guards("B2_actuating", "B1_actuating", lasting(lambda returned: returned & (critical_mask == 0)))),
    alternative("S45", "IMMEDIATE", "The motors return without delay.", RELAY,
        guards("B2_actuating", "B1_actuating", at_once)),
)  # fmt: skip

# --- safety state, and what is computed while Board 2 actuates (S48, S49, S56) ---------------------------


def in_every_step(subsystem: Enabled) -> Enabled:
    assert isinstance(subsystem.by, Named)
    return Enabled(named(subsystem.by.name, TRUE), *subsystem.components, name=subsystem.name)


def zero_meanwhile(subsystem: Enabled) -> tuple[Block, Enabled]:
    zero = when(give_b2_actuation, [assign(v_ref, 0), assign(omega_ref, 0)])
    return Block("No_references", [zero], text="References that are not computed are 0."), subsystem


def computes_references(system: System) -> bool:
    return v_ref.name in system.written


ALTERNATIVES = (
    *MASK_ALTERNATIVES,
    *RELAY_ALTERNATIVES,
    alternative("S56", "CRIT-FIRST", "A critical cause is tested before a degraded one that is gone.", SAFETY,
        lambda chart: swap(chart, "Rover_Degraded_State", 1, 2)),
    alternative("S56", "DEG-FIRST", "With a degraded cause a critical one does not stop the rover.", SAFETY,
        formula(critical, critical & ~degraded)),
    *(alternative("S48", "STILL-COMPUTED", "Board 1 computes on while Board 2 actuates.", condition.name,
        in_every_step) for condition in (safety_computed, computed)),
    alternative("S49", "STOP-AND-GIVE", "The safety state is computed in every step.", safety_computed.name,
        in_every_step),
    alternative("S48", "ZERO", "References are 0 while Board 2 actuates.", safety_computed.name,
        zero_meanwhile, among=computes_references),
)  # fmt: skip
