"""Faults put by hand into what joins the boards: link, receiver, relay, motor driver, tasks in fine time."""

from benchmarks.faults.edits import BlockEdit
from rovercheck.spec_model.composition import counters, fine_systems, motors, receiver
from rovercheck.spec_model.lang.edit import constant, instead, operator
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Var, flag, member
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2
from tests.chart_faults.faults import ChartFaults, expressions, forgotten, in_blocks, mistaken, reads, value


def _slot(age: str, what: str) -> Var:
    """A flag of the newest or the older frame on its way."""
    return flag(f"line.{age}.{what}", what)


def _content(age: str) -> Var:
    """The alive counter in that frame."""
    return Var(f"line.{age}.{counters.received.name}", counters.received.domain, 0, "content")


earlier = flag("line.earlier_execution", "the sender executed before it built the two frames")
BOARD1, BOARD2 = member(motors.BOARD, "Board1"), member(motors.BOARD, "Board2")

BLOCKS: dict[str, list[tuple[str, str, BlockEdit]]] = {
    "line.receive": [
        ("the older frame for the newest", "PSY-21b",
         value(counters.received, reads(_content("older"), for_=_content("newest")))),
        ("an overtaken execution is forgotten", "PSY-21b",
         value(counters.says_new, reads(_slot("newest", "executed"), for_=_slot("older", "executed")))),
        ("executions before the frames are forgotten", "PSY-21b",
         value(counters.says_new, instead(earlier.name, lambda _: FALSE))),
        ("a frame without a new counter is a heartbeat", "PSY-21b", value(counters.says_new, lambda _: TRUE)),
        ("the payload is not replaced", "PSY-21b", forgotten(counters.received)),
        ("the memory is not cleared", "PSY-21b", forgotten(earlier)),
    ],
    "line.send": [
        ("an execution is not remembered", "PSY-21b", forgotten(earlier)),
        ("every frame counts as a new execution", "PSY-21b",
         value(_slot("newest", "executed"), lambda _: TRUE)),
        ("an execution stays with its slot", "PSY-21b", forgotten(_slot("older", "executed"))),
        ("the older frame keeps its content", "PSY-21b", forgotten(_content("older"))),
    ],
    "Count": [
        ("a step of two", "PSY-21a", expressions(constant(1, 2))),
        ("modulo 15", "PSY-21a", expressions(constant(16, 15))),
        ("no step", "PSY-21a", forgotten(counters.counter)),
    ],
    "Receiver": [
        ("any checksum", "PSY-16a", value(receiver.accepted, lambda _: TRUE)),
        ("no frame is accepted", "PSY-16c", value(receiver.accepted, lambda _: FALSE)),
        ("no byte is kept of two", "PSY-16c", value(receiver.clean, operator(Op.OR, Op.AND))),
        ("the second byte for the first", "PSY-16c",
         expressions(mistaken(receiver.SYNC2, for_=receiver.SYNC1))),
        ("bytes of other frames count as clean", "PSY-16a",
         value(receiver.clean, instead(receiver.untouched.name, lambda _: TRUE))),
    ],
    "RelayAndDriver": [
        ("the relay is held without power", "PSY-07a",
         value(motors.connected, instead(motors.board1_powered.name, lambda _: TRUE))),
        ("the coil is energised to give the motors away", "PSY-01a",
         value(motors.connected, lambda _: BOARD1)),
        ("the boards exchanged", "PSY-01a", value(motors.connected, mistaken(BOARD2, for_=BOARD1))),
        ("Board 1 is followed behind the open relay", "PSY-01c",
         value(motors.followed, mistaken(BOARD1, for_=BOARD2))),
        ("the stop pin of the other board", "PSY-22b",
         value(motors.motors_zero, mistaken(BOARD2, for_=BOARD1))),
        ("both stop pins instead of one", "PSY-22b", value(motors.motors_zero, operator(Op.OR, Op.AND))),
        ("the last command is kept for good", "PSY-22a", value(motors.silence, constant(1, 0))),
        ("the motors never move", "PSY-22c", forgotten(motors.silence)),
        ("one speed of zero suffices", "PSY-22c", value(motors.commanded_zero, operator(Op.AND, Op.OR))),
    ],
    "B1-B2.receive": [
        ("the payload is not replaced", "PSY-03a", forgotten(b2.b1_requests_switch)),
        ("the payload inverted", "PSY-03a", value(b2.b1_requests_switch, lambda asked: ~asked)),
        ("no frame arrives", "PSY-03a", expressions(instead(fine_systems.line12.busy.name, lambda _: FALSE))),
    ],
    "B1-B2.send": [
        ("the frame keeps its content", "PSY-03a", forgotten(flag("B1-B2.b1_requests_switch", "content"))),
        ("the content inverted", "PSY-03a",
         value(flag("B1-B2.b1_requests_switch", ""), lambda asked: ~asked)),
        ("no frame", "PSY-03a", forgotten(fine_systems.line12.busy)),
    ],
    "Board2_Data.age_ms": [
        ("the age never exceeds 120 ms", "PSY-04a", expressions(constant(121, 120))),
        ("the age stands still", "PSY-04a", expressions(constant(1, 0))),
        ("the age stays as it was", "PSY-04b", forgotten(fine_systems.rx_age_ms)),
    ],
    "CTRL1": [
        ("Board 1 sends whatever the relay", "PSY-01b", expressions(operator(Op.AND, Op.OR))),
        ("it sends while the relay is open", "PSY-01b",
         expressions(instead(b1.give_b2_actuation.name, lambda relay_open: ~relay_open))),
        ("it goes on sending", "PSY-04b",
         value(fine_systems.sends, lambda sends: sends | fine_systems.control1.due)),
    ],
    "Heartbeat": [
        ("120 ms become 140 ms", "PSY-06", expressions(constant(120, 140))),
        ("the age stands still", "PSY-06", forgotten(fine_systems.heartbeat_age)),
        ("an old counter stays fresh", "PSY-06", forgotten(fine_systems.fresh)),
    ],
    "RX1": [
        ("any frame is a heartbeat", "PSY-06",
         value(fine_systems.fresh, lambda fresh: fresh | fine_systems.frame21)),
    ],
}  # fmt: skip

FAULTS = in_blocks(BLOCKS)


class TestComposition(ChartFaults):
    FAULTS = FAULTS
