"""Board 1 with updates at any ms between two steps: its link monitors, and the whole with constant phases."""

from dataclasses import replace

from rovercheck.spec_model.board1 import SUPERVISOR, supervisor
from rovercheck.spec_model.board1.heartbeat import heartbeat_monitor, monitor_heartbeat
from rovercheck.spec_model.board1.reception import reception_monitor
from rovercheck.spec_model.board1.systems import FEW_VALUES, HEADINGS, board1
from rovercheck.spec_model.board1.wheels import monitor_wheels
from rovercheck.spec_model.environment import milliseconds as env
from rovercheck.spec_model.environment.board1 import reception_clock
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board1_fine as fine
from rovercheck.spec_model.system_table import SystemTable

STAMPS = (
    "Time stamps are exact to the ms. Several updates between two steps are one update with the latest "
    "stamp, unless S36 is ARRIVAL."
)
ALIKE_INTERVALS = (
    "The ten intervals are forgotten: from the eleventh update on, whether their mean exceeds 40 ms is "
    "free at each update, unless all ten lie on one side of 40 ms (more runs than the specification)."
)
STAMPED_LATE = (
    "The specification stamps a heartbeat with the step that sees it, which here is an arrival at its "
    "instant; earlier stamps are more runs."
)

reception = reception_monitor(fine.rx_age_ms)
heartbeat = heartbeat_monitor(fine.heartbeat_age_ms)

reception_ms = in_order(
    "reception_ms",
    env.reception_clock,
    env.reception_any_mean,
    reception,
    text="Reception monitor with frames that arrive at any ms, the mean of ten unlike intervals left open.",
    notes=[STAMPS, ALIKE_INTERVALS],
    over=True,
    concrete="reception_ms_exact",
)


def _reception_exact() -> System:
    return in_order(
        "reception_ms_exact",
        env.reception_clock,
        env.reception_record(),
        reception,
        text="Reception monitor with frames that arrive at any ms and the exact mean of ten intervals.",
        notes=[STAMPS],
    )


heartbeat_ms = in_order(
    "heartbeat_ms",
    env.heartbeat_clock,
    env.heartbeat_any_mean,
    heartbeat,
    text="Heartbeat monitor with heartbeats at any ms, the mean of ten unlike intervals left open.",
    notes=[STAMPS, STAMPED_LATE, ALIKE_INTERVALS],
    over=True,
    concrete="heartbeat_ms_exact",
)


def _heartbeat_exact() -> System:
    return in_order(
        "heartbeat_ms_exact",
        env.heartbeat_clock,
        env.heartbeat_record(),
        heartbeat,
        text="Heartbeat monitor with heartbeats at any ms and the exact mean of ten intervals.",
        notes=[STAMPS, STAMPED_LATE],
    )


LINKS_MS = (*monitor_wheels, monitor_heartbeat, reception)
"""The monitors of a link whose frames may come between the steps; heartbeats come on them."""


def _board1_ms() -> System:
    environment = [
        env.reception_at(b1.rx_phase) if part is reception_clock else part
        for part in board1().components[: -len(SUPERVISOR)]
    ]
    return replace(
        board1(),
        name="board1_ms",
        components=(*environment, *supervisor(LINKS_MS)),
        text="The whole supervisor of Board 1; frames come any ms before a step, always as many.",
        frozen=(b1.rx_phase,),
        notes=(env.CONSTANT_PHASE, FEW_VALUES, HEADINGS),
        place=None,
    )


SYSTEMS = SystemTable(
    reception_ms,
    ("reception_ms_exact", _reception_exact),
    heartbeat_ms,
    ("heartbeat_ms_exact", _heartbeat_exact),
    ("board1_ms", _board1_ms),
)
