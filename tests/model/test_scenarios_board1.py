"""The scenarios that tell the interpretations of the Board 1 sentences apart, run on the charts as drawn.

A scenario is a list of blocks: how long (in ms) and what is given meanwhile.  Time 0 is its first
step; "at" names the step at that time.  Before it the rover runs nominally, long enough for ten
intervals of every record.  What is not given stays nominal.
"""

from collections.abc import Iterator, Mapping, Sequence

import pytest

from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import TICK_MS, System
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals.board1 import WHEELS

Given = Mapping[str, bool | float | str]
Block = tuple[int, Given]
Expected = tuple[int, str, str]
"""Instant in ms, signal, value as shown."""

SYSTEM = systems()
ALONE = {"temp_status": "temperature", "batt_status": "battery", "rx_status": "reception_exact"}
"""Statuses that the chart alone shows; all else runs on the whole board."""

NOMINAL: dict[str, bool | float | str] = {
    "temp_update": True, "temp_reading": 25, "batt_update": True, "batt_reading": 80,
    "rx_update": True, "heartbeat_update": True, "frame_isMotionConsistent": True,
    "frame_cmd": "CMD_NORMAL", "frame_y_norm": 1, "frame_x_norm": 0,
}  # fmt: skip
WARM_UP = 400

TEMP, BATT, RX, SUP = "temp_status", "batt_status", "rx_status", "b2_sup_status"
T_OK, T_DEG, T_CRIT = "TEMP_HEALTH_OK", "TEMP_HEALTH_DEGRADED", "TEMP_HEALTH_CRITICAL"
B_OK, B_DEG, B_CRIT = "BATT_HEALTH_OK", "BATT_HEALTH_DEGRADED", "BATT_HEALTH_CRITICAL"
W_OK, W_DEG, W_CRIT = "WHEEL_OK", "WHEEL_DEGRADED_ENCODER", "WHEEL_CRITICAL_MOTOR"
FL = "wheel_status_FL"
GIVE = "give_b2_actuation"
OK, DEG, CRIT = "SAFETY_OK", "SAFETY_DEGRADED", "SAFETY_CRITICAL"


def temp(celsius: float) -> Given:
    return {"temp_reading": celsius}


def batt(percent: float) -> Given:
    return {"batt_reading": percent}


NO_TEMP: Given = {"temp_update": False}
NO_BATT: Given = {"batt_update": False}
NO_LINK: Given = {"rx_update": False, "heartbeat_update": False}
NO_HEARTBEAT: Given = {"heartbeat_update": False}


def stale_temp(celsius: float, ms: int) -> list[Block]:
    """The last valid interpretation at 0, then none."""
    return [(TICK_MS, temp(celsius)), (ms, NO_TEMP)]


def stale_batt(percent: float, ms: int) -> list[Block]:
    return [(TICK_MS, batt(percent)), (ms, NO_BATT)]


def every(period: int, times: int) -> list[Block]:
    """Frames with new heartbeats at a constant period, silence before each."""
    return [block for _ in range(times) for block in ((period - TICK_MS, NO_LINK), (TICK_MS, {})) if block[0]]


def run(blocks: Sequence[Block], expected: Sequence[Expected], warm_up: int = WARM_UP) -> list[Expected]:
    """What the scenario shows at the instants and signals expected."""
    watched = {name for _, name, _ in expected}
    alone = ALONE.get(min(watched), "board1") if len(watched) == 1 else "board1"
    system = SYSTEM[alone]
    shown = list(steps(system, blocks, watched))[warm_up // TICK_MS :]
    return [(at, name, shown[at // TICK_MS][name]) for at, name, _ in expected]


def steps(system: System, blocks: Sequence[Block], watched: set[str]) -> Iterator[dict[str, str]]:
    """The watched signals after each step, as shown to people."""
    rover = Interpreter(system)
    for length, given in blocks:
        values = {**NOMINAL, **given}
        inputs = {n: v.domain.raw(values[n]) if n in values else v.init for n, v in system.inputs.items()}
        for _ in range(length // TICK_MS):
            rover.step(inputs)
            yield {n: system.written[n].domain.show(rover.data[n]) for n in watched}


HANDS_OFF: Given = {"frame_y_norm": 0}
BACKWARD_MODE: list[Block] = [
    block
    for button in ("frame_btn1", "frame_btn1", "frame_btn2", "frame_btn2")
    for block in ((TICK_MS, HANDS_OFF), (TICK_MS, {**HANDS_OFF, button: True}))
]
"""The four presses that switch backward mode on, 160 ms."""

SCENARIOS: dict[str, tuple[list[Block], list[Expected]]] = {
    "S01 degraded while the 4 s run": (
        [(3000, temp(66)), (1000, temp(25))],
        [(0, TEMP, T_DEG), (2000, TEMP, T_DEG), (3000, TEMP, T_OK)]),
    "S01 from degraded too": (
        [(1000, temp(57)), (3000, temp(66))], [(0, TEMP, T_DEG), (3000, TEMP, T_DEG)]),
    "S02 critical when 4.000 s have elapsed": (
        [(4020, temp(66)), (1000, temp(25))],
        [(3980, TEMP, T_DEG), (4000, TEMP, T_CRIT), (4020, TEMP, T_OK)]),
    "S03 both sides are one range": (
        [(2000, temp(-16)), (2500, temp(66))], [(3980, TEMP, T_DEG), (4000, TEMP, T_CRIT)]),
    "S04 an interruption starts the 4 s again": (
        [(3000, temp(66)), (20, temp(59)), (2000, temp(66))], [(4000, TEMP, T_DEG), (5000, TEMP, T_DEG)]),
    "S05 released at once": (
        [(4020, temp(66)), (20, temp(25))], [(4000, TEMP, T_CRIT), (4020, TEMP, T_OK)]),
    "S05 released at once to degraded": (
        [(4020, temp(66)), (20, temp(57))], [(4000, TEMP, T_CRIT), (4020, TEMP, T_DEG)]),
    "S06 the estimate counts above 65": (
        stale_temp(57, 9000), [(8000, TEMP, T_DEG), (8020, TEMP, T_CRIT)]),
    "S07 S08 S10 critical 0.5 s after 66": (
        stale_temp(66, 1000), [(480, TEMP, T_DEG), (500, TEMP, T_CRIT)]),
    "S07 S09 the rise counts from the last reading": (
        stale_temp(64, 2000), [(1000, TEMP, T_DEG), (1020, TEMP, T_CRIT)]),
    "S11 the ranges read the measured value": (
        stale_temp(54, 12000), [(1000, TEMP, T_OK), (11000, TEMP, T_OK), (11020, TEMP, T_CRIT)]),
    "S12 on the cold side too": (
        stale_temp(-16, 5000), [(3980, TEMP, T_DEG), (4000, TEMP, T_CRIT)]),
    "S13 no reading alone is no fault": (
        stale_temp(25, 12000), [(12000, TEMP, T_OK)]),
    "S14 an estimate of exactly 65.0 is not above": (
        stale_temp(60, 5500), [(3980, TEMP, T_DEG)]),
    "S15 the percentage, not the temperature": (
        [(6000, {**batt(10), **temp(25)})], [(4980, BATT, B_DEG), (5000, BATT, B_CRIT)]),
    "S15 a cold board with a full battery": ([(6000, temp(-4))], [(5980, BATT, B_OK)]),
    "S16 critical wins over degraded": ([(6000, batt(10))], [(5980, BATT, B_CRIT)]),
    "S17 24 % after 80 %": ([(100, batt(24))], [(0, BATT, B_OK), (80, BATT, B_OK)]),
    "S17 24 % after 15.1 %": (
        [(100, batt(15.1)), (100, batt(24))], [(0, BATT, B_DEG), (180, BATT, B_DEG)]),
    "S17 24 % after critical": (
        [(5020, batt(10)), (100, batt(24))], [(5000, BATT, B_CRIT), (5100, BATT, B_CRIT)]),
    "S17 both ends belong to the gap": (
        [(20, batt(22.9)), (20, batt(23)), (20, batt(25)), (20, batt(25.1))],
        [(20, BATT, B_DEG), (40, BATT, B_DEG), (60, BATT, B_OK)]),
    "S18 degraded without delay": (
        [(20, batt(22.9)), (20, batt(80))], [(0, BATT, B_DEG), (20, BATT, B_OK)]),
    "S19 15 % belongs to the range": ([(6000, batt(15))], [(5000, BATT, B_CRIT)]),
    "S21 critical when 5.000 s have elapsed": (
        [(5020, batt(10)), (20, batt(80))], [(4980, BATT, B_DEG), (5000, BATT, B_CRIT), (5020, BATT, B_OK)]),
    "S22 released at once": (
        [(5020, batt(10)), (20, batt(15.1)), (20, batt(25.1))], [(5020, BATT, B_DEG), (5040, BATT, B_OK)]),
    "S23 the estimate does not degrade": (
        [(100, batt(25.1)), *stale_batt(25.1, 9000)], [(9000, BATT, B_OK)]),
    "S24 critical 0.5 s after 15.1 %": (
        stale_batt(15.1, 1000), [(480, BATT, B_DEG), (500, BATT, B_CRIT)]),
    "S26 no reading alone is no fault": (stale_batt(80, 12000), [(12000, BATT, B_OK)]),
    "S27 inconsistent motion degrades every wheel": (
        [(20, {"frame_isMotionConsistent": False})],
        [(0, f"wheel_status_{wheel}", W_DEG) for wheel in WHEELS]),
    "S28 both causes in one step": (
        [(20, {"frame_isMotionConsistent": False, "hasNoFeedback_FL": True})], [(0, FL, W_CRIT)]),
    "S29 S30 critical, degraded, OK": (
        [(20, {"frame_isMotionConsistent": False, "hasNoFeedback_FL": True}),
         (20, {"hasNoFeedback_FL": True}), (20, {})],
        [(0, FL, W_CRIT), (20, FL, W_DEG), (40, FL, W_OK)]),
    "S31 the last received coherence counts on a dead link": (
        [(20, {"frame_isMotionConsistent": False}), (200, NO_LINK),
         (20, {**NO_LINK, "hasNoFeedback_FL": True})],
        [(220, FL, W_CRIT)]),
    "S32 a false flag means feedback": ([(20, {"hasNoFeedback_FL": False})], [(0, FL, W_OK)]),
    "S33 one wheel, one bit": ([(20, {"hasNoFeedback_FL": True})], [(0, "degraded_mask", "8")]),
    "S35 the open interval does not count": ([*every(40, 12), (100, NO_LINK)], [(560, RX, "RX_OK")]),
    "S36 S37 a mean of 40 is OK": (every(40, 12), [(460, RX, "RX_OK"), (460, SUP, "SUP_OK")]),
    "S37 a mean above 40 is degraded": (
        every(60, 12), [(700, RX, "RX_DEGRADED"), (700, SUP, "SUP_DEGRADED")]),
    "S37 an age of exactly 120 is not critical": (
        [(400, NO_LINK)], [(100, RX, "RX_OK"), (120, RX, "RX_CRITICAL"), (120, SUP, "SUP_CRITICAL")]),
    "S38 released by the first frame, into degraded": (
        [(280, NO_LINK), (400, {})],
        [(260, RX, "RX_CRITICAL"), (280, RX, "RX_DEGRADED"), (440, RX, "RX_DEGRADED"), (480, RX, "RX_OK")]),
    "S39 critical wins over a slow mean": (
        [*every(60, 12), (140, NO_LINK)], [(820, RX, "RX_DEGRADED"), (840, RX, "RX_CRITICAL")]),
    "S40 a heartbeat every 60 ms is slow": (
        [(40 if n % 2 == 0 else 20, NO_HEARTBEAT if n % 2 == 0 else {}) for n in range(24)],
        [(700, SUP, "SUP_DEGRADED"), (700, RX, "RX_OK")]),
    "S41 a dead link sets both bits": ([(140, NO_LINK)], [(120, "critical_mask", "132")]),
    "S43 a dead supervisor is enough": (
        [(140, NO_HEARTBEAT)], [(120, RX, "RX_OK"), (120, SUP, "SUP_CRITICAL"), (120, GIVE, "true")]),
    "S44 degraded reception does not hold the relay": (
        [(1000, NO_LINK), *every(60, 60)],
        [(1000, GIVE, "true"), (4000, RX, "RX_DEGRADED"), (4040, GIVE, "true"), (4060, GIVE, "false")]),
    "S45 back after 3.02 s": (
        [(1000, NO_LINK), (3100, {})], [(980, GIVE, "true"), (4000, GIVE, "true"), (4020, GIVE, "false")]),
    "S46 alternation keeps Board 2": (
        [(1000, NO_LINK), (1000, {}), (1000, NO_LINK), (1000, {})],
        [(1500, GIVE, "true"), (2500, GIVE, "true"), (3980, GIVE, "true")]),
    "S48 references are held": ([(400, NO_LINK)], [(380, "v_ref", "1"), (380, GIVE, "true")]),
    "S49 the safety state is not computed then": ([(400, NO_LINK)], [(380, "rover_safety_state", OK)]),
    "S50 only the links hand over": ([(4100, temp(66))], [(4080, TEMP, T_CRIT), (4080, GIVE, "false")]),
    "S51 S52 battery critical": (
        [(6000, batt(10))], [(5500, "critical_mask", "2"), (5500, "degraded_mask", "0")]),
    "S51 temperature critical": ([(4100, temp(66))], [(4080, "critical_mask", "1")]),
    "S55 bit 2 of Board 2 only degrades": (
        [(60, {"frame_crit_mask_b2": 4})], [(0, "rover_safety_state", DEG), (0, "v_ref", "0.5")]),
    "S54 S55 bit 1 of Board 2 stops": (
        [(60, {"frame_crit_mask_b2": 2})], [(0, "rover_safety_state", CRIT), (0, "v_ref", "0")]),
    "S56 critical before degraded from the safe state": (
        [(60, {"frame_crit_mask_b2": 2, "frame_degr_mask_b2": 1})],
        [(0, "rover_safety_state", CRIT), (40, "rover_safety_state", CRIT)]),
    "S56 from the degraded state the figure meets the safe state first": (
        [(60, {"frame_degr_mask_b2": 1}), (60, {"frame_crit_mask_b2": 2})],
        [(40, "rover_safety_state", DEG), (60, "rover_safety_state", OK), (80, "rover_safety_state", CRIT)]),
    "S57 scaled, not clipped": (
        [(60, {"frame_crit_mask_b2": 4, "frame_y_norm": 0.4})], [(40, "v_ref", "0.2")]),
    "S59 no reverse outside backward mode": ([(60, {"frame_y_norm": -0.4})], [(40, "v_ref", "0")]),
    "S59 reverse in backward mode": (
        [*BACKWARD_MODE, (60, {"frame_y_norm": -0.4})], [(200, "v_ref", "-0.4")]),
    "S60 dodging to the left": (
        [(60, {"frame_cmd": "CMD_GO_LEFT"})],
        [(40, "v_ref", "0.8"), (40, "omega_ref", "0.4"), (40, "current_action", "CMD_GO_LEFT")]),
    "S61 any critical state stops": ([(4100, temp(66))], [(4080, "actuate_emergency_stop", "true")]),
    "S62 latched while the wheels turn": (
        [(100, {"frame_cmd": "CMD_ESTOP", "wheel_speed_rpm_FL": 60}), (2000, {"wheel_speed_rpm_FL": 60}),
         (1200, {})],
        [(0, "actuate_emergency_stop", "true"), (2080, "actuate_emergency_stop", "true"),
         (3280, "actuate_emergency_stop", "false")]),
    "S63 only while moving forward": (
        [(60, {"frame_y_norm": 0}), (60, {"frame_y_norm": 0, "frame_cmd": "CMD_ESTOP"})],
        [(100, "actuate_emergency_stop", "false")]),
    "S64 positive is left": ([(60, {"frame_x_norm": 1})], [(40, "omega_ref", "1")]),
}  # fmt: skip


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_scenario(scenario: str) -> None:
    blocks, expected = SCENARIOS[scenario]
    assert run([(WARM_UP, {}), *blocks], expected) == expected


FIRST_STEP: dict[str, tuple[list[Block], list[Expected]]] = {
    "S65 classified in step 1": ([(20, temp(57))], [(0, TEMP, T_DEG)]),
    "S65 no battery reading yet": ([(20, NO_BATT)], [(0, BATT, B_DEG)]),
    "S34 not before ten intervals": (
        [(980, NO_LINK), (20, {}), (40, NO_LINK), (200, {})],
        [(1040, RX, "RX_OK"), (1220, RX, "RX_OK")]),
    "S66 power-up to the first frame is no interval": (
        [(880, NO_LINK), (400, {})], [(860, RX, "RX_CRITICAL"), (1060, RX, "RX_OK"), (1080, RX, "RX_OK")]),
    "S44 rx degraded from power-up": (every(60, 40), [(2380, RX, "RX_DEGRADED"), (2380, GIVE, "false")]),
}  # fmt: skip


@pytest.mark.parametrize("scenario", FIRST_STEP)
def test_scenario_from_power_up(scenario: str) -> None:
    blocks, expected = FIRST_STEP[scenario]
    assert run(blocks, expected, warm_up=0) == expected
