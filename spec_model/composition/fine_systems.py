"""Chains through both boards in milliseconds, phases arbitrary: from a cause on one board to its effect.

Each system holds the tasks of one chain of hops and the charts that decide on the way.  What the rest of
the rover does is left to free inputs, so each has every run of the rover and more: what is proved here
holds of the rover.  Where a whole board stands between two hops, a *contract* takes its place: a block
that may do anything that the properties named in its text, proved of the board, allow.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from rovercheck.spec_model.board1.relay import relay
from rovercheck.spec_model.board2.actuation import actuation
from rovercheck.spec_model.board2.failure_check import check_board1
from rovercheck.spec_model.composition.contracts import Contract
from rovercheck.spec_model.composition.tasks import (
    MILLISECOND,
    RoverTask,
    clock,
    control_task,
    line,
    phases,
    task,
)
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, const, flag, implies, ite, member, var
from rovercheck.spec_model.lang.system import TICK_MS, System, in_order
from rovercheck.spec_model.lang.words import minimum
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.common import RX_STATUS, SUP_STATUS
from rovercheck.spec_model.system_table import SystemTable

PHASES = "Every task executes in its period of 20 ms (control: 10 ms) at a constant phase nobody knows."
FREE = (
    "Statuses that nothing in the chain computes are arbitrary in every execution (more runs); contracts "
    "are proved for the default interpretations."
)
NO_LOSS = "No frame of the chain is lost or corrupted (A02); a frame takes one millisecond."


def _chain(
    name: str, text: str, *components: Component, tasks: Sequence[RoverTask], assume: Expr = TRUE,
    notes: Sequence[str] = (),
) -> tuple[str, Callable[[], System]]:  # fmt: skip
    """A chain whose timers of seconds may end at will: only its milliseconds are counted."""

    def built() -> System:
        exact = in_order(
            name,
            clock,
            *components,
            text=text,
            frozen=phases(*tasks),
            assume=assume,
            notes=[PHASES, FREE, *notes],
            over=True,
            tick_ms=MILLISECOND,
            step_ms=TICK_MS,
        )
        return replace(free_timers(woven(exact), name=name, text=text), concrete="")

    return name, built


sup1, sup2 = task("SUP1", at_zero=True), task("SUP2")
tx1, tx2 = task("TX1"), task("TX2")
control1 = control_task("CTRL1")

# --- Board 1 opens the relay, Board 2 is authorised ------------------------------------------------------

asks_switch = flag("asks_switch", "bit 2 or bit 7 of the critical mask of Board 1")
line12 = line("B1-B2", [(asks_switch, b2.b1_requests_switch)], tx1.due, flag("B2.frame", "a frame came"))
ask = Block(
    "AskSwitch",
    [assign(asks_switch, (b1.rx_status == "RX_CRITICAL") | (b1.b2_sup_status == "SUP_CRITICAL"))],
    text="Bits 2 and 7 of critical_mask, which follow the two statuses (PB1-10).",
)

handover_fine = _chain(
    "handover_fine",
    "From the relay of Board 1 over the link to the authorisation and the motor commands of Board 2.",
    line12.receive,
    Enabled(sup1.due, ask, relay, name="Board 1"),
    Enabled(sup2.due, check_board1, actuation, name="Board 2"),
    line12.send,
    tasks=(tx1, sup2),
    assume=implies(line12.busy, line12.intact),
    notes=[NO_LOSS],
)

# --- Board 1 hears no more of Board 2 ----------------------------------------------------------------------

frame_accepted = flag("frame_accepted", "a frame of Board 2 is accepted in this millisecond")
rx_age_ms = var("rx_age_ms", fixed(0, 121, 1, "ms"), 0, "now_ms - Board2_Data.data_last_valid_ms")
sends = flag("B1.sends", "the control task of Board 1 sends a motor command in this millisecond")

reception_age = Block(
    "Board2_Data.age_ms",
    [
        when(
            frame_accepted,
            [assign(rx_age_ms, 0)],
            [assign(rx_age_ms, minimum(rx_age_ms + const(1, "ms"), const(121, "ms")))],
        )
    ],
    text="Time since the last accepted frame, in ms; 121 ms stand for all that is more.",
)
some_status = var("rx_not_critical", RX_STATUS, doc="free: OK or degraded, by the mean interval")
reception_status = Block(
    "ReceptionStatus",
    [
        assign(
            b1.rx_status,
            ite(
                rx_age_ms > 120,
                member(RX_STATUS, "RX_CRITICAL"),
                ite(some_status == "RX_OK", member(RX_STATUS, "RX_OK"), member(RX_STATUS, "RX_DEGRADED")),
            ),
        )
    ],
    text="Contract of the reception monitor: critical iff older than 120 ms (PB1-32a).",
)
control = Block(
    "CTRL1",
    [assign(sends, control1.due & ~b1.give_b2_actuation)],
    text="Every 10 ms a motor command, if the latest snapshot says that Board 1 actuates.",
)

silence_fine = _chain(
    "silence_fine",
    "The reception of Board 1, its relay and its control task, frames arriving at any millisecond.",
    reception_age,
    Enabled(sup1.due, reception_status, relay, name="Board 1"),
    control,
    tasks=(control1,),
)

# --- the supervisor of Board 2 stops, its transmit task goes on -----------------------------------

sup2_stops = flag("SUP2_stops", "from this millisecond on the supervisor of Board 2 executes no more")
sup2_stopped = flag("SUP2_stopped", "the supervisor of Board 2 has stopped")
sup2_executes = flag("SUP2_executes", "the supervisor of Board 2 executes in this millisecond")
counted = flag("alive_counted", "the alive counter rose since the last frame was built")
fresh = flag("alive_received", "the received alive counter differs from the remembered one")
frame21 = flag("B1.frame", "a frame of Board 2 is accepted in this millisecond")
in_frame = flag("alive_in_frame", "the counter in the arriving frame differs from that of the frame before")
line21 = line("B2-B1", [(counted, in_frame)], tx2.due, frame21)
some_sup_status = var("b2_sup_not_critical", SUP_STATUS, doc="free: OK or degraded, by the mean interval")
heartbeat_age = var("heartbeat_age_ms", fixed(0, 140, 20, "ms"), 0, "now_ms - last_valid_b2_ms at the step")

execute = Block(
    "SUP2",
    [
        assign(sup2_stopped, sup2_stopped | sup2_stops),
        assign(sup2_executes, sup2.due & ~sup2_stopped),
        when(sup2_executes, [assign(counted, True)]),
    ],
    text="The alive counter rises at every execution [spec Table 2].",
)
built = Block("TX2", [when(tx2.due, [assign(counted, False)])], text="The frame carries the counter.")
note = Block(
    "RX1",
    [assign(fresh, fresh | (frame21 & in_frame))],
    text="What the payload says until the supervisor looks.",
)
compare = Block(
    "Heartbeat",
    [
        when(
            fresh,
            [assign(heartbeat_age, 0)],
            [assign(heartbeat_age, minimum(heartbeat_age + const(20, "ms"), const(140, "ms")))],
        ),
        assign(fresh, False),
        assign(
            b1.b2_sup_status,
            ite(
                heartbeat_age > 120,
                member(SUP_STATUS, "SUP_CRITICAL"),
                ite(
                    some_sup_status == "SUP_OK",
                    member(SUP_STATUS, "SUP_OK"),
                    member(SUP_STATUS, "SUP_DEGRADED"),
                ),
            ),
        ),
    ],
    text="Contract of the heartbeat monitor: critical iff older than 120 ms (PB1-32b).",
)

heartbeat_fine = _chain(
    "heartbeat_fine",
    "The alive counter of Board 2 over the link to the heartbeat age and the relay of Board 1.",
    line21.receive,
    note,
    execute,
    Enabled(sup1.due, compare, relay, name="Board 1"),
    line21.send,
    built,
    tasks=(sup2, tx2),
    assume=implies(line21.busy, line21.intact),
    notes=[NO_LOSS],
)

# --- an obstacle stops Board 1 --------------------------------------------------------------------

near = flag("near", "the snapshot holds an obstacle that Board 2 stops for, such as one at 70 cm")
stop_decided = flag("estop_decided", "the command in the snapshot of Board 2 is CMD_ESTOP")
stop_received = flag("estop_received", "the received command is CMD_ESTOP")
other_stop = flag("other_stop", "free: whether Board 2 commands CMD_ESTOP otherwise")
forward = flag(
    "forward", "Board 1 actuates, the received y_norm is positive and no 180 degree rotation is active"
)
v_positive = flag("v_positive", "v_ref of Board 1 is positive")
any_reference = flag("any_reference", "free: whether v_ref is positive otherwise")
actuates = flag("actuates", "Board 1 actuates")
any_nonzero = flag("any_nonzero", "free: whether the references are not zero otherwise")
nonzero = flag("references_nonzero", "a reference of the receiving board is not zero")
line_cmd = line(
    "B2-B1.command", [(stop_decided, stop_received)], tx2.due, flag("B1.command_frame", "a frame came")
)

obstacle_contract = Contract(
    "SUP2.contract",
    "Contract: what Board 2 stops for, in two successive steps, gives CMD_ESTOP in the second.",
    near, stop_decided, other_stop, before=near,
)  # fmt: skip
motion_contract = Contract(
    "SUP1.contract",
    "Contract: CMD_ESTOP received, the user forward in two successive steps, gives v_ref <= 0 in the second.",
    stop_received & forward, ~v_positive, any_reference, before=forward,
)  # fmt: skip
obeying_contract = Contract(
    "SUP1.obeys",
    "Contract: CMD_ESTOP received and the user forward in two successive steps give zero references in the "
    "second.",
    stop_received & forward, ~nonzero, any_nonzero, before=stop_received & forward,
)  # fmt: skip
stopping_contract = Contract(
    "SUP1.stops",
    "Contract, with stop-unconditional: CMD_ESTOP received gives zero references in the same step.",
    stop_received & actuates, ~nonzero, any_nonzero, first=False,
)  # fmt: skip


def _stopping(name: str, text: str, motion: Contract) -> tuple[str, Callable[[], System]]:
    """From a sonar snapshot over Board 2 and the link to what Board 1 does."""
    return _chain(
        name,
        text,
        line_cmd.receive,
        Enabled(sup1.due, motion.block, name="Board 1"),
        Enabled(sup2.due, obstacle_contract.block, name="Board 2"),
        line_cmd.send,
        tasks=(sup2, tx2),
        assume=implies(line_cmd.busy, line_cmd.intact),
        notes=[NO_LOSS],
    )


stop_fine = _stopping(
    "stop_fine",
    "From a sonar snapshot over Board 2, the link and Board 1 to the linear reference.",
    motion_contract,
)
stop_obeyed_fine = _stopping(
    "stop_obeyed_fine",
    "From a sonar snapshot over Board 2, the link and Board 1 to both references, the user forward.",
    obeying_contract,
)
stop_unconditional_fine = _stopping(
    "stop_unconditional_fine",
    "From a sonar snapshot over Board 2, the link and Board 1, repaired, to both references.",
    stopping_contract,
)

# --- a critical fault of one board stops the other -------------------------------------------------


def _board(supervisor: RoverTask) -> str:
    """The board whose supervisor this is."""
    return "Board 1" if supervisor is sup1 else "Board 2"


def _critical(
    name: str, text: str, sender: RoverTask, transmit: RoverTask, receiver: RoverTask
) -> tuple[str, Callable[[], System]]:
    """From a critical cause in a step of the sender to the references of the receiver."""
    link = line(f"{name}.line", [(critical_sent, critical_received)], transmit.due, critical_frame)
    return _chain(
        name,
        text,
        link.receive,
        Enabled(receiver.due, obey.block, name=_board(receiver)),
        Enabled(sender.due, say.block, name=_board(sender)),
        link.send,
        tasks=(sender, transmit, receiver),
        assume=implies(link.busy, link.intact),
        notes=[NO_LOSS],
    )


critical = flag("critical", "a component of the sending board that stops the rover is critical")
critical_sent = flag("critical_sent", "so says the mask in the snapshot of the sender")
critical_received = flag("critical_received", "so says the mask last received")
critical_frame = flag("critical_frame", "a frame came")
other_critical = flag("other_critical", "free: whether the mask says so otherwise")

say = Contract(
    "Sender.contract",
    "Contract: the bit of a critical component is set in each step but the first in which it is critical.",
    critical, critical_sent, other_critical, first=False,
)  # fmt: skip
obey = Contract(
    "Receiver.contract",
    "Contract: a critical cause received in two successive steps gives zero references in the second.",
    critical_received, ~nonzero, any_nonzero, before=critical_received,
)  # fmt: skip

critical_2_to_1 = _critical(
    "critical_2_to_1",
    "From a critical joystick link or IMU of Board 2 to the references of Board 1, which drives.",
    sup2,
    tx2,
    sup1,
)
critical_1_to_2 = _critical(
    "critical_1_to_2",
    "From a critical component of Board 1 to the references of Board 2, which drives.",
    sup1,
    tx1,
    sup2,
)

SYSTEMS = SystemTable(
    handover_fine,
    silence_fine,
    heartbeat_fine,
    stop_fine,
    stop_obeyed_fine,
    stop_unconditional_fine,
    critical_2_to_1,
    critical_1_to_2,
)

CONTRACTS: Mapping[str, tuple[Contract, ...]] = {
    "stop_fine": (obstacle_contract, motion_contract),
    "stop_obeyed_fine": (obstacle_contract, obeying_contract),
    "stop_unconditional_fine": (obstacle_contract, stopping_contract),
    "critical_2_to_1": (say, obey),
    "critical_1_to_2": (say, obey),
}
"""By the chain's name, what it takes for granted of the two boards; a promise names who proves it."""

WIRES: Mapping[str, tuple[Var, Var]] = {
    "handover_fine": (asks_switch, b2.b1_requests_switch),
    "stop_fine": (stop_decided, stop_received),
    "stop_obeyed_fine": (stop_decided, stop_received),
    "stop_unconditional_fine": (stop_decided, stop_received),
    "critical_2_to_1": (critical_sent, critical_received),
    "critical_1_to_2": (critical_sent, critical_received),
}
"""By the chain's name, what its frame carries to what."""
