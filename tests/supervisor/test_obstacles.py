"""The obstacle charts of Board 2, against the document: boundaries, timers, order of events, turning."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.board2.decision import Decision
from rovercheck.supervisor.board2.distances import Distances, close_range, within
from rovercheck.supervisor.board2.obstacles import Obstacles
from rovercheck.supervisor.board2.obstacles.decisions import Decisions, has_turned, target_angle
from rovercheck.supervisor.board2.obstacles.events import Event
from rovercheck.supervisor.board2.obstacles.timers import PairTimer, pair_timers
from rovercheck.supervisor.board2.obstacles_degraded import DegradedObstacles

FAR, SEEN, NEAR = 301, 200, 60
CLEAR: Distances = (FAR, FAR, FAR)
READY, STOP, S1, S2, S3 = list(Decision)[:5]
PAIRS = [(0, 1, S1), (1, 0, S2), (1, 2, S2), (2, 1, S3)]
"""Sonar that falls, sonar that sees the obstacle next, decision."""


def at(distance: float, *sonars: int) -> Distances:
    """An obstacle at this distance before the sonars named 0, 1, 2."""
    left, centre, right = (distance if i in sonars else FAR for i in range(3))
    return left, centre, right


def seen(*sonars: int) -> Distances:
    """An obstacle in the field of the sonars."""
    return at(SEEN, *sonars)


def run(
    chart: Obstacles, *blocks: tuple[int, Distances], yaw: float = 0, deg: bool = False
) -> list[Decision]:
    """The decisions of so many steps with each distances."""
    return [chart.step(distances, yaw, deg) for count, distances in blocks for _ in range(count)]


def last(*blocks: tuple[int, Distances]) -> Decision:
    """The decision after the steps of a new chart."""
    return run(Obstacles(), *blocks)[-1]


def moving(decision: Decision, yaw: float = 0) -> Obstacles:
    """A chart that has just decided on a move, with the flags as the move left them."""
    chart = Obstacles()
    first, second, _ = next(pair for pair in PAIRS if pair[2] is decision)
    assert run(chart, (3, seen(first)), (2, seen(second)), yaw=yaw)[-2:] == [READY, decision]
    return chart


# --- distances -----------------------------------------------------------------------------------


@pytest.mark.parametrize("sonar", range(3))
@pytest.mark.parametrize(
    ("distance", "stops"),
    [(-1, True), (0, True), (70, True), (70.5, False), (71, False), (85, False), (301, False)],
)
def test_an_obstacle_at_70_cm_before_any_sonar_stops(sonar, distance, stops):
    assert last((2, at(distance, sonar))) is (STOP if stops else READY)


@pytest.mark.parametrize(
    ("distance", "moves"),
    [(71, False), (85, False), (100, False), (100.5, True), (101, True), (200, True)]
    + [(300, True), (300.5, False), (301, False)],
)
@pytest.mark.parametrize(("first", "second", "decision"), PAIRS)
def test_an_obstacle_beyond_100_cm_up_to_300_is_watched(first, second, decision, distance, moves):
    assert last((5, at(distance, first)), (3, seen(second))) is (decision if moves else READY)
    assert last((5, seen(first)), (3, at(distance, second))) is (decision if moves else READY)


@pytest.mark.parametrize("distance", [nan, inf, -inf])
def test_a_distance_that_is_no_number_is_an_obstacle(distance):
    assert last((2, (FAR, distance, FAR))) is STOP
    assert within((FAR, FAR, distance), 300)
    assert not close_range(distance)


@given(st.lists(st.tuples(*[st.sampled_from([0, 70, 71, 100, 101, 200, 300, 301])] * 3), min_size=2))
def test_it_stops_exactly_in_the_step_after_a_near_obstacle(distances):
    decisions = [decision is STOP for decision in run(Obstacles(), *((1, d) for d in distances))]
    assert decisions == [False] + [min(d) <= 70 for d in distances[:-1]]


@pytest.mark.parametrize(("distances", "second"), [(seen(0), READY), (at(NEAR, 0), STOP), (CLEAR, READY)])
@pytest.mark.parametrize("deg", [False, True])
def test_the_first_execution_takes_over_the_distances_only(distances, second, deg):
    chart = Obstacles()
    assert run(chart, (1, distances), deg=deg) == [READY]
    assert run(chart, (1, seen(1))) == [second]


def test_an_obstacle_of_the_first_step_counts_as_detected():
    assert run(Obstacles(), (1, seen(0, 1)), (3, seen(1))) == [READY, READY, S1, S1]


def test_a_distance_that_flickers_is_followed_one_step_later():
    near = (FAR, NEAR, FAR)
    decisions = run(Obstacles(), (1, CLEAR), (1, near), (1, CLEAR), (2, near), (2, CLEAR))
    assert decisions == [READY, READY, STOP, READY, STOP, STOP, READY]


# --- the window of three seconds -----------------------------------------------------------------


@pytest.mark.parametrize(("first", "second", "decision"), PAIRS)
@pytest.mark.parametrize(
    ("steps", "moves"), [(1, True), (148, True), (149, True), (150, False), (151, False)]
)
def test_the_neighbour_must_see_the_obstacle_within_three_seconds(first, second, decision, steps, moves):
    """The first sonar loses it in step m, the second sees it from step m + ``steps`` on (E14)."""
    decisions = run(Obstacles(), (5, seen(first)), (steps, CLEAR), (5, seen(second)))
    expected = [READY] * (6 + steps) + [decision if moves else READY] * 4
    assert decisions == expected


@pytest.mark.parametrize(("first", "second", "decision"), PAIRS)
def test_a_neighbour_that_already_sees_it_confirms_at_once(first, second, decision):
    """E15: in the step in which the fall is noticed, one after the distance changed."""
    assert run(Obstacles(), (5, seen(first, second)), (2, seen(second)))[-2:] == [READY, decision]


def test_a_second_fall_does_not_restart_the_window():
    """E16: S1 falls at 0 s and at 2.6 s, S2 sees it at 4 s."""
    blocks = (5, seen(0)), (120, CLEAR), (10, seen(0)), (70, CLEAR), (5, seen(1))
    assert set(run(Obstacles(), *blocks)) == {READY}


def test_a_fall_after_the_window_opens_a_new_one():
    blocks = (5, seen(0)), (160, CLEAR), (5, seen(0)), (100, CLEAR), (2, seen(1))
    assert last(*blocks) is S1


@pytest.mark.parametrize("steps", [149, 150, 151])
def test_the_step_that_ends_the_window_takes_no_fall(steps):
    """The timer is entered with the fall of step 7; a second fall comes ``steps`` steps later."""
    blocks = (5, seen(0)), (steps - 1, CLEAR), (1, seen(0)), (1, CLEAR), (100, CLEAR), (2, seen(1))
    assert last(*blocks) is (S1 if steps == 151 else READY)


def test_an_obstacle_that_comes_nearer_leaves_the_field_too():
    assert last((5, seen(0, 1)), (2, (90, SEEN, FAR))) is S1  # E17


@pytest.mark.parametrize("wait", [20, 145])
def test_a_stop_freezes_the_memory_of_a_detection(wait):
    """E18."""
    near = (NEAR, FAR, FAR)
    assert last((10, seen(0)), (10, near), (wait, CLEAR), (3, seen(1))) is S1


def test_a_near_obstacle_before_the_third_sonar_freezes_the_pair_of_the_others():
    """E27: the fall of sonar 1 counts from the end of the stop."""
    blocks = (10, seen(0)), (3, (SEEN, FAR, NEAR)), (7, (FAR, FAR, NEAR)), (145, CLEAR), (3, seen(1))
    assert last(*blocks) is S1


def test_70_cm_suspends_the_watch_like_any_nearer_obstacle():
    """E02."""
    decisions = run(Obstacles(), (5, (SEEN, FAR, 70)), (20, (FAR, SEEN, 70)))
    assert set(decisions[1:]) == {STOP}


def test_a_gap_between_70_and_100_cm_is_neither_stop_nor_field():
    """E01: d1 85 for 1 s, then gone, then d2 85."""
    assert set(run(Obstacles(), (50, (85, FAR, FAR)), (1, CLEAR), (50, (FAR, 85, FAR)))) == {READY}


# --- several events in one step ------------------------------------------------------------------


def test_of_two_pairs_in_one_step_the_left_one_wins():
    assert last((5, seen(0, 1, 2)), (2, seen(1))) is S1  # E20


def test_a_move_is_not_changed_by_another_pair():
    chart = moving(S1)
    assert set(run(chart, (5, seen(2)), (5, seen(1)))) == {S1}  # E19


@pytest.mark.parametrize(("others", "decision"), [((0,), READY), ((2,), READY), ((0, 2), S2)])
def test_an_event_that_meets_the_end_of_a_move_is_lost_and_the_next_one_counts(others, decision):
    """Guards are tested in nested executions: the first event ends the turn, the second starts a move."""
    chart = moving(S1)
    run(chart, (5, seen(1, *others)), (1, seen(*others)))
    assert run(chart, (1, seen(*others)), yaw=315) == [decision]


def test_an_event_sent_in_the_step_of_the_end_of_the_emergency_counts():
    chart = Obstacles()
    run(chart, (5, seen(0)), (1, (SEEN, FAR, NEAR)))
    assert run(chart, (2, seen(1))) == [STOP, S1]


def test_an_event_sent_in_the_step_of_the_emergency_is_lost():
    chart = Obstacles()
    run(chart, (5, seen(0)), (1, (FAR, SEEN, NEAR)))
    assert run(chart, (3, seen(1))) == [STOP, READY, READY]


@pytest.mark.parametrize("decision", [S1, S2, S3])
@pytest.mark.parametrize(("yaw", "deg"), [(0, False), (0, True), (315, False), (45, False)])
def test_an_emergency_ends_a_move_before_anything_else(decision, yaw, deg):
    chart = moving(decision)
    run(chart, (1, (FAR, FAR, NEAR)))
    assert run(chart, (2, CLEAR), yaw=yaw, deg=deg) == [STOP, READY]


@pytest.mark.parametrize("decision", [S1, S2, S3])
def test_a_degraded_board_1_ends_a_move(decision):
    chart = moving(decision)
    assert run(chart, (1, CLEAR)) == [decision]
    assert run(chart, (1, CLEAR), deg=True) == [READY]


@pytest.mark.parametrize(("first", "second", "decision"), PAIRS)
def test_a_move_decided_with_a_degraded_board_1_ends_in_its_own_step(first, second, decision):
    chart = Obstacles()
    run(chart, (5, seen(first, second)), (1, seen(second)))
    assert run(chart, (1, seen(second)), deg=True) == [READY]
    assert run(chart, (1, seen(second))) == [READY]


def test_a_fall_reaches_the_timers_one_after_the_other_even_if_one_of_them_sends():
    """The region that sends does not take the event from the regions after it."""
    timers = pair_timers()
    sent: list[Event] = []

    def execute(event: Event | None, detected: tuple[bool, bool, bool]) -> None:
        for timer in timers:
            timer.execute(event, detected, sent.append)

    execute(Event.FALL1, (False, False, False))
    execute(Event.FALL2, (False, True, False))
    assert sent == [Event.MOVE_TO_S1]
    execute(None, (True, False, True))
    assert sent == [Event.MOVE_TO_S1, Event.MOVE_TO_S2, Event.MOVE_TO_S2]
    execute(None, (True, True, True))
    assert len(sent) == 3


@pytest.mark.parametrize(("ticks", "sends"), [(149, True), (150, False), (151, False)])
def test_a_nested_execution_tests_the_window_but_does_not_count(ticks, sends):
    timer = PairTimer(Event.FALL1, neighbour=1, move=Event.MOVE_TO_S1)
    sent: list[Event] = []
    timer.execute(Event.FALL1, (False, False, False), sent.append)
    for _ in range(ticks):
        timer.tick()
    for _ in range(200 if sends else 0):
        timer.execute(Event.FALL3, (False, False, False), sent.append)
    timer.execute(Event.FALL3, (False, True, False), sent.append)
    assert sent == ([Event.MOVE_TO_S1] if sends else [])


STARTS = [(Event.EMERGENCY, STOP), (Event.MOVE_TO_S1, S1), (Event.MOVE_TO_S2, S2), (Event.MOVE_TO_S3, S3)]


@pytest.mark.parametrize("event", [None, *Event])
def test_waiting_takes_an_emergency_and_the_moves(event):
    decisions = Decisions()
    decisions.execute(event, 0, False)
    assert decisions.decision is next((state for start, state in STARTS if start is event), READY)


@pytest.mark.parametrize("event", [None, *Event])
@pytest.mark.parametrize(("start", "state"), STARTS)
def test_an_emergency_takes_its_end_only_and_a_move_the_emergency_only(start, state, event):
    decisions = Decisions()
    decisions.execute(start, 0, False)
    decisions.execute(event, 0, False)
    taken = (Event.SAFE, READY) if state is STOP else (Event.EMERGENCY, STOP)
    assert decisions.decision is (taken[1] if event is taken[0] else state)


# --- the end of a move ---------------------------------------------------------------------------


def test_straight_ahead_lasts_25_steps():
    decisions = run(moving(S2), (26, CLEAR))
    assert decisions == [S2] * 24 + [READY] * 2


def test_straight_ahead_lasts_25_steps_each_time():
    chart = moving(S2)
    run(chart, (200, CLEAR), (5, seen(1)), (2, seen(0)))
    assert run(chart, (26, CLEAR)) == [S2] * 24 + [READY] * 2


@pytest.mark.parametrize("yaw", [0, 10, 44, 45, 46, 180, 314, 315, 316, 350, 359.5])
@pytest.mark.parametrize(("decision", "side"), [(S1, -1), (S3, 1)])
def test_a_turn_ends_at_45_degrees_also_across_north(yaw, decision, side):
    for turned in (0, 44.5, -20, -134.5):
        chart = moving(decision, yaw)
        assert run(chart, (1, CLEAR), yaw=(yaw + side * turned) % 360) == [decision]
    for turned in (45, 45.5, 90, 180):
        chart = moving(decision, yaw)
        assert run(chart, (1, CLEAR), yaw=(yaw + side * turned) % 360) == [READY]


@pytest.mark.parametrize(
    ("decision", "turned", "ends"),
    [(S1, 135, False), (S1, 135.5, True), (S3, -134.5, False), (S3, -135, True)],
)
def test_135_degrees_the_other_way_pass_for_turned(decision, turned, ends):
    """A comparison of headings knows no more (E06): here half a turn lies between heading and target."""
    assert run(moving(decision, 90), (1, CLEAR), yaw=(90 + turned) % 360) == [READY if ends else decision]


@pytest.mark.parametrize(
    ("yaw", "left", "right"), [(0, 315, 45), (45, 0, 90), (44, 359, 89), (315, 270, 360), (316, 271, 1)]
)
def test_target_angles(yaw, left, right):
    assert target_angle(yaw, S1) == left
    assert target_angle(yaw, S3) == right


def test_the_turn_is_measured_from_the_heading_at_the_decision():
    """E07: yaw 20 when the second sonar sees it."""
    chart = Obstacles()
    run(chart, (5, seen(0)), (5, CLEAR))
    assert run(chart, (2, seen(1)), yaw=20)[-1] is S1
    assert run(chart, (1, CLEAR), yaw=336) == [S1]
    assert run(chart, (1, CLEAR), yaw=335) == [READY]


def test_a_turn_has_no_time_limit():
    assert set(run(moving(S3), (2000, CLEAR))) == {S3}  # E08


@pytest.mark.parametrize("yaw", [nan, inf, -inf])
@pytest.mark.parametrize("decision", [S1, S3])
def test_a_turn_that_cannot_be_measured_ends(yaw, decision):
    assert run(moving(decision), (1, CLEAR), yaw=yaw) == [READY]
    assert has_turned(0, yaw, decision)
    first, second, _ = next(pair for pair in PAIRS if pair[2] is decision)
    assert set(run(Obstacles(), (3, seen(first)), (5, seen(second)), yaw=yaw)) == {READY}


# --- the degraded chart --------------------------------------------------------------------------


def test_the_degraded_chart_moves_in_its_first_execution():
    chart = DegradedObstacles()
    assert chart.step((0, 0, 0)) is Decision.DEGRADED_MOVE
    assert chart.step((0, 0, 0)) is Decision.DEGRADED_STOP


@given(st.lists(st.tuples(*[st.sampled_from([0, 70, 200, 299, 300, 300.5, 301, nan, inf])] * 3), min_size=1))
def test_the_degraded_chart_stops_in_the_same_step_up_to_300_cm(distances):
    chart = DegradedObstacles()
    chart.step(CLEAR)
    for d in distances:
        stops = any(not (300 < x < inf) for x in d)
        assert chart.step(d) is (Decision.DEGRADED_STOP if stops else Decision.DEGRADED_MOVE)
