"""What must be true of the sonar and joystick tasks of Board 2, and of stale sonar data [spec §1.3]."""

from rovercheck.properties.document.distances import NO_ECHO
from rovercheck.properties.forms import always, enters_only_if, reachable, responds
from rovercheck.spec_model.board2.acquisition import (
    axis_x,
    axis_y,
    both_edges,
    button1,
    button2,
    captured,
    complete,
    count,
    distance,
    flags,
    last_run,
    last_valid,
    notified,
    published,
    raw_btn1,
    raw_btn2,
    raw_x,
    raw_y,
    sonar_task,
    width,
)
from rovercheck.spec_model.board2.acquisition import (
    ticks as ble_now,
)
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of, const, implies, ite
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.lang.words import held, previous
from rovercheck.spec_model.signals.board2 import command, d1
from rovercheck.spec_model.signals.board2_supervisor import critical_mask, degraded_mask, sonar_age

JOYSTICK, SONAR, SILENT = "acquisition_joystick", "acquisition_sonar", "sonar_silence"

# --- joystick [spec §1.3.2, Fig 9] -------------------------------------------------------------------

PUBLISHED = (axis_x, axis_y, button1, button2)

PB2_24 = always(
    "PB2-24", "Axes and buttons change only in an execution with a complete read.",
    that=implies(any_of(*(datum != previous(datum) for datum in PUBLISHED)), complete),
    covers=["B2-BLE-02"], on=JOYSTICK, interpretations=["E28"],
)  # fmt: skip
PB2_24b = always(
    "PB2-24b", "An axis below a tenth of its range is 0, and none exceeds 1.",
    that=all_of(*((a == 0) | (a >= const(0.1)) | (a <= const(-0.1)) for a in (axis_x, axis_y))),
    covers=["B2-BLE-02"], on=JOYSTICK,
)  # fmt: skip
PB2_24c = always(
    "PB2-24c", "A complete read publishes the buttons as read, and each axis in the direction it was pushed.",
    that=implies(complete, all_of(
        button1 == raw_btn1, button2 == raw_btn2,
        *((a > 0) == (raw > 280) for a, raw in ((axis_x, raw_x), (axis_y, raw_y))),
        *((a < 0) == (raw < 230) for a, raw in ((axis_x, raw_x), (axis_y, raw_y))),
    )),
    covers=["B2-BLE-02"], on=JOYSTICK,
)  # fmt: skip
PB2_25a = always(
    "PB2-25a", "The last-valid instant changes only in an execution with a complete read.",
    that=implies(last_valid != previous(last_valid), complete & (last_valid == ble_now)),
    covers=["B2-BLE-03"], on=JOYSTICK,
)  # fmt: skip
PB2_25b = always(
    "PB2-25b", "After a complete read the last-valid instant is that of the execution.",
    that=implies(complete, last_valid == ble_now), covers=["B2-BLE-03"], on=JOYSTICK,
)  # fmt: skip
PB2_25c = always(
    "PB2-25c", "The last-run instant is that of the latest execution.",
    that=last_run == ble_now, covers=["B2-BLE-03"], on=JOYSTICK,
)  # fmt: skip
REACH_BLE_KEPT = reachable(
    "REACH-BLE-KEPT", "Data of an older read can be kept.",
    that=~complete & (last_valid != last_run) & (axis_y > 0), covers=["B2-BLE-02", "B2-BLE-03"], on=JOYSTICK,
)  # fmt: skip

# --- sonar [spec §1.3.1, Fig 8] ------------------------------------------------------------------------

scanning = sonar_task.active("Scanning")
triggered = scanning & ~previous(scanning)


def _number(conditions: tuple[Expr, ...]) -> Expr:
    total: Expr = const(0)
    for condition in conditions:
        total = total + ite(condition, const(1), const(0))
    return total


PB2_26a = always(
    "PB2-26a", "The count is the number of channels whose flag is set.",
    that=count == _number(flags), covers=["B2-SON-03"], on=SONAR,
)  # fmt: skip
PB2_26b = always(
    "PB2-26b", "A channel with both edges has its flag set, unless the next scan begins.",
    that=implies(~triggered, all_of(*(implies(e, f) for e, f in zip(both_edges, flags, strict=True)))),
    covers=["B2-SON-03"], on=SONAR,
)  # fmt: skip
PB2_26c = always(
    "PB2-26c", "A flag becomes set only when its channel has both edges, and is cleared by a trigger only.",
    that=implies(~triggered, all_of(*(
        f == (previous(f) | e) for e, f in zip(both_edges, flags, strict=True)
    ))),
    covers=["B2-SON-03"], on=SONAR,
)  # fmt: skip
PB2_26d = always(
    "PB2-26d", "Each channel that completes for the first time since the trigger adds one to the count.",
    that=implies(~triggered, count == previous(count) + _number(tuple(
        e & ~previous(f) for e, f in zip(both_edges, flags, strict=True)
    ))),
    covers=["B2-SON-03"], on=SONAR,
)  # fmt: skip
PB2_26e = always(
    "PB2-26e", "A channel that completes first since the trigger captures the length of its pulse.",
    that=all_of(*(
        implies(e & ~previous(f), pulse == length)
        for e, f, pulse, length in zip(both_edges, flags, captured, width, strict=True)
    )),
    covers=["B2-SON-03"], on=SONAR,
)  # fmt: skip
PB2_27a = always(
    "PB2-27a", "The task is notified in the callback that makes the count 3.",
    that=implies((count == 3) & (previous(count) < 3), notified), covers=["B2-SON-04"], on=SONAR,
)  # fmt: skip
PB2_27b = always(
    "PB2-27b", "A scan with fewer than three complete channels is not notified.",
    that=implies(~triggered & (count < 3), ~notified), covers=["B2-SON-04"], on=SONAR,
)  # fmt: skip
PB2_27c = responds(
    "PB2-27c", "The snapshot is published at most 20 ms after the trigger.",
    trigger=triggered, response=published, within=20 * ms,
    covers=["B2-SON-04"], on=SONAR, interpretations=["E13"],
)  # fmt: skip
PB2_27d = always(
    "PB2-27d", "A scan that is over before 20 ms was notified; its snapshot is published in that instant.",
    that=implies(
        previous(scanning) & ~scanning, published & (notified | held(previous(scanning), for_=19 * ms))
    ),
    covers=["B2-SON-04"], on=SONAR, interpretations=["E13"],
)  # fmt: skip
PB2_27e = always(
    "PB2-27e", "A channel without an echo is published as 301 cm.",
    that=implies(published, all_of(*(
        implies(~f, d == NO_ECHO) for f, d in zip(flags, distance, strict=True)
    ))),
    covers=["B2-SON-04"], on=SONAR, interpretations=["E13"],
)  # fmt: skip
PB2_27f = enters_only_if(
    "PB2-27f", "From one trigger to the next 60 ms pass.",
    entering=triggered, only_if=held(~previous(triggered), for_=58 * ms),
    covers=["B2-SON-04"], on=SONAR, from_tick=3,
)  # fmt: skip
PB2_27g = always(
    "PB2-27g", "A pulse of 58 µs for each cm of 70, 71 or 300 cm is published as that distance.",
    that=implies(published, all_of(*(
        implies(f & (pulse == microseconds), d == centimetres)
        for f, pulse, d in zip(flags, captured, distance, strict=True)
        for microseconds, centimetres in ((4060, 70), (4118, 71), (17400, 300))
    ))),
    covers=["B2-SON-04"], on=SONAR, interpretations=["E13"],
)  # fmt: skip
REACH_SONAR_NOTIFIED = reachable(
    "REACH-SONAR-NOTIFIED", "A scan can end by its notification with three near obstacles.",
    that=published & notified & all_of(*(d == 70 for d in distance)), covers=["B2-SON-04"], on=SONAR,
)  # fmt: skip
REACH_SONAR_TIMEOUT = reachable(
    "REACH-SONAR-TIMEOUT", "A scan can end after 20 ms with a channel missing.",
    that=published & ~notified & (count == 2), covers=["B2-SON-04"], on=SONAR, interpretations=["E13"],
)  # fmt: skip
REACH_SONAR_LATE = reachable(
    "REACH-SONAR-LATE", "The third echo can come after the scan is over; its notification is lost.",
    that=notified & ~scanning & ~published, covers=["B2-SON-03", "B2-SON-04"], on=SONAR,
)  # fmt: skip

# --- stale sonar data ----------------------------------------------------------------------------------

fault_or_stop = (critical_mask != 0) | (degraded_mask != 0) | (command == "CMD_ESTOP")

PB2_22a = always(
    "PB2-22a", "Sonar data 300 ms old set a fault bit or command a stop.",
    that=implies(sonar_age >= 300, fault_or_stop),
    covers=["B2-GEN-03", "B2-OBS-01"], on=SILENT, from_tick=2, interpretations=["E13"],
)  # fmt: skip
PB2_22b = always(
    "PB2-22b", "A sensor without an echo for 300 ms sets a fault bit or commands a stop.",
    that=implies(held(d1 == NO_ECHO, for_=300 * ms), fault_or_stop),
    covers=["B2-GEN-03", "B2-OBS-01"], on="sonar_without_echo", from_tick=2, interpretations=["E13"],
)  # fmt: skip
REACH_SONAR_STALE = reachable(
    "REACH-SONAR-STALE", "Sonar data can be 300 ms old while Board 2 commands a stop.",
    that=(sonar_age >= 300) & (command == "CMD_ESTOP"), covers=["B2-GEN-03"], on=SILENT,
)  # fmt: skip
