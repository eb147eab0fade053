"""The systems of Board 1 that are checked: charts alone with free inputs, and the whole supervisor.

A chart alone with free inputs has every run it has inside the board, and perhaps more: what is proved
of it holds in the board too, and a counterexample counts when the board has one as well.
"""

from spec_model import environment as env
from spec_model.board1 import REFERENCES, SUPERVISOR
from spec_model.board1.battery import monitor_battery
from spec_model.board1.classify import process_b2_masks
from spec_model.board1.heartbeat import monitor_heartbeat
from spec_model.board1.masks import fault_masks, own_causes
from spec_model.board1.motion import no_rotation_asked
from spec_model.board1.reception import monitor_reception
from spec_model.board1.relay import relay
from spec_model.board1.safety import safety_state
from spec_model.board1.temperature import monitor_temperature
from spec_model.board1.wheels import monitor_wheels
from spec_model.lang.chart import Enabled
from spec_model.lang.expr import ite
from spec_model.lang.system import System, in_order
from spec_model.signals import board1 as b1

GRID = (
    "Time stamps lie on the 20 ms grid: an update carries the time of the step that sees it. "
    "A stamp between two steps lets an age pass a strict limit one step earlier."
)
ANY_INTERVALS = (
    "The ten intervals are forgotten: from the eleventh update on, whether their mean exceeds 40 ms is "
    "free at each update (more runs than the specification)."
)
FREE_STATUSES = (
    "The statuses are free in every step, which allows every run of the monitors and more: what is "
    "proved here holds for the whole board."
)
NO_ROTATION = (
    "Retromarcia_180 and the toggle of backward mode are not modelled yet: backward mode is free in "
    "every step, and y_norm < -0.5 is assumed to come in backward mode only."
)
FEW_VALUES = "Measurements take representative values on each side of every limit."

temperature = in_order(
    "temperature",
    env.temperature_readings,
    monitor_temperature,
    text="Temperature monitor with readings that arrive or stay away at will.",
    notes=[GRID, FEW_VALUES],
)

battery = in_order(
    "battery",
    env.battery_readings,
    monitor_battery,
    text="Battery monitor with readings that arrive or stay away at will.",
    notes=[GRID, FEW_VALUES],
)

wheels = tuple(
    in_order(
        f"wheel_{wheel}",
        monitor,
        text=f"The monitor of wheel {wheel}; its encoder flag and the motion coherence are free.",
    )
    for wheel, monitor in zip(b1.WHEELS, monitor_wheels, strict=True)
)

reception = in_order(
    "reception",
    env.reception_clock,
    env.slow_record("rx", b1.rx_update, exact=False),
    monitor_reception,
    text="Reception monitor with frames that arrive at will, the mean of ten intervals left open.",
    notes=[GRID, ANY_INTERVALS],
    over=True,
    concrete="reception_exact",
)

reception_exact = in_order(
    "reception_exact",
    env.reception_clock,
    env.arrival_window("rx", b1.rx_update),
    monitor_reception,
    text="Reception monitor with frames that arrive at will and the exact mean of ten intervals.",
    notes=[GRID],
)

heartbeat = in_order(
    "heartbeat",
    env.heartbeat_clock,
    env.slow_record("heartbeat", b1.heartbeat_update, exact=False),
    monitor_heartbeat,
    text="Heartbeat monitor with heartbeats that change at will, the mean of ten intervals left open.",
    notes=[GRID, ANY_INTERVALS],
    over=True,
    concrete="heartbeat_exact",
)

heartbeat_exact = in_order(
    "heartbeat_exact",
    env.heartbeat_clock,
    env.arrival_window("heartbeat", b1.heartbeat_update),
    monitor_heartbeat,
    text="Heartbeat monitor with heartbeats that change at will and the exact mean of ten intervals.",
    notes=[GRID],
)

masks = in_order(
    "masks",
    fault_masks,
    own_causes,
    text="The two fault masks of Board 1 from any eight statuses.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board1",
)

relay_alone = in_order(
    "relay",
    relay,
    text="The relay decision for any statuses of reception and Board 2 supervisor.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board1",
)

relay_links = in_order(
    "relay_links",
    env.reception_clock,
    env.heartbeat_clock,
    monitor_heartbeat,
    monitor_reception,
    relay,
    text="The relay decision behind the two link monitors, frames and heartbeats arriving at will.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, "Whether a mean of ten intervals exceeds 40 ms is free in every step (more runs)."],
    over=True,
    concrete="board1",
)

safety = in_order(
    "safety",
    process_b2_masks,
    Enabled(~b1.give_b2_actuation, safety_state),
    text="The safety state for any masks of Board 2, any causes in Board 1 and any relay decision.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board1",
)

references = in_order(
    "references",
    REFERENCES,
    text="Safety state, limits and references, for any relay decision, faults, commands and wheel speeds.",
    assume=no_rotation_asked,
    notes=[
        FREE_STATUSES,
        "The relay decision is free, the causes b1_critical, b1_degraded, b2_critical and b2_degraded do not "
        "follow from masks, nor wheels_below_2_5 from four wheel speeds.",
        NO_ROTATION,
    ],
    over=True,
    concrete="board1",
)

latched_y = ite(b1.rx_update, b1.sent(b1.y_norm), b1.y_norm)
"""y_norm as the charts of this step will see it."""

board1 = in_order(
    "board1",
    env.temperature_readings,
    env.battery_readings,
    env.received_payload,
    env.reception_clock,
    env.heartbeat_clock,
    env.arrival_window("rx", b1.rx_update),
    env.arrival_window("heartbeat", b1.heartbeat_update),
    env.check_stop,
    *SUPERVISOR,
    text="The whole supervisor of Board 1, with exact records of ten intervals.",
    assume=env.heartbeat_travels_in_frames & ((latched_y >= -0.5) | b1.backward_enabled),
    notes=[GRID, FEW_VALUES, NO_ROTATION],
)

SYSTEMS: tuple[System, ...] = (
    temperature,
    battery,
    *wheels,
    reception,
    reception_exact,
    heartbeat,
    heartbeat_exact,
    masks,
    relay_alone,
    relay_links,
    safety,
    references,
    board1,
)
