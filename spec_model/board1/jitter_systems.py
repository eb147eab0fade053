"""Board 1 where its steps last 19 to 21 ms: links, relay, what is held for seconds, the stop."""

from rovercheck.spec_model.board1.battery import monitor_battery
from rovercheck.spec_model.board1.fine_systems import ALIKE_INTERVALS
from rovercheck.spec_model.board1.heartbeat import heartbeat_monitor
from rovercheck.spec_model.board1.reception import reception_monitor
from rovercheck.spec_model.board1.relay import relay
from rovercheck.spec_model.board1.systems import FEW_VALUES, FREE_STATUSES, references_executed
from rovercheck.spec_model.board1.temperature import monitor_temperature
from rovercheck.spec_model.environment import jitter as env
from rovercheck.spec_model.environment.board1 import battery_readings, check_stop, temperature_readings
from rovercheck.spec_model.lang.expr import all_of, implies
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board1_fine as fine
from rovercheck.spec_model.system_table import SystemTable

reception = reception_monitor(fine.rx_age_ms)
heartbeat = heartbeat_monitor(fine.heartbeat_age_ms)

reception_jitter = in_order(
    "reception_jitter",
    env.reception_clock,
    env.reception_any_mean,
    reception,
    text="Reception monitor in steps of 19 to 21 ms, with frames that arrive at any ms.",
    assume=env.earlier_than_the_step,
    notes=[env.JITTER, "Several frames between two steps are one with the latest stamp.", ALIKE_INTERVALS],
    over=True,
    elapsed=env.step_ms,
)

SENT = "The transmit task of Board 2 has a period of 19 to 21 ms too; its first frame is 1 ms after power-up."
frames_jitter_exact = in_order(
    "frames_jitter_exact",
    env.transmission(b1.rx_update, env.frame_lag),
    env.sent_clock,
    env.sent_record,
    reception,
    text="Reception monitor in steps of 19 to 21 ms, with the frames of a transmit task, any of them lost.",
    notes=[env.JITTER, SENT],
    elapsed=env.step_ms,
)
frames_jitter = in_order(
    "frames_jitter",
    env.transmission(b1.rx_update, env.frame_lag),
    env.sent_clock,
    reception,
    text="As frames_jitter_exact, the mean of ten intervals left open.",
    notes=[env.JITTER, SENT, "Whether the mean exceeds 40 ms is free in every step (more runs)."],
    over=True,
    concrete="frames_jitter_exact",
    elapsed=env.step_ms,
)

relay_jitter = in_order(
    "relay_jitter",
    relay,
    text="The relay decision in steps of 19 to 21 ms, for any statuses of reception and supervisor.",
    notes=[env.JITTER, FREE_STATUSES],
    over=True,
    elapsed=env.step_ms,
)

relay_silence_jitter = in_order(
    "relay_silence_jitter",
    env.frames_clock,
    env.heartbeats_clock,
    env.frames_mean,
    env.heartbeats_mean,
    heartbeat,
    reception,
    relay,
    text="The relay behind the two link monitors, in steps of 19 to 21 ms, after a silence from power-up on.",
    assume=implies(env.at_a_step.updates >= 1, b1.rx_update),
    notes=[
        env.JITTER,
        env.STAMPED,
        "From the first frame on one comes in every step, each with a new heartbeat.",
    ],
    under=True,
    elapsed=env.step_ms,
)

ALWAYS_READ = "A valid reading comes in every step."
temperature_jitter = in_order(
    "temperature_jitter",
    temperature_readings,
    monitor_temperature,
    text="Temperature monitor in steps of 19 to 21 ms.",
    assume=b1.temp_update,
    notes=[env.JITTER, env.STAMPED, ALWAYS_READ, FEW_VALUES],
    under=True,
    elapsed=env.step_ms,
)

battery_jitter = in_order(
    "battery_jitter",
    battery_readings,
    monitor_battery,
    text="Battery monitor in steps of 19 to 21 ms.",
    assume=b1.batt_update,
    notes=[env.JITTER, env.STAMPED, ALWAYS_READ, FEW_VALUES],
    under=True,
    elapsed=env.step_ms,
)

references_jitter = in_order(
    "references_jitter",
    *references_executed.components,
    text="As references_executed, in steps of 19 to 21 ms.",
    notes=[env.JITTER, *references_executed.notes],
    elapsed=env.step_ms,
)

COMMANDED = "No cause is critical or degraded; the stick is pushed forward."
stop_jitter = in_order(
    "stop_jitter",
    check_stop,
    *references_executed.components,
    text="A commanded stop of Board 1, in steps of 19 to 21 ms.",
    assume=all_of(
        *(~cause for cause in (b1.b1_critical, b1.b1_degraded, b1.b2_critical, b1.b2_degraded)),
        b1.y_norm == 1,
        b1.x_norm == 0,
    ),
    notes=[env.JITTER, *references_executed.notes, COMMANDED],
    under=True,
    elapsed=env.step_ms,
)

SYSTEMS = SystemTable(
    reception_jitter,
    frames_jitter_exact,
    frames_jitter,
    relay_jitter,
    relay_silence_jitter,
    temperature_jitter,
    battery_jitter,
    references_jitter,
    stop_jitter,
)
