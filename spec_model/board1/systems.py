"""The systems of Board 1 that are checked: charts alone with free inputs, and the whole supervisor.

A chart alone with free inputs has every run it has inside the board, and perhaps more: what is proved
of it holds in the board too, and a counterexample counts when the board has one as well.
"""

from functools import cache

from rovercheck.spec_model.board1 import SUPERVISOR, computed, references, safety_computed
from rovercheck.spec_model.board1.backward import toggle
from rovercheck.spec_model.board1.battery import monitor_battery
from rovercheck.spec_model.board1.classify import process_b2_masks
from rovercheck.spec_model.board1.heartbeat import monitor_heartbeat
from rovercheck.spec_model.board1.limits import update_safety_limits
from rovercheck.spec_model.board1.masks import fault_masks, own_causes
from rovercheck.spec_model.board1.motion import motion_with_free_error
from rovercheck.spec_model.board1.reception import monitor_reception
from rovercheck.spec_model.board1.relay import relay
from rovercheck.spec_model.board1.safety import safety_state
from rovercheck.spec_model.board1.temperature import monitor_temperature
from rovercheck.spec_model.board1.wheels import monitor_wheels
from rovercheck.spec_model.environment import board1 as env
from rovercheck.spec_model.lang.chart import Enabled
from rovercheck.spec_model.lang.system import Note, System, in_order
from rovercheck.spec_model.records import arrival_window, slow_record
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.system_table import SystemTable

GRID = Note(
    "Time stamps lie on the 20 ms grid, the first step at 20 ms: an update carries the time of the step "
    "that sees it. A stamp between two steps lets an age pass a strict limit one step earlier.",
    brief="stamps on the steps",
)
ANY_INTERVALS = (
    "The ten intervals are forgotten: from the eleventh update on, whether their mean exceeds 40 ms is "
    "free at each update (more runs than the specification)."
)
FREE_STATUSES = (
    "The statuses are free in every step, which allows every run of the monitors and more: what is "
    "proved here holds for the whole board."
)
FREE_CAUSES = (
    "The relay decision is free, the causes b1_critical, b1_degraded, b2_critical and b2_degraded do not "
    "follow from masks, nor wheels_below_2_5 from four wheel speeds."
)
FREE_BACKWARD = "Backward mode is free in every step, which allows every run of its toggle and more."
FREE_ERROR = (
    "In Retromarcia_180 what is left to turn is free in every step after that of entry, where it is -180 "
    "degrees; for a chart that meets an arbitrary yaw this adds and loses no run."
)
FEW_VALUES = "Measurements take representative values on each side of every limit."
HEADINGS = "Headings are multiples of 2.5 degrees, arbitrary in every frame."

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
    slow_record("rx", b1.rx_update, exact=False),
    monitor_reception,
    text="Reception monitor with frames that arrive at will, the mean of ten intervals left open.",
    notes=[GRID, ANY_INTERVALS],
    over=True,
    concrete="reception_exact",
)


def _reception_exact() -> System:
    return in_order(
        "reception_exact",
        env.reception_clock,
        arrival_window("rx", b1.rx_update),
        monitor_reception,
        text="Reception monitor with frames that arrive at will and the exact mean of ten intervals.",
        notes=[GRID],
    )


heartbeat = in_order(
    "heartbeat",
    env.heartbeat_clock,
    slow_record("heartbeat", b1.heartbeat_update, exact=False, moves=b1.heartbeat_moves),
    monitor_heartbeat,
    text="Heartbeat monitor with heartbeats that change at will, the mean of ten intervals left open.",
    notes=[GRID, ANY_INTERVALS],
    over=True,
    concrete="heartbeat_exact",
)


def _heartbeat_exact() -> System:
    return in_order(
        "heartbeat_exact",
        env.heartbeat_clock,
        arrival_window("heartbeat", b1.heartbeat_update, moves=b1.heartbeat_moves),
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
    Enabled(safety_computed, safety_state),
    text="The safety state for any masks of Board 2, any causes in Board 1 and any relay decision.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board1",
)

references_parts = (safety_state, update_safety_limits, motion_with_free_error)
"""Calculation of the references in executed steps, for any backward mode and heading."""

references_for_any_yaw = in_order(
    "references",
    references(motion_with_free_error),
    text="Safety state, limits and references, for any relay decision, faults, commands and wheel speeds.",
    notes=[FREE_STATUSES, FREE_CAUSES, FREE_BACKWARD, FREE_ERROR],
    over=True,
    concrete="board1_plain",
)

references_executed = in_order(
    "references_executed",
    *references_parts,
    text="As references, alone, in the steps in which Board 1 actuates: time is counted in executed steps.",
    notes=[
        "The causes, the command, the user, backward mode and the wheels are free in every step.",
        FREE_ERROR,
        "While Board 2 actuates nothing here changes (S48); those steps are left out.",
    ],
)

backward = in_order(
    "backward",
    toggle,
    text="The toggle of backward mode for any buttons and stick, in the steps in which Board 1 actuates.",
    notes=["While Board 2 actuates the toggle is frozen (S48); those steps are left out."],
)

backward_frozen = in_order(
    "backward_frozen",
    relay,
    Enabled(computed, toggle),
    text="The relay decision and the toggle of backward mode, for any buttons, stick and statuses.",
    notes=["The statuses of reception and Board 2 supervisor are free in every step."],
    over=True,
    concrete="board1_buttons",
)


@cache
def board1() -> System:
    """The whole supervisor of Board 1."""
    return in_order(
        "board1",
        env.temperature_readings,
        env.battery_readings,
        env.received_payload,
        env.reception_clock,
        env.heartbeat_clock,
        arrival_window("rx", b1.rx_update),
        arrival_window("heartbeat", b1.heartbeat_update, moves=b1.heartbeat_moves),
        env.check_stop,
        *SUPERVISOR,
        text="The whole supervisor of Board 1, with exact records of ten intervals.",
        assume=env.heartbeat_travels_in_frames,
        notes=[GRID, FEW_VALUES, HEADINGS],
    )


# The board comes before systems with a simpler form of its charts: charts are shown as in the first.
SYSTEMS = SystemTable(
    temperature,
    battery,
    *wheels,
    reception,
    ("reception_exact", _reception_exact),
    heartbeat,
    ("heartbeat_exact", _heartbeat_exact),
    masks,
    relay_alone,
    relay_links,
    safety,
    ("board1", board1),
    references_for_any_yaw,
    references_executed,
    backward,
    backward_frozen,
)
