"""The supervisor of Board 1: its charts and function blocks in execution order [spec §2.1, Fig 11].

Fault detection, masks, classes of Board 2's faults, relay; then, if Board 1 actuates, safety state,
limits and references.  A block sees in the same step what the blocks before it produced.
"""

from collections.abc import Sequence

from rovercheck.spec_model.board1.backward import toggle
from rovercheck.spec_model.board1.battery import monitor_battery
from rovercheck.spec_model.board1.classify import process_b2_masks
from rovercheck.spec_model.board1.heartbeat import monitor_heartbeat
from rovercheck.spec_model.board1.limits import update_safety_limits
from rovercheck.spec_model.board1.masks import fault_masks, own_causes
from rovercheck.spec_model.board1.motion import motion_supervision
from rovercheck.spec_model.board1.reception import monitor_reception
from rovercheck.spec_model.board1.relay import relay
from rovercheck.spec_model.board1.safety import safety_state
from rovercheck.spec_model.board1.temperature import monitor_temperature
from rovercheck.spec_model.board1.wheels import monitor_wheels
from rovercheck.spec_model.lang.chart import Chart, Component, Enabled
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import give_b2_actuation

LINKS = (*monitor_wheels, monitor_heartbeat, monitor_reception)
"""The monitors of what Board 2 sends and of what its frames carry."""


def monitors(links: Sequence[Chart] = LINKS) -> tuple[Component, ...]:
    """Fault detection: mutually independent [spec §2.4, Fig 15]."""
    return (monitor_temperature, monitor_battery, *links)


computed = named("Board 1 computes its references", ~give_b2_actuation)
safety_computed = named("Board 1 computes its safety state", ~give_b2_actuation)


def references(*charts: Component) -> Enabled:
    """Calculation of the references by these charts, executed only while Board 1 actuates [spec §2.1].

    What is not executed keeps its state and its outputs (S48), and the safety state too (S49).
    """
    return Enabled(safety_computed, safety_state, Enabled(computed, update_safety_limits, *charts))


REFERENCES = references(toggle, motion_supervision)


def supervisor(links: Sequence[Chart] = LINKS) -> tuple[Component, ...]:
    """The whole supervisor of Board 1; ``links`` read how old the last frame is."""
    return (
        *monitors(links),
        fault_masks,
        own_causes,
        process_b2_masks,
        relay,
        REFERENCES,
    )


SUPERVISOR: tuple[Component, ...] = supervisor()
"""The whole supervisor of Board 1, as drawn."""
