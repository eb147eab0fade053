"""The scenarios that tell the interpretations of Board 2 apart (E01 to E32), for every choice of each.

A case lists what is given in blocks of ms, and what a choice shows: the values of a signal from time 0
on, each with the ms at which it begins.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import pytest

from rovercheck.properties.catalogue import under
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.ambiguity import ambiguities, fixed
from rovercheck.spec_model.board2.heading import headings, measured
from rovercheck.spec_model.board2.obstacles import obstacles_n
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TICK_MS, System, in_order
from rovercheck.spec_model.rover import as_written, systems
from tests.interpretations.scenario import BOARD1, WARM_UP, Blocks, Given, histories, shown

NOMINAL: Given = {
    **BOARD1, "Board1.powered": True, "B1-B2.arrives": "newest", "B2-B1.arrives": "newest",
    "d1": 301, "d2": 301, "d3": 301, "echo1": 301, "echo2": 301, "echo3": 301, "ay_norm": 1,
    "new_d1": 301, "new_d2": 301, "new_d3": 301, "new_ay_norm": 1, "sonar_update": True,
    "b1_sup_update": True, "B2.rx_update": True, "esp_update": True, "imu_update": True,
    "ble_complete": True, "raw_x": 255, "raw_y": 510, "autorized_to_send_command": True,
}  # fmt: skip
"""Nothing in the way, the stick forward, every source delivering: of this a system takes its own inputs."""

NEAR, GAP, SEEN = 70, 71, 200
"""One of the distances of the model for 60, 85 and 200 cm."""

FIVE_DEGREES = in_order("five degrees", obstacles_n(measured(*headings(5))))
"""The chart with its heading, on the grid that shows a turn of 40 degrees."""


@dataclass(frozen=True)
class Scenario:
    """A scenario of an interpretation, and what each of its choices shows."""

    interpretation: str
    number: int
    given: Blocks
    watched: str
    shows: Mapping[str, str]
    on: str = "obstacles_n"
    warm_up: int = 0


def S1(cm: int) -> Given:
    return {"d1": cm}


def S2(cm: int) -> Given:
    return {"d2": cm}


def both(first: int, second: int) -> Given:
    return {"d1": first, "d2": second}


LEFT_THEN_CENTRE: Blocks = [(200, both(SEEN, SEEN))]
"""S2 sees the object before S1 loses it: one step after this, pair 12 sends its signal."""


def turning(*yaws: int) -> Blocks:
    """A deviation to the left during which the heading takes these values, the last one for long."""
    steps = [(100, {**S2(SEEN), "yaw": yaw % 360}) for yaw in yaws]
    return [*LEFT_THEN_CENTRE, *steps, (2000, {**S2(SEEN), "yaw": yaws[-1] % 360})]


def seen_at(yaw: int) -> Blocks:
    """S1 sees the object while yaw has this value and loses it at 0; S2 sees it at 20 degrees."""
    return [(200, {**S1(SEEN), "yaw": yaw}), (200, {}), (100, {"yaw": 20}), (100, {**S2(SEEN), "yaw": 20})]


BESIDE_70: Blocks = [(200, {**S1(SEEN), "d3": NEAR}), (200, {"d3": NEAR}), (200, {**S2(SEEN), "d3": NEAR})]
CENTRE_THEN_TURNING: Blocks = [
    (200, S2(SEEN)), *((200, {**S1(SEEN), "yaw": yaw}) for yaw in (0, 30, 40, 45, 90)),
]  # fmt: skip
IMU_SLOW: Blocks = [
    block for _ in range(4)
    for block in ((100, {"imu_update": False, "new_d2": SEEN}), (20, {"new_d2": SEEN}))
]  # fmt: skip
TURNING_WHEELS: Given = {f"new_B2.wheel_speed_rpm_{wheel}": 60 for wheel in ("FL", "FR", "RL", "RR")}
RX = "B2.rx_status"
DEC, B2DEC = "B2Decision", "B2Dec"
CRITICAL, AUTHORISED = "B2.critical_mask", "autorized_to_send_command"
CUT: Blocks = [(400, {"B1-B2.arrives": "nothing"})]

# fmt: off
SCENARIOS: list[Scenario] = [
    *(Scenario("E01", n, [(1000, S1(gap)), (100, {}), (1000, S2(gap))], DEC, {
        "GAP-NONE": "0", "GAP-STOP": "0 20 1 1020 0 1120 1", "GAP-MOVING": "0 1120 2"})
      for n, gap in ((1, GAP), (2, 100))),
    Scenario("E02", 1, BESIDE_70, DEC, {
        "B70-STOP": "0 20 1", "B70-BOTH": "0 20 1", "B70-LT": "0 420 2"}),
    Scenario("E02", 2, BESIDE_70, "obj2Detected", {
        "B70-STOP": "false", "B70-BOTH": "false 420 true", "B70-LT": "false 420 true"}),
    Scenario("E03", 1, [(500, S1(300)), (500, S2(SEEN))], DEC, {
        "OPEN": "0", "CLOSED": "0 520 2", "HALF": "0 520 2", "UNBOUNDED": "0"}),
    Scenario("E03", 2, [(500, S1(100)), (100, {}), (500, S2(SEEN))], DEC, {
        "OPEN": "0", "CLOSED": "0 620 2", "HALF": "0", "UNBOUNDED": "0"}),
    Scenario("E04", 1, [(200, {}), (200, S2(NEAR))], B2DEC, {
        "INDEX5-MAPPED": "0 220 1", "INDEX5-RAW": "0 220 1", "ENUM8": "0 220 7"}, "obstacles"),
    Scenario("E04", 2, [(200, {}), (200, S2(NEAR))], "command", {
        "INDEX5-MAPPED": "CMD_NORMAL 220 CMD_ESTOP", "INDEX5-RAW": "CMD_NORMAL 220 CMD_ROTATE_180",
        "ENUM8": "CMD_NORMAL 220 CMD_ESTOP"}, "obstacles"),
    Scenario("E05", 1, [(200, S2(SEEN)), (1000, S1(SEEN))], B2DEC, {
        "CENTRE-STRAIGHT": "0 220 3 720 0", "CENTRE-HOLD": "0 220 3 720 0", "LITERAL-45": "0",
        "OPPOSITE": "0 220 4"}, "obstacles"),
    Scenario("E05", 2, [(200, S2(SEEN)), (1000, S1(SEEN))], "command", {
        "CENTRE-STRAIGHT": "CMD_NORMAL", "CENTRE-HOLD": "CMD_NORMAL 220 CMD_AVOID_LEFT 720 CMD_NORMAL",
        "LITERAL-45": "CMD_NORMAL", "OPPOSITE": "CMD_NORMAL 220 CMD_GO_RIGHT"}, "obstacles"),
    Scenario("E05", 3, CENTRE_THEN_TURNING, DEC, {
        "CENTRE-STRAIGHT": "0 220 3 720 0", "CENTRE-HOLD": "0 220 3 720 0", "LITERAL-45": "0",
        "OPPOSITE": "0 220 4 800 0"}, "five degrees"),
    Scenario("E06", 1, turning(0, -15, -30, -40), DEC, {
        "EXACT": "0 220 2", "TOL-12": "0 220 2 500 0", "PASS": "0 220 2"}, "five degrees"),
    Scenario("E06", 2, turning(*range(0, 141, 20)), DEC, {
        "EXACT": "0 220 2 900 0", "TOL-12": "0 220 2", "PASS": "0 220 2"}, "five degrees"),
    Scenario("E06", 3, turning(0, -15, -30, -45), DEC, {
        "EXACT": "0 220 2 500 0", "TOL-12": "0 220 2 500 0", "PASS": "0 220 2 500 0"}, "five degrees"),
    Scenario("E07", 1, seen_at(0), "targetAngle", {
        "AT-DECISION": "0 520 335", "AT-FALL": "0 520 315", "AT-FIRST-DETECTION": "0 520 315"},
        "five degrees"),
    Scenario("E07", 2, seen_at(340), "targetAngle", {
        "AT-DECISION": "0 520 335", "AT-FALL": "0 520 315", "AT-FIRST-DETECTION": "0 520 295"},
        "five degrees"),
    Scenario("E08", 1, [*LEFT_THEN_CENTRE, (20_000, S2(SEEN))], DEC, {
        "NO-TIMEOUT": "0 220 2", "BOUNDED": "0 220 2 10220 0"}),
    Scenario("E09", 1, [(200, {}), (200, {**S2(SEEN), "deg_mask_b1": True})], B2DEC, {
        "SEL-B1FLAG": "0 200 6", "SEL-ACTUATOR": "0", "SEL-SAFETY": "0 200 6", "SEL-MASK": "0"}, "obstacles"),
    Scenario("E09", 2, [(200, {}), (200, {**S2(SEEN), "own_deg_mask": True})], B2DEC, {
        "SEL-B1FLAG": "0", "SEL-ACTUATOR": "0", "SEL-SAFETY": "0 200 6", "SEL-MASK": "0 200 6"}, "obstacles"),
    Scenario("E09", 3, [(200, {"new_d2": SEEN, "new_B2.degr_mask_b1": 2})], B2DEC, {
        "SEL-B1FLAG": "6", "SEL-ACTUATOR": "0", "SEL-SAFETY": "6", "SEL-MASK": "0"}, "board2", WARM_UP),
    Scenario("E09", 4, IMU_SLOW, B2DEC, {
        "SEL-B1FLAG": "0", "SEL-ACTUATOR": "0", "SEL-SAFETY": "0 140 6", "SEL-MASK": "0 140 6"}, "board2"),
    Scenario("E10", 1, [(200, {}), (200, S2(NEAR)), (400, {}), (200, {"ay_norm": 0})], DEC, {
        "AUTO": "0 220 1 420 0", "LATCH-NEUTRAL": "0 220 1 800 0", "LATCH-STANDSTILL": "0 220 1"}),
    Scenario("E10", 2, [(200, {}), (200, S2(NEAR)), (400, {}), (200, {"B2.wheels_below_2_5": True})], DEC, {
        "AUTO": "0 220 1 420 0", "LATCH-NEUTRAL": "0 220 1", "LATCH-STANDSTILL": "0 220 1 800 0"}),
    Scenario("E10", 3, [(200, TURNING_WHEELS), (200, {**TURNING_WHEELS, "new_d2": NEAR}),
        (400, TURNING_WHEELS), (200, {})], B2DEC, {
        "AUTO": "0 220 1 420 0", "LATCH-NEUTRAL": "0 220 1", "LATCH-STANDSTILL": "0 220 1 800 0"},
        "board2", WARM_UP),
    Scenario("E13", 1, [(120, {}), (120, {"echo2": NEAR}), (1000, {"echo2": 301, "missing2": True})], DEC, {
        "FAR": "0 160 1 280 0", "HOLD": "0 160 1", "NEAR": "0 160 1", "FAULT": "0 160 1 280 0"},
        "obstacles_scan"),
    Scenario("E13", 2, [(120, {}), (1000, {"echo2": 301, "missing2": True})], DEC, {
        "FAR": "0", "HOLD": "0", "NEAR": "0 160 1", "FAULT": "0"}, "obstacles_scan"),
    Scenario("E13", 3, [(120, {}), (1000, {"echo2": 301, "missing2": True})], "sonar_fault", {
        "FAULT": "false 140 true"}, "obstacles_scan"),
    Scenario("E14", 1, [(200, S1(SEEN)), (3000, {}), (100, S2(SEEN))], DEC, {
        "EXCL": "0", "INCL": "0 3220 2"}),
    Scenario("E14", 2, [(200, S1(SEEN)), (3020, {}), (100, S2(SEEN))], DEC, {"EXCL": "0", "INCL": "0"}),
    Scenario("E15", 1, [*LEFT_THEN_CENTRE, (200, S2(SEEN))], DEC, {"LEVEL": "0 220 2", "EDGE": "0"}),
    Scenario("E15", 2, [(200, S1(SEEN)), (200, {}), (200, S2(SEEN))], DEC, {
        "LEVEL": "0 420 2", "EDGE": "0 420 2"}),
    Scenario("E16", 1, [(200, S1(SEEN)), (2400, {}), (200, S1(SEEN)), (1400, {}), (200, S2(SEEN))], DEC, {
        "NO-RESTART": "0", "RESTART": "0 4220 2"}),
    Scenario("E17", 1, [*LEFT_THEN_CENTRE, (200, both(GAP, SEEN))], DEC, {
        "ANY-EXIT": "0 220 2", "LATERAL-ONLY": "0"}),
    Scenario("E17", 2, [*LEFT_THEN_CENTRE, (200, both(301, SEEN))], DEC, {
        "ANY-EXIT": "0 220 2", "LATERAL-ONLY": "0 220 2"}),
    Scenario("E18", 1, [(200, S1(SEEN)), (200, S1(NEAR)), (400, {}), (100, S2(SEEN))], DEC, {
        "FREEZE": "0 220 1 420 0 820 2", "RESET": "0 220 1 420 0", "CONTINUE": "0 220 1 420 0 820 2"}),
    Scenario("E18", 2, [(200, S1(SEEN)), (200, S1(NEAR)), (2900, {}), (100, S2(SEEN))], DEC, {
        "FREEZE": "0 220 1 420 0 3320 2", "RESET": "0 220 1 420 0", "CONTINUE": "0 220 1 420 0"}),
    Scenario("E19", 1, [*LEFT_THEN_CENTRE, (200, {**S2(SEEN), "d3": SEEN}), (200, S2(SEEN)),
        (20, {**S2(SEEN), "turned_45": True}), (200, S2(SEEN))], DEC, {
        "IGNORE": "0 220 2 600 0", "PREEMPT": "0 220 2 420 4 600 0", "QUEUE": "0 220 2 600 0 620 4"}),
    Scenario("E20", 1, [(200, {**both(SEEN, SEEN), "d3": SEEN}), (200, S2(SEEN))], DEC, {
        "LEFT-FIRST": "0 220 2", "RIGHT-FIRST": "0 220 4", "STOP": "0 220 1"}),
    Scenario("E20", 2, [(200, {**both(SEEN, SEEN), "d3": SEEN}), (200, S2(SEEN)), (200, {})], DEC, {
        "LEFT-FIRST": "0 220 2", "RIGHT-FIRST": "0 220 4", "STOP": "0 220 1 420 0"}),
    Scenario("E21", 1, [(200, {}), (1000, {"b1_sup_status": "SUP_CRITICAL"}), (4000, {})], AUTHORISED, {
        "AS-S43-S45": "false 200 true 4220 false"}, "check_board1"),
    Scenario("S43", 1, [(200, {}), (1000, {"b1_sup_status": "SUP_CRITICAL"}), (4000, {})], AUTHORISED, {
        "OR": "false 200 true 4220 false", "AND": "false"}, "check_board1"),
    Scenario("S44", 1, [(200, {RX: "RX_DEGRADED"})], AUTHORISED, {
        "NOT-CRIT": "false", "STRICT-OK-KEPT": "false", "STRICT-OK-1": "false 20 true"}, "check_board1"),
    Scenario("S44", 2, [(200, {}), (200, {RX: "RX_CRITICAL"}), (4000, {RX: "RX_DEGRADED"})], AUTHORISED, {
        "NOT-CRIT": "false 200 true 3420 false", "STRICT-OK-KEPT": "false 200 true",
        "STRICT-OK-1": "false 200 true"}, "check_board1"),
    Scenario("S45", 1, [(200, {}), (1000, {RX: "RX_CRITICAL"}), (4000, {})], AUTHORISED, {
        "IMMEDIATE": "false 200 true 1200 false", "3-S": "false 200 true 4220 false"}, "check_board1"),
    Scenario("E22", 1, CUT, AUTHORISED, {
        "B1-ONLY": "false", "B2-ONLY": "false 120 true", "RELAY-AND-FLAG": "false 120 true"},
        "rover_failing", WARM_UP),
    Scenario("E22", 2, CUT, "motors.followed", {
        "B1-ONLY": "Board1", "B2-ONLY": "Board1 140 Board2", "RELAY-AND-FLAG": "Board1"},
        "rover_failing", WARM_UP),
    Scenario("E22", 3, CUT, "give_b2_actuation", {
        "B1-ONLY": "false", "B2-ONLY": "false", "RELAY-AND-FLAG": "false"}, "rover_failing", WARM_UP),
    Scenario("E23", 1, [(200, {"B2.crit_mask_b1": 1})], CRITICAL, {
        "COPY-ERROR": "0", "REMOTE": "8"}, "masks_2"),
    Scenario("E24", 1, [(200, {"imu_status": "CRITICAL"})], CRITICAL, {
        "B2BITS": "2", "SAME-AS-B1": "0"}, "masks_2"),
    Scenario("E24", 2, [(200, {RX: "RX_CRITICAL"})], CRITICAL, {
        "B2BITS": "4", "SAME-AS-B1": "4"}, "masks_2"),
    Scenario("E25", 1, [(200, {})], "v_ref_actuation", {"NORMALISED": "0 20 0.5"}, "references_2_drawn"),
    Scenario("E26", 1, [(40, {}), (80, {"esp_update": False}), (400, {})], "esp_status", {
        "FILL": "OK 140 DEGRADED", "WAIT-10": "OK"}, "monitors_2"),
    Scenario("E28", 1, [(200, {}), (200, {"ble_complete": False})], "ble_y", {
        "HOLD": "1", "NEUTRAL": "1 200 0"}, "acquisition_joystick"),
    Scenario("E28", 2, [(200, {}), (200, {"esp_update": False})], "ay_norm", {
        "HOLD": "1", "NEUTRAL": "1 200 0"}, "board2", WARM_UP),
    *(Scenario("E29", n, [(140, {update: False}), (2000, {})], status, {
        "INSTANT": f"{ok} 120 {crit} 140 {ok}", "HYST": f"{ok} 120 {crit} 1140 {ok}"}, "monitors_2", WARM_UP)
      for n, update, status, ok, crit in (
        (1, "esp_update", "esp_status", "OK", "CRITICAL"),
        (2, "B2.rx_update", "B2.rx_status", "RX_OK", "RX_CRITICAL"))),
    Scenario("E30", 1, [(200, {"esp_status": "CRITICAL"})], CRITICAL, {"AS-S51": "1"}, "masks_2"),
    Scenario("E27", 1, [(200, S1(SEEN)), (60, {**S1(SEEN), "d3": NEAR}), (140, {"d3": NEAR}), (2900, {}),
        (200, S2(SEEN))], DEC, {
        "ANY": "0 220 1 420 0 3320 2", "PAIR": "0 220 1 420 0"}),
    Scenario("E31", 1, [(200, S2(SEEN)), (1000, S1(SEEN))], "command", {
        "NORMAL": "CMD_NORMAL", "AVOID-BY-PAIR": "CMD_NORMAL 220 CMD_AVOID_LEFT 720 CMD_NORMAL",
        "ZERO-TURN": "CMD_NORMAL"}, "obstacles"),
    Scenario("E31", 2, [(200, S2(SEEN)), (1000, {"d3": SEEN})], "command", {
        "NORMAL": "CMD_NORMAL", "AVOID-BY-PAIR": "CMD_NORMAL 220 CMD_AVOID_RIGHT 720 CMD_NORMAL",
        "ZERO-TURN": "CMD_NORMAL"}, "obstacles"),
    Scenario("E31", 3, [(200, {"new_d2": SEEN, "new_bx_norm": 1}), (800, {"new_d1": SEEN, "new_bx_norm": 1})],
        "x_norm", {"NORMAL": "0 20 1", "AVOID-BY-PAIR": "0 20 1", "ZERO-TURN": "0 20 1 240 0 740 1"},
        "rover", WARM_UP),
    Scenario("E32", 1, [(100, {}), (1000, {**S2(NEAR), "deg_mask_b1": True}), (100, S2(NEAR))], B2DEC, {
        "RUN-ALWAYS": "0 100 6 1100 1", "FREEZE": "0 100 5 120 6 1100 0 1120 1"}, "obstacles"),
]
# fmt: on

CASES = [(scenario, choice) for scenario in SCENARIOS for choice in scenario.shows]


@pytest.mark.parametrize(
    ("scenario", "choice"), CASES, ids=[f"{s.interpretation}-{choice}-{s.number}" for s, choice in CASES]
)
def test_a_choice_shows_what_tells_it_apart(scenario: Scenario, choice: str) -> None:
    system = _system(scenario.on, scenario.interpretation, choice)
    found = histories(system, scenario.given, [scenario.watched], nominal=NOMINAL, warm_up=scenario.warm_up)
    assert found == [scenario.shows[choice]]


@cache
def _written() -> dict[str, System]:
    return {system.name: system for system in (*as_written(), woven(FIVE_DEGREES))}


@cache
def _system(name: str, interpretation: str, choice: str) -> System:
    """A system under a choice, made without all the others."""
    return fixed({interpretation: choice}).system(_written()[name])


@pytest.mark.parametrize(("choice", "sent"), [("B70-STOP", False), ("B70-BOTH", True), ("B70-LT", True)])
def test_E02_whether_a_moving_object_is_signalled_beside_one_at_70(choice: str, sent: bool) -> None:
    system = _system("obstacles_n", "E02", choice)
    rover, labels = Interpreter(system), []
    for cm1, cm2 in [(SEEN, 301)] * 10 + [(301, 301)] * 10 + [(301, SEEN)] * 5:
        given = {**NOMINAL, "d1": cm1, "d2": cm2, "d3": NEAR}
        inputs = {n: v.domain.raw(given.get(n, 0)) for n, v in system.inputs.items()}
        labels += [fired.label for fired in rover.step(inputs)]
    assert any("send(moveToS1, B2Decisions)" in label for label in labels) is sent


# --- interpretations that change what a requirement asks, not the model (E11, E12) -------------------------


def broken(property_id: str, interpretation: str, choice: str, given: Blocks) -> bool:
    """Whether a run of the property's system breaks the property."""
    wanted = under({interpretation: choice})[property_id]
    system = _system(wanted.on, interpretation, choice)
    question = reduce(lower(system), [wanted])
    at: dict[str, int] = dict(question.system.init)
    seen = []
    for length, values in given:
        told = {**NOMINAL, **values}
        inputs = {n: v.domain.raw(told[n]) if n in told else v.init for n, v in system.inputs.items()}
        for _ in range(length // TICK_MS):
            at = step(question.system, at, inputs)
            seen.append(bool(at[question.goals[0].var.name]))
    return any(seen)


NOT_FORWARD: Given = {"give_b2_actuation": False, "cmd": "CMD_NORMAL", "x_norm": 1, "y_norm": 0}


@pytest.mark.parametrize(
    ("choice", "property_id", "is_broken"),
    [("STOP-ALL", "PB1-23b", True), ("STOP-FORWARD", "PB1-23d", False)],
)
def test_E11_the_rover_turns_on_beside_an_obstacle(choice: str, property_id: str, is_broken: bool) -> None:
    """A stop of all motion is not what the motion chart does; a stop of forward motion is."""
    given = [(200, NOT_FORWARD), (200, {**NOT_FORWARD, "cmd": "CMD_ESTOP"})]
    assert broken(property_id, "E11", choice, given) is is_broken
    moving = _system("references", "E11", choice)
    assert histories(moving, given, ["omega_ref"], nominal=NOMINAL, warm_up=0) == ["0 20 1"]


@pytest.mark.parametrize(
    ("choice", "property_id", "is_broken"),
    [
        ("SAME-STEP", "PB2-01", True),
        ("NEXT-STEP", "PB2-02b", False),
        ("BOUNDED", "PB2-02-n1", False),
        ("BOUNDED", "PB2-02-n2", False),
        ("BOUNDED", "PB2-02-n3", False),
    ],
)
def test_E12_the_stop_comes_in_the_next_step(choice: str, property_id: str, is_broken: bool) -> None:
    assert broken(property_id, "E12", choice, [(200, {}), (200, S2(NEAR))]) is is_broken


# --- the sonar task, in ticks of 1 ms (E13) ---------------------------------------------------------


@pytest.mark.parametrize(
    ("choice", "after_the_cut"), [("FAR", 301), ("HOLD", 70), ("NEAR", 70), ("FAULT", 301)]
)
def test_E13_what_the_task_publishes_when_the_cable_of_S2_is_cut(choice: str, after_the_cut: int) -> None:
    """The first scan hears all three echoes, 301, 70 and 301 cm; the second one not that of S2."""
    system = _system("acquisition_sonar", "E13", choice)
    task, published = Interpreter(system), []
    for ms in range(120):
        echoes = {"both_edges1": True, "both_edges2": ms < 60, "both_edges3": True} if ms % 60 == 10 else {}
        told = {**echoes, "width1": 17458, "width2": 4117, "width3": 17458}
        task.step({n: v.domain.raw(told.get(n, False)) for n, v in system.inputs.items()})
        if task.data["sonar_published"]:
            published.append((task.data["dist_cm2"], task.data.get("sonar_fault", 0)))
    assert published == [(70, 0), (after_the_cut, int(choice == "FAULT"))]


# --- what Board 1 makes of it (E31) -----------------------------------------------------------------


@pytest.mark.parametrize(("choice", "turn"), [("NORMAL", "1"), ("AVOID-BY-PAIR", "0"), ("ZERO-TURN", "0")])
def test_E31_the_turn_while_the_rover_moves_toward_the_centre_sonar(choice: str, turn: str) -> None:
    """The stick is held to the left, the side to which the object goes."""
    left = {"bx_norm": 1}
    outputs = ["command", *(["x_sent"] if choice == "ZERO-TURN" else [])]
    decided = list(
        shown(
            _system("obstacles", "E31", choice),
            [(200, {**left, **S2(SEEN)}), (200, {**left, **S1(SEEN)})],
            outputs,
            NOMINAL,
        )
    )
    received = [
        {**NOT_FORWARD, "y_norm": 1, "cmd": d["command"], "x_norm": int(d.get("x_sent", 1))} for d in decided
    ]
    system = _system("references", "E31", choice)
    moved = [s["omega_ref"] for s in shown(system, [(TICK_MS, r) for r in received], ["omega_ref"], NOMINAL)]
    assert (moved[9], moved[-1]) == ("1", turn)


# --- completeness -----------------------------------------------------------------------------------


def test_every_choice_is_shown() -> None:
    seen = {(s.interpretation, choice) for s, choice in CASES} | {
        ("E11", c) for c in ambiguities()["E11"].choices
    }
    seen |= {("E12", c) for c in ambiguities()["E12"].choices}
    modelled = {
        (id, choice)
        for id, interpretation in ambiguities().items()
        if id.startswith("E")
        for choice in interpretation.choices
        if choice not in interpretation.not_modelled
    }
    assert modelled <= seen


def test_metres_per_second_are_not_modelled() -> None:
    with pytest.raises(ModelError, match="no whole number of rpm"):
        systems({"E25": "SI"})
