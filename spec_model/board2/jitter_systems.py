"""Board 2 where its steps last 19 to 21 ms: monitors, authorisation, windows of obstacles, the stop."""

from dataclasses import replace
from functools import partial

from rovercheck.spec_model.board2.classify import process_masks
from rovercheck.spec_model.board2.failure_check import check_board1
from rovercheck.spec_model.board2.monitor_systems import FORGOTTEN
from rovercheck.spec_model.board2.monitors import monitors
from rovercheck.spec_model.board2.motion import check_stop_2, motion_2_with_free_error
from rovercheck.spec_model.board2.motion_systems import COMES_BEFORE, FREE_BACKWARD
from rovercheck.spec_model.board2.obstacles import obstacles_n
from rovercheck.spec_model.board2.slow2 import Record, exact_ms, forgotten
from rovercheck.spec_model.board2.systems import FREE_HEADING, TURNS, as_drawn
from rovercheck.spec_model.environment import board2 as board2_env
from rovercheck.spec_model.environment import jitter as env
from rovercheck.spec_model.environment.milliseconds import clock
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import Expr, all_of, flag, implies
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import d1, d2, d3, prevDEG_B1
from rovercheck.spec_model.signals.board2_motion import ay_norm, bx_norm
from rovercheck.spec_model.system_table import SystemTable

# --- the monitors ---------------------------------------------------------------------------------------

SUP, BLE, IMU, RX = SOURCES = tuple(b2.between_steps(source, env.LAG) for source in b2.SOURCES)
"""With stamps some ms before the step that sees them."""
b1_sup_age_ms = SUP.age


def _lag(source: b2.SourceSignals) -> Expr:
    assert source.phase is not None
    return source.phase


def _stamped(source: b2.SourceSignals) -> Expr:
    """An alive counter is stamped with the step that sees it change, other data as they come."""
    return _lag(source) == 0 if source is SUP else _lag(source) < env.step_ms


def _aged(source: b2.SourceSignals, record: Record) -> tuple[Component, ...]:
    """The clock, the record and the region of a source."""
    notes, chart = monitors(record, [source])
    age = clock(f"{source.region}.age", source.update, _lag(source), source.age, env.step_ms)
    return (age, *notes, chart)


def _monitor(source: b2.SourceSignals) -> System:
    return in_order(
        f"monitors_2_{source.region}_jitter",
        *_aged(source, forgotten),
        text=f"The monitor of {source.region} of Board 2 in steps of 19 to 21 ms, with stamps at any ms.",
        assume=_stamped(source),
        notes=[env.JITTER, FORGOTTEN],
        over=True,
        concrete=f"monitors_2_{source.region}_jitter_exact",
        elapsed=env.step_ms,
    )


def _exact(source: b2.SourceSignals) -> System:
    return in_order(
        f"monitors_2_{source.region}_jitter_exact",
        *_aged(source, exact_ms(env.step_ms)),
        text=f"As monitors_2_{source.region}_jitter, with the exact mean of ten gaps.",
        assume=_stamped(source),
        notes=[env.JITTER],
        elapsed=env.step_ms,
    )


def _ageless(source: b2.SourceSignals) -> System:
    notes, chart = monitors(forgotten, [source])
    return in_order(
        f"monitors_2_{source.region}_jitter_free",
        *notes,
        chart,
        text=f"As monitors_2_{source.region}_jitter, for a stamp of any age.",
        notes=[env.JITTER, FORGOTTEN, "The age of the stamp is free in every step (more runs)."],
        over=True,
        elapsed=env.step_ms,
    )


_received = replace(RX, phase=env.frame_lag)
frames_2_jitter = in_order(
    "frames_2_jitter",
    env.transmission(RX.update, env.frame_lag),
    *_aged(_received, exact_ms(env.step_ms)),
    text="The reception of Board 2 in steps of 19 to 21 ms, with every frame of a transmit task.",
    assume=all_of(*env.intact),
    notes=[env.JITTER, "The transmit task of Board 1 has a period of 19 to 21 ms too; no frame is lost."],
    elapsed=env.step_ms,
)

# --- the authorisation ----------------------------------------------------------------------------------

check_jitter = in_order(
    "check_board1_jitter",
    check_board1,
    text="The authorisation of Board 2 in steps of 19 to 21 ms, for any statuses and requests.",
    notes=[env.JITTER, "The statuses and the request are free in every step (more runs)."],
    over=True,
    elapsed=env.step_ms,
)

check_requests_jitter = in_order(
    "check_board1_requests_jitter",
    board2_env.masks_of_board1,
    process_masks,
    check_board1,
    text="The authorisation of Board 2 in steps of 19 to 21 ms, for any masks of Board 1.",
    assume=(b2.rx_status == "RX_OK") & (b2.b1_sup_status == "SUP_OK"),
    notes=[env.JITTER, "Both links of Board 1 are OK in every step."],
    under=True,
    elapsed=env.step_ms,
)

# --- obstacles ------------------------------------------------------------------------------------------

gone_1, come_2 = flag("gone1", "S1 has lost its obstacle"), flag("come2", "S2 has found an obstacle")
passing = Block("Passing", [
    assign(gone_1, d1 == 301),
    assign(come_2, d2 == 200),
], text="What the obstacle has done so far.")  # fmt: skip

obstacles_passing_jitter = in_order(
    "obstacles_passing_jitter",
    obstacles_n(),
    passing,
    text="The non-degraded obstacle chart in steps of 19 to 21 ms, an obstacle passing from S1 to S2.",
    assume=all_of(
        (d1 == 200) | (d1 == 301), (d2 == 200) | (d2 == 301), d3 == 301,
        implies(d2 == 200, d1 == 301), implies(gone_1, d1 == 301), implies(come_2, d2 == 200),
        ~prevDEG_B1,
    ),
    notes=[
        env.JITTER,
        "S1 measures 200 cm until it measures nothing any more; after that S2 measures nothing until it "
        "measures 200 cm for good; S3 measures nothing; prevDEG_B1 is false.",
        FREE_HEADING,
    ],
    under=True,
    elapsed=env.step_ms,
)  # fmt: skip


def _window() -> System:
    drawn = as_drawn()
    free = free_timers(
        replace(woven(drawn), elapsed=env.step_ms, notes=(env.JITTER, *drawn.notes)),
        (*TURNS, "timerSonar12"),
        name="obstacles_n_12_jitter",
        text="As obstacles_n_12, in steps of 19 to 21 ms.",
    )
    return replace(free, concrete="")


# --- the stop -------------------------------------------------------------------------------------------

deaf_jitter = in_order(
    "deaf_jitter",
    *_aged(RX, forgotten),
    check_board1,
    check_stop_2,
    Enabled(b2.autorized_to_send_command, *COMES_BEFORE, motion_2_with_free_error),
    text="Board 2 that hears no frame from power-up on, on turning wheels, in steps of 19 to 21 ms.",
    assume=all_of(
        ~RX.update,
        ~b2.b1_requests_switch, b2.b1_sup_status == "SUP_OK", ~b2.b1_emergency, ~b2.b2_emergency,
        *(speed > 2.5 for speed in b2.wheel_speed_rpm.values()),
        ay_norm == 1, bx_norm == 0, _lag(RX) == 0,
    ),
    notes=[
        env.JITTER,
        "No frame of Board 1 comes, its wheels turn as last reported, and no other fault is there; the stick "
        "is pushed forward.",
        FREE_BACKWARD,
    ],
    under=True,
    elapsed=env.step_ms,
)  # fmt: skip

SYSTEMS = SystemTable(
    *(
        (f"monitors_2_{source.region}_jitter{exact}", partial(make, source))
        for source in SOURCES
        for exact, make in (("_exact", _exact), ("", _monitor))
    ),
    _ageless(SUP),
    _ageless(RX),
    frames_2_jitter,
    check_jitter,
    check_requests_jitter,
    obstacles_passing_jitter,
    ("obstacles_n_12_jitter", _window),
    deaf_jitter,
)
