"""The scenarios that tell the interpretations of links, relay, masks and references apart (S34 to S66).

Each case is a scenario under one choice; what it shows is the whole history of the signals watched:
the values, each with the ms at which it begins.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import pytest

from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.rover import systems
from tests.interpretations.arrivals import at
from tests.interpretations.scenario import WARM_UP, Blocks, Given, histories

NO_LINK: Given = {"rx_update": False, "heartbeat_update": False}
NO_HEARTBEAT: Given = {"heartbeat_update": False}
CUT: Blocks = [(200, NO_LINK)]
COLD: Given = {"temp_reading": 66}
FLAT: Given = {"batt_reading": 10}

RX, SUP, BOTH = (
    ("reception_exact", "rx_status"),
    ("heartbeat_exact", "b2_sup_status"),
    ("board1", "critical_mask"),
)
RX_MS, SUP_MS = ("reception_ms_exact", "rx_status"), ("heartbeat_ms_exact", "b2_sup_status")
GIVE = ("board1", "give_b2_actuation")
SAFETY = ("board1", "rover_safety_state")

SHORT = {
    **{f"{status}_{level}": short for status in ("RX", "SUP", "SAFETY", "TEMP_HEALTH", "BATT_HEALTH")
       for level, short in (("OK", "OK"), ("DEGRADED", "DEG"), ("CRITICAL", "CRIT"))},
    "false": "0", "true": "1",
}  # fmt: skip


@dataclass(frozen=True)
class Scenario:
    """What is given to which system, what is watched there, and what each choice shows."""

    interpretation: str
    number: int
    on: tuple[str, ...]
    given: Blocks
    shows: Mapping[str, str]
    warm_up: int = WARM_UP


EVERY_40: Blocks = [(20, NO_LINK), (20, {})] * 12


AT_38 = at([400 - 38 * n for n in range(11)], first_step=20, last_step=600)
AT_38_SUP = at([400 - 38 * n for n in range(11)], first_step=20, last_step=600, link="heartbeat")
PAIRS = [1000 + 50 * n + late for n in range(11) for late in (0, 1)]
IN_PAIRS = at(PAIRS, first_step=987, last_step=1507)
IN_PAIRS_SUP = at(PAIRS, first_step=987, last_step=1507, link="heartbeat")
SLOW_START: Blocks = [(1000, NO_LINK), (20, {}), (40, NO_LINK), (300, {})]
LATE_START: Blocks = [(880, NO_LINK), (300, {})]
LONG_GAP: Blocks = [(280, NO_LINK), (2300, {})]
GAP_AND_CUT: Blocks = [(280, NO_LINK), (200, {}), (200, NO_LINK)]
THREE_AT_ONCE: Blocks = [(40, NO_HEARTBEAT), (20, {"heartbeat_moves": 3})] * 14

V_REF, STOP = ("board1", "v_ref"), ("board1", "actuate_emergency_stop")
GO_LEFT: Given = {"frame_cmd": "CMD_GO_LEFT", "undefined_v_ref": -0.3, "undefined_omega_ref": 0.7}
ESTOP: Given = {"frame_cmd": "CMD_ESTOP"}
TURNING: Given = {"wheel_speed_rpm_FL": 60}
RELEASED: Given = {"operator_release": True}

RELAY = ("relay", "give_b2_actuation")
RX_CRIT: Given = {"rx_status": "RX_CRITICAL"}
RX_DEG: Given = {"rx_status": "RX_DEGRADED"}
ALTERNATING: Blocks = [(1000, RX_CRIT), (1000, {}), (1000, RX_CRIT), (1000, {})]

SCENARIOS = [
    # --- links ---
    *(Scenario("S34", n, link, SLOW_START, {
        "PARTIAL": "OK 120 CRIT 1000 OK 1060 DEG 1080 OK", "WAIT10": "OK 120 CRIT 1000 OK"}, warm_up=0)
      for n, link in enumerate((RX, SUP), 1)),
    *(Scenario("S35", n, link, given, {  # 100 ms of silence at 480, critical beyond 120 ms
        "CLOSED": "OK 520 CRIT", "OPEN": "OK 440 DEG 520 CRIT"}, warm_up=0)
      for n, (link, given) in enumerate(((RX_MS, AT_38), (SUP_MS, AT_38_SUP)), 1)),
    *(Scenario("S36", n, link, given, {"SAMPLED": "OK 520 DEG", "ARRIVAL": "OK"}, warm_up=0)
      for n, (link, given) in enumerate(((RX_MS, IN_PAIRS), (SUP_MS, IN_PAIRS_SUP)), 1)),
    *(Scenario("S37", n, link, EVERY_40, {"GT": "OK", "GE": "OK 380 DEG"})
      for n, link in enumerate((RX, SUP), 1)),
    *(Scenario("S37", n, link, CUT, {"GT": "OK 120 CRIT", "GE": "OK 100 CRIT"})
      for n, link in enumerate((RX, SUP), 3)),
    Scenario("S38", 1, RX, LONG_GAP, {
        "FIRST-FRESH": "OK 120 CRIT 280 DEG 480 OK", "MEAN-BASED": "OK 120 CRIT 480 OK",
        "HOLD-TIME": "OK 120 CRIT 1300 OK"}),
    Scenario("S38", 2, SUP, LONG_GAP, {
        "FIRST-FRESH": "OK 120 CRIT 280 DEG 480 OK", "MEAN-BASED": "OK 120 CRIT 480 OK",
        "HOLD-TIME": "OK 120 CRIT 2300 OK"}),
    *(Scenario("S39", n, link, GAP_AND_CUT, {  # age 140 with a mean of 48 at 600
        "CRIT-WINS": "OK 120 CRIT 280 DEG 600 CRIT", "DEG-WINS": "OK 120 CRIT 280 DEG"})
      for n, link in enumerate((RX, SUP), 1)),
    Scenario("S40", 1, SUP, THREE_AT_ONCE, {"ANY-CHANGE": "OK 340 DEG", "COUNT-DELTA": "OK"}),
    Scenario("S41", 1, BOTH, CUT, {"INDEPENDENT": "0 120 132", "MASKED": "0 120 4"}),
    *(Scenario("S66", n, link, LATE_START, {  # the tenth frame at 1060
        "NO-COUNT": "OK 120 CRIT 880 OK", "COUNT": "OK 120 CRIT 880 OK 1060 DEG 1080 OK"}, warm_up=0)
      for n, link in enumerate((RX, SUP), 1)),
    # --- relay ---
    Scenario("S43", 1, GIVE, [(1000, NO_HEARTBEAT)], {"OR": "0 120 1", "AND": "0"}),
    Scenario("S44", 1, RELAY, [(1000, RX_DEG)], {
        "NOT-CRIT": "0", "STRICT-OK-KEPT": "0", "STRICT-OK-1": "0 20 1"}, warm_up=0),
    Scenario("S44", 2, RELAY, [(1000, RX_CRIT), (4000, RX_DEG)], {
        "NOT-CRIT": "1 4020 0", "STRICT-OK-KEPT": "1", "STRICT-OK-1": "1"}),
    Scenario("S45", 1, RELAY, [(1000, RX_CRIT), (4000, {})], {
        "3-S": "1 4020 0", "IMMEDIATE": "1 1000 0"}),
    Scenario("S45", 2, RELAY, ALTERNATING, {"3-S": "1", "IMMEDIATE": "1 1000 0 2000 1 3000 0"}),
    Scenario("S46", 1, RELAY, ALTERNATING, {"AS-S45": "1"}),
    Scenario("S48", 1, ("board1", "v_ref", "rover_safety_state"), CUT, {
        "HELD": "1, OK", "ZERO": "1 120 0, OK", "STILL-COMPUTED": "1 120 0, OK 120 CRIT"}),
    Scenario("S49", 1, ("board1", "give_b2_actuation", "rover_safety_state"), CUT, {
        "STOP-AND-GIVE": "0 120 1, OK 120 CRIT", "GIVE-ONLY": "0 120 1, OK"}),
    Scenario("S50", 1, GIVE, [(4100, COLD)], {"RX/SUP-ONLY": "0", "ANY-CRITICAL": "0 4000 1"}),
    # --- masks ---
    Scenario("S51", 1, ("board1", "critical_mask"), [(5100, FLAT)], {
        "COMPONENT": "0 5000 2", "LITERAL": "0"}),
    Scenario("S51", 2, ("board1", "critical_mask"), [(4100, COLD)], {
        "COMPONENT": "0 4000 1", "LITERAL": "0 4000 251"}),
    Scenario("S52", 1, ("board1", "critical_mask", "degraded_mask"), [(6000, FLAT)], {
        "EXCLUSIVE": "0 5000 2, 2 5000 0", "BOTH": "0 5000 2, 2"}),
    Scenario("S54", 1, SAFETY, [(100, {"frame_crit_mask_b2": 8})], {  # bit 3: supervisor or front left wheel
        "B2BITS": "DEG", "SAME-AS-B1": "CRIT"}),
    # --- safety state ---
    Scenario("S55", 1, ("board1", "rover_safety_state", "v_ref"), [(100, {"frame_crit_mask_b2": 4})], {
        "ANY-BIT": "CRIT, 0", "CLASSIFIED": "DEG, 0.5"}),
    Scenario("S56", 1, SAFETY, [(100, {"frame_crit_mask_b2": 2, "frame_degr_mask_b2": 1})], {
        "CRIT-FIRST": "CRIT", "FIG21": "CRIT", "DEG-FIRST": "DEG"}),
    Scenario("S56", 2, SAFETY, [(60, {"frame_degr_mask_b2": 1}), (60, {"frame_crit_mask_b2": 2})], {
        "CRIT-FIRST": "DEG 60 CRIT", "FIG21": "DEG 60 OK 80 CRIT", "DEG-FIRST": "DEG 60 OK 80 CRIT"}),
    Scenario("S65", 1, ("temperature", "temp_status"), [(100, {"temp_reading": 57})], {
        "CLASSIFY": "DEG", "DEFAULT-OK": "OK 20 DEG"}, warm_up=0),
    Scenario("S65", 2, ("battery", "batt_status"), [(100, {"batt_reading": 22.9})], {
        "CLASSIFY": "DEG", "DEFAULT-OK": "OK 20 DEG"}, warm_up=0),
    Scenario("S65", 3, ("wheel_FL", "wheel_status_FL"), [(100, {"hasNoFeedback_FL": True})], {
        "CLASSIFY": "WHEEL_DEGRADED_ENCODER", "DEFAULT-OK": "WHEEL_OK 20 WHEEL_DEGRADED_ENCODER"}, warm_up=0),
    # --- references and emergency stop ---
    Scenario("S57", 1, V_REF, [(100, {"frame_crit_mask_b2": 4, "frame_y_norm": 0.4})], {
        "SCALE": "0.2", "CLIP": "0.4"}),
    Scenario("S58", 1, V_REF, [(100, {"frame_y_norm": 1})], {"NORMALISED": "1"}),
    Scenario("S59", 1, V_REF, [(100, {"frame_y_norm": -0.4})], {
        "SIGNED": "-0.4", "FORWARD-ONLY": "0", "MOTION-CHART": "0"}),
    Scenario("S59", 2, ("references", "v_ref"), [(100, {"y_norm": -0.4, "backward_enabled": True})], {
        "SIGNED": "-0.4", "FORWARD-ONLY": "0", "MOTION-CHART": "-0.4"}),
    Scenario("S59", 3, ("board1", "current_action"), [(100, {"frame_y_norm": -1})], {
        "SIGNED": "CMD_NORMAL", "FORWARD-ONLY": "CMD_NORMAL", "MOTION-CHART": "CMD_ROTATE_180"}),
    Scenario("S60", 1, ("board1", "v_ref", "omega_ref"), [(100, GO_LEFT)], {
        "UNDEFINED": "1 20 -0.3, 0 20 0.7", "ASSUME-NAMES": "1, 0 20 0.4",
        "MOTION-CHART": "1 20 0.8, 0 20 0.4"}),
    Scenario("S61", 1, STOP, [(4100, COLD)], {  # degraded before 4000
        "COLLISION-ONLY": "0", "ANY-CRITICAL": "0 4020 1"}),
    Scenario("S62", 1, STOP, [(100, {**ESTOP, **TURNING}), (2000, TURNING), (1500, {})], {
        "FOLLOW": "1 100 0", "LATCH-UNTIL-STOPPED": "1 3140 0", "OPERATOR": "1"}),
    Scenario("S62", 2, STOP, [(100, {**ESTOP, **TURNING}), (1500, {}), (100, RELEASED)], {
        "FOLLOW": "1 100 0", "LATCH-UNTIL-STOPPED": "1 1140 0", "OPERATOR": "1 1600 0"}),
    Scenario("S63", 1, STOP, [(60, {"frame_y_norm": 0}), (60, {"frame_y_norm": 0, **ESTOP})], {
        "UNCONDITIONAL": "0 60 1", "ONLY-FORWARD": "0"}),
    Scenario("S64", 1, ("board1", "omega_ref"), [(100, {"frame_x_norm": 1})], {"LEFT-POSITIVE": "1"}),
]  # fmt: skip


CASES = [(scenario, choice) for scenario in SCENARIOS for choice in scenario.shows]


@pytest.mark.parametrize(
    ("scenario", "choice"), CASES, ids=[f"{s.interpretation}-{choice}-{s.number}" for s, choice in CASES]
)
def test_a_choice_shows_what_tells_it_apart(scenario: Scenario, choice: str) -> None:
    name, *watched = scenario.on
    system = systems({scenario.interpretation: choice})[name]
    found = histories(system, scenario.given, watched, warm_up=scenario.warm_up)
    assert ", ".join(_short(history) for history in found) == scenario.shows[choice]


def _short(history: str) -> str:
    return " ".join(SHORT.get(word, word) for word in history.split())


NOTHING_TO_SHOW = {("S42", "SYNONYMS"), ("S47", "FAIL-TO-B2"), ("S53", "8")}
"""Choices of interpretations that differ in names, in a board without power, or in no signal at all."""


def test_every_choice_is_shown() -> None:
    mine = [r for id, r in ambiguities().items() if "S34" <= id <= "S66"]
    shown = {(s.interpretation, choice) for s in SCENARIOS for choice in s.shows}
    modelled = {(r.id, choice) for r in mine for choice in r.choices if choice not in r.not_modelled}
    assert modelled - shown == NOTHING_TO_SHOW
