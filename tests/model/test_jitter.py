"""Steps and periods of 19 to 21 ms: what a board sees of frames, against the instants at which they come."""

from itertools import accumulate, pairwise

from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.environment.jitter import JITTER
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.rover import systems
from rovercheck.spec_model.signals import board2_supervisor as b2

PERIODS = st.lists(st.sampled_from([19, 20, 21]), min_size=2, max_size=30)


class Sender:
    """A transmit task whose first frame is 1 ms after power-up."""

    def __init__(self, periods: list[int]) -> None:
        self.sent = list(accumulate(periods, initial=1))
        self.periods = periods

    def inputs(self, before: int, now: int) -> dict[str, int]:
        """The periods after the frames that come in a step; those of frames that do not come are any."""
        coming = [i for i, at in enumerate(self.sent) if before < at <= now]
        after = [self.periods[i] for i in coming] + [20, 20]
        return {"after_first_ms": after[0], "after_second_ms": after[1]}


@given(steps=PERIODS, periods=st.lists(st.sampled_from([19, 20, 21]), min_size=40, max_size=40))
def test_a_step_sees_the_latest_frame_before_it(steps: list[int], periods: list[int]) -> None:
    machine, sender = Interpreter(systems()["frames_2_jitter"]), Sender(periods)
    before = 0
    for now in accumulate(steps):
        inputs = {"step_ms": now - before, "first_intact": 1, "second_intact": 1}
        machine.step(inputs | sender.inputs(before, now))
        came = [at for at in sender.sent if at <= now]
        data = machine.data
        assert data[b2.RX.update.name] == any(at > before for at in came)
        assert data["B2.rx_age_ms"] == now - came[-1]
        assert data["until_sent_ms"] == min(at for at in sender.sent if at > now) - now
        before = now


@given(steps=PERIODS, periods=st.lists(st.sampled_from([19, 20, 21]), min_size=40, max_size=40))
def test_the_mean_of_gaps_is_that_of_the_stamps_asked_for(steps: list[int], periods: list[int]) -> None:
    """A region asks in each step in which it takes no transition; the first question only takes the stamp."""
    machine, sender = Interpreter(systems()["frames_2_jitter"]), Sender(periods)
    asked: list[int] = []
    before, slow = 0, 0
    for number, now in enumerate(accumulate(steps)):
        inputs = {"step_ms": now - before, "first_intact": 1, "second_intact": 1}
        fired = machine.step(inputs | sender.inputs(before, now))
        stamp = max(at for at in sender.sent if at <= now)
        if number and not fired and (not asked or stamp != asked[-1]):
            asked.append(stamp)
            gaps = [later - earlier for earlier, later in pairwise(asked)][-10:]
            slow = int(sum(gaps) > 40 * len(gaps)) if gaps else slow
        assert machine.data["deg_rx"] == slow
        before = now


def test_a_proof_about_steps_of_unlike_lengths_says_so() -> None:
    measured = [system for system in systems().values() if system.elapsed is not None]
    assert measured
    assert all(JITTER in system.notes and JITTER.brief in system.limited_to for system in measured)
