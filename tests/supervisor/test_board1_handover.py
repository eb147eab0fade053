"""Board 1 gives actuation to Board 2 and takes it back: what is frozen meanwhile, and goes on from there."""

from rovercheck.supervisor.types import Level, SafetyState
from rovercheck.supervisor.types import SupervisorCommand as COMMAND
from tests.supervisor.board1_bench import Bench, lose_link, references


def test_hand_over_freezes_the_references_and_the_safety_state():
    bench = Bench().set(x_norm=0.2, y_norm=0.7)
    bench.step(5)
    out = lose_link(bench)
    assert out.give_b2_actuation
    assert out.statuses.rx_status is out.statuses.b2_sup_status is Level.CRITICAL
    assert out.critical_mask == 4 + 128
    assert (*references(out), out.rover_safety_state) == (0.7, 0.2, SafetyState.SAFETY_OK)
    out = bench.set(temperature_degc=70.0).step(300)
    assert out.critical_mask == 1 + 4 + 128
    assert (*references(out), out.rover_safety_state) == (0.7, 0.2, SafetyState.SAFETY_OK)


def test_return_goes_on_from_the_frozen_state():
    bench = Bench().set(y_norm=0.7)
    bench.step(5)
    lose_link(bench)
    bench.link = True
    bench.set(y_norm=0.3)
    out = bench.step(151)
    assert (out.give_b2_actuation, out.v_ref) == (True, 0.7)
    out = bench.step()
    assert (out.give_b2_actuation, out.v_ref) == (False, 0.3)


def test_a_stop_stays_a_stop_across_hand_over_and_its_second_is_not_counted():
    bench = Bench().set(critical_mask=1)
    bench.step(2 + 26)
    lose_link(bench)  # six more enabled steps
    bench.link = True
    out = bench.step(151)
    assert out.give_b2_actuation and out.actuate_emergency_stop
    # braking since step 2, at standstill from step 3 on: enabled steps up to the 54th
    assert bench.step(54 - 34 - 1).current_action is COMMAND.CMD_ESTOP
    assert bench.step().current_action is COMMAND.CMD_STOP


def test_edges_and_timers_of_the_buttons_are_frozen():
    bench = Bench()
    bench.step(2)
    bench.set(btn1=True)
    bench.step()
    bench.set(btn1=False).step()
    lose_link(bench)
    bench.link = True
    bench.step(151)
    bench.set(btn1=True).step()  # the first step back: an edge from the frozen memory, within the second
    bench.set(btn1=False).step()
    bench.set(btn2=True).step()
    bench.set(btn2=False).step()
    assert bench.set(btn2=True).step().backward_enabled


def test_the_target_of_a_half_turn_is_kept():
    bench = Bench().set(yaw=10.0)
    bench.step(2)
    out = bench.set(y_norm=-1.0).step(2)
    assert (out.target_angle, out.omega_ref) == (190, 1)
    lose_link(bench)
    bench.link = True
    out = bench.set(yaw=100.0).step(151)
    assert out.angle_err == -180
    out = bench.step()
    assert (out.target_angle, out.angle_err, out.omega_ref) == (190, 90, -1)


def test_a_silent_supervisor_alone_gives_actuation_away():
    bench = Bench()
    bench.step(5)
    bench.heart = False
    assert not bench.step(6).give_b2_actuation
    out = bench.step()
    assert out.give_b2_actuation and out.critical_mask == 128
    bench.heart = True
    assert bench.step(151).give_b2_actuation
    assert not bench.step().give_b2_actuation


def test_a_slow_link_does_not_give_actuation_away():
    bench = Bench()
    for _ in range(20):
        for bench.link, steps in ((False, 5), (True, 1)):
            out = bench.step(steps)
    assert (out.degraded_mask, out.critical_mask, out.give_b2_actuation) == (4 + 128, 0, False)
