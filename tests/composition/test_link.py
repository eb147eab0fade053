"""The link: order, lateness, loss, and what the receiver is told of the alive counter."""

from collections.abc import Sequence

from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.composition.link import ARRIVAL, link
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.words import modulo

number = var("number", integer(0, 63), doc="frames sent")
received = var("received", integer(0, 63))
accepted, new, executes = flag("accepted"), flag("new"), flag("executes")
made = link("L", [(number, received)], accepted=accepted, counter_changed=new, executes=executes)
count = Block("Count", [assign(number, modulo(number + 1, 64))])
system = in_order("S", made.receive, count, made.send)

Choice = tuple[str, bool]
choices = st.lists(st.tuples(st.sampled_from(["nothing", "newest", "older"]), st.booleans()), max_size=40)


def run(arrivals: Sequence[Choice]) -> list[tuple[int, int, int]]:
    """Payload, accepted and new counter after each tick."""
    rover = Interpreter(system)
    seen = []
    for arrival, executed in arrivals:
        rover.step({"L.arrives": ARRIVAL.raw(arrival), "executes": int(executed)})
        seen.append((rover.data["received"], rover.data["accepted"], rover.data["new"]))
    return seen


def test_a_frame_is_seen_one_or_two_steps_later() -> None:
    newest = run([("newest", True)] * 4)
    assert [payload for payload, _, _ in newest] == [0, 1, 2, 3]
    older = run([("nothing", True), ("nothing", True), ("older", True), ("older", True)])
    assert [payload for payload, _, _ in older] == [0, 0, 1, 2]


def test_an_overtaken_or_delivered_frame_does_not_come_again() -> None:
    seen = run([("nothing", True), ("nothing", True), ("newest", True), ("older", True)])
    assert seen[2] == (2, 1, 1)
    assert seen[3] == (2, 0, 0)


def test_a_lost_frame_leaves_the_payload() -> None:
    seen = run([("newest", True)] * 3 + [("nothing", True)] * 3)
    assert [payload for payload, _, _ in seen[2:]] == [2, 2, 2, 2]
    assert all(not accepted for _, accepted, _ in seen[3:])


@given(choices)
def test_frames_arrive_in_order_and_the_counter_is_new_iff_the_sender_executed(
    arrivals: list[Choice],
) -> None:
    executed = [done for _, done in arrivals]
    last, seen = 0, run(arrivals)
    for tick, (payload, accepted, new) in enumerate(seen):
        if not accepted:
            assert not new
            assert payload == last
            continue
        assert last < payload <= tick
        assert tick - payload in (0, 1), "one or two steps after it was built"
        assert bool(new) == any(executed[last:payload])
        last = payload


@given(choices, st.integers(1, 3))
def test_the_assumptions_bound_the_frames_that_are_lost(arrivals: list[Choice], most: int) -> None:
    rover = Interpreter(system)
    lost = 0
    for tick, (arrival, executed) in enumerate(arrivals):
        at = {**rover.valuation(), "L.arrives": ARRIVAL.raw(arrival), "executes": int(executed)}
        waits = bool(evaluate(made.waiting, at))
        allowed = evaluate(made.lost_at_most(most), at), evaluate(made.without_loss, at)
        if not allowed[0]:
            assert waits and lost >= most
            return
        rover.step({"L.arrives": at["L.arrives"], "executes": at["executes"]})
        if rover.data["accepted"]:
            lost = 0
        elif waits:
            assert not allowed[1]
            lost += 1
        assert lost <= most, tick
