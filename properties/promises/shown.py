"""What each board shows the other: from the measured datum to the bit of the mask that is sent."""

from rovercheck.properties.document import battery, temperature
from rovercheck.properties.document.sources import BLE, IMU, RX, SUP, Source, silent_ms
from rovercheck.properties.forms import Property, always, costly, holds_after
from rovercheck.properties.promises.promise import Promise
from rovercheck.spec_model.lang.expr import Expr, all_of, implies
from rovercheck.spec_model.lang.time import sec, ticks
from rovercheck.spec_model.lang.words import bit, held, previous
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board1_fine import rx_age_ms


def _critical(index: int) -> Expr:
    return bit(b1.critical_mask, index)


def _degraded(index: int) -> Expr:
    return bit(b1.degraded_mask, index)


def _board_1(id: str, text: str, that: Expr, covers: list[str]) -> Property:
    return costly(always(
        f"P-SHOWN-{id}", text, that=that,
        covers=[*covers, "B1-MASK-01"], on="board1_ms", from_tick=2, interpretations=["S51"],
    ))  # fmt: skip


TEMPERATURE = _board_1(
    "TEMPERATURE",
    "Bit 0 of the critical mask exactly after 4 s in the critical range or for an estimate above 65, of the "
    "degraded mask in every other step with a fresh temperature out of ]-5;55[.",
    all_of(
        implies(held(temperature.critical_range, for_=4 * sec) | temperature.stale_above_65, _critical(0)),
        implies(
            ~temperature.ok_range
            & ~held(temperature.critical_range, for_=4 * sec)
            & ~temperature.stale_above_65,
            _degraded(0) & ~_critical(0),
        ),
        implies((b1.temp_age < 500) & temperature.ok_range, ~_critical(0) & ~_degraded(0)),
    ),
    ["B1-TEMP-06", "B1-MASK-02", "B1-MASK-03"],
)
BATTERY = _board_1(
    "BATTERY",
    "Bit 1 of the critical mask exactly after 5 s in the critical range or for an estimate below 15, of the "
    "degraded mask in every other step below 23 %.",
    all_of(
        implies(held(battery.critical_range, for_=5 * sec) | battery.stale_below_15, _critical(1)),
        implies(
            (b1.battery_pct < 23) & ~held(battery.critical_range, for_=5 * sec) & ~battery.stale_below_15,
            _degraded(1) & ~_critical(1),
        ),
        implies((b1.batt_age < 500) & (b1.battery_pct > 25), ~_critical(1) & ~_degraded(1)),
    ),
    ["B1-BATT-06", "B1-MASK-02", "B1-MASK-03"],
)
WHEELS = _board_1(
    "WHEELS",
    "Bits 3 to 6, FL, FR, RL, RR: critical exactly without feedback and consistence, degraded exactly "
    "without one of them.",
    all_of(
        *(
            (_critical(i) == (b1.has_no_feedback[wheel] & ~b1.is_motion_consistent))
            & (_degraded(i) == (b1.has_no_feedback[wheel] != ~b1.is_motion_consistent))
            for i, wheel in enumerate(("FL", "FR", "RL", "RR"), start=3)
        )
    ),
    ["B1-WHL-05", "B1-WHL-01", "B1-WHL-03", "B1-WHL-04"],
)
LINK = _board_1(
    "LINK",
    "Bit 2 of the critical mask exactly with a last frame, bit 7 with a last heartbeat over 120 ms old.",
    (_critical(2) == (rx_age_ms > 120)) & (_critical(7) == (b1.heartbeat_age > 120)),
    ["B1-RX-05", "B1-RX-03", "B1-SUP-03"],
)


def _silence(id: str, source: Source, index: int, what: str, steps: int) -> Property:
    return costly(holds_after(
        f"P-SHOWN-{id}",
        f"{what}, silent for over {source.limit} ms in {steps + 1} successive steps, is bit {index} of "
        "Board 2's critical mask in one of the last two.",
        premise=silent_ms(source), for_=steps * ticks, then=_critical_2(index),
        covers=["B2-FLT-01", "B2-FLT-02"], on="board2_ms", from_tick=2, interpretations=["E29", "E24"],
    ))  # fmt: skip


def _critical_2(index: int) -> Expr:
    return bit(b2.critical_mask, index) | previous(bit(b2.critical_mask, index))


SILENT_BLE = _silence("SILENT-BLE", BLE, 0, "The joystick link", 3)
SILENT_IMU = _silence("SILENT-IMU", IMU, 1, "The IMU", 3)
SILENT_RX = _silence("SILENT-RX", RX, 2, "The reception from Board 1", 3)
SILENT_SUP = _silence("SILENT-SUP", SUP, 3, "The supervisor of Board 1", 3)

SHOWN = Promise(
    "SHOWN",
    "What the boards show each other",
    "The bits of the two masks: temperature, battery, reception, four wheels, supervisor of Board 2; "
    "joystick link, IMU, reception, supervisor of Board 1.",
    "Tables 1 to 3, §2.2",
    "in the same step",
    "in the same step on Board 1; a silent source of Board 2 within four steps, but its bit may be lost for "
    "a step when silences of several regions end (PB2-20)",
    ("PB1-33b", "PB1-33c", "PB2-20a", "PB2-20b", "PB2-20c", "PB2-20d"),
    (TEMPERATURE, BATTERY, WHEELS, LINK, SILENT_BLE, SILENT_IMU, SILENT_RX, SILENT_SUP),
)
