"""What the frames of both directions carry, field by field, and what their arrival tells [spec §1.2, §2.4].

A frame is sent in every step in which the sender has power, and is seen one step later, two steps later, or
never; one that is seen in its first step is not seen again.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from rovercheck.properties.forms import Property, always, reachable
from rovercheck.properties.past import ago
from rovercheck.spec_model.composition.motors import board1_powered, runs_1, runs_2
from rovercheck.spec_model.composition.systems import arrives12, arrives21, lost12, lost21
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of, implies, ite
from rovercheck.spec_model.lang.words import minimum, once, previous
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2 as obstacles
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2

ON = "links"
MANY = 8
"""Lost frames in a row are counted up to this number, at which every age exceeds its limit."""
Fields = Mapping[str, tuple[Var, Var]]

FROM_2: Fields = {
    "command": (b1.cmd, obstacles.command),
    "yaw": (b1.current_yaw, motion.yaw),
    "x_norm": (b1.x_norm, motion.bx_norm),
    "y_norm": (b1.y_norm, motion.ay_norm),
    "isMotionConsistent": (b1.is_motion_consistent, b2.is_motion_consistent),
    "critical mask": (b1.crit_mask_b2, b2.critical_mask),
    "degraded mask": (b1.degr_mask_b2, b2.degraded_mask),
    "btn1": (b1.btn1, motion.btn1),
    "btn2": (b1.btn2, motion.btn2),
}
"""What Board 1 receives, and what it is on Board 2 [spec §2.2]; x_norm as the joystick says it."""
FROM_1: Fields = {
    "critical mask": (b2.crit_mask_b1, b1.critical_mask),
    "degraded mask": (b2.degr_mask_b1, b1.degraded_mask),
    **{
        f"speed {wheel}": (b2.wheel_speed_rpm[wheel], b1.wheel_speed_rpm[wheel])
        for wheel in ("FL", "FR", "RL", "RR")
    },
}


def _suffix(field: str) -> str:
    return field.replace(" ", "-")


# --- the fields -----------------------------------------------------------------------------------


def _carried(
    id: str, sender: str, fields: Fields, accepted: Var, arrives: Var, covers: Mapping[str, list[str]]
) -> Iterator[Property]:
    """Each field is as it was a step ago, or two; without a frame it stays."""
    for field, (received, sent) in fields.items():
        yield always(
            f"{id}-{_suffix(field)}",
            f"A frame of {sender} brings {field} as it was when the frame was sent, and nothing else changes "
            f"what the other board has of it.",
            that=received == ite(
                accepted, ite(arrives == "newest", ago(sent, 1), ago(sent, 2)), previous(received)
            ),
            covers=covers.get(field, covers[""]), on=ON, from_tick=3,
            interpretations=["E31"] if field == "x_norm" else [],
        )  # fmt: skip


(
    PSY_23a_command, PSY_23a_yaw, PSY_23a_x, PSY_23a_y, PSY_23a_consistent,
    PSY_23a_critical, PSY_23a_degraded, PSY_23a_btn1, PSY_23a_btn2,
) = _carried(
    "PSY-23a", "Board 2", FROM_2, b1.rx_update, arrives21,
    {"": ["B2-COM-04"], **{f"{kind} mask": ["B2-COM-04", "B2-FLT-02"] for kind in ("critical", "degraded")}},
)  # fmt: skip
(
    PSY_23b_critical, PSY_23b_degraded, PSY_23b_FL, PSY_23b_FR, PSY_23b_RL, PSY_23b_RR,
) = _carried("PSY-23b", "Board 1", FROM_1, b2.rx_update, arrives12, {"": ["B1-MASK-01"]})  # fmt: skip


def _replaced() -> Iterator[Property]:
    for field, (received, _) in FROM_2.items():
        frame = replace(received, name=f"frame_{received.name}")
        yield always(
            f"PSY-23c-{_suffix(field)}",
            f"An accepted frame replaces {field}, and nothing else changes what Board 1 has of it.",
            that=received == ite(b1.rx_update, frame, previous(received)),
            covers=["B2-COM-04"], on="board1", from_tick=2, interpretations=["S31"],
        )  # fmt: skip


(
    PSY_23c_command, PSY_23c_yaw, PSY_23c_x, PSY_23c_y, PSY_23c_consistent,
    PSY_23c_critical, PSY_23c_degraded, PSY_23c_btn1, PSY_23c_btn2,
) = _replaced()  # fmt: skip

# --- before the first frame ------------------------------------------------------------------------


def _unheard(id: str, fields: Fields, accepted: Var, otherwise: Mapping[str, Expr]) -> Iterator[Property]:
    """What a board takes for true of one that it has not heard yet: 0 where nothing else is said."""
    for field, (received, _) in fields.items():
        begins = otherwise.get(field)
        yield always(
            f"{id}-{_suffix(field)}", f"Until the first frame is accepted, {field} is as on power-up.",
            that=implies(~once(accepted), received == 0 if begins is None else begins),
            covers=["B2-COM-04"], on=ON,
        )  # fmt: skip


(
    PSY_26_B1_command, PSY_26_B1_yaw, PSY_26_B1_x, PSY_26_B1_y, PSY_26_B1_consistent,
    PSY_26_B1_critical, PSY_26_B1_degraded, PSY_26_B1_btn1, PSY_26_B1_btn2,
) = _unheard(
    "PSY-26-B1", FROM_2, b1.rx_update,
    {
        "command": b1.cmd == "CMD_NORMAL",
        "isMotionConsistent": b1.is_motion_consistent,
        "btn1": ~b1.btn1,
        "btn2": ~b1.btn2,
    },
)  # fmt: skip
(
    PSY_26_B2_critical, PSY_26_B2_degraded, PSY_26_B2_FL, PSY_26_B2_FR, PSY_26_B2_RL, PSY_26_B2_RR,
) = _unheard("PSY-26-B2", FROM_1, b2.rx_update, {})  # fmt: skip

# --- arrival and the alive counter ----------------------------------------------------------------


def _arrival(id: str, sender: str, accepted: Var, arrives: Var, sends: Expr, covers: list[str]) -> Property:
    older_is_new = ago(sends, 2) & ~previous(accepted & (arrives == "newest"))
    return always(
        id,
        f"A frame of {sender} is accepted if and only if one arrives that was sent in the step before, or in "
        f"the step before that and was not seen since.",
        that=accepted == ((arrives == "newest") & previous(sends) | (arrives == "older") & older_is_new),
        covers=covers, on=ON, from_tick=3,
    )  # fmt: skip


def _begins(id: str, sender: str, accepted: Var, arrives: Var, sends: Expr, covers: list[str]) -> Property:
    sent = ite(arrives == "newest", previous(once(sends)), ago(once(sends), 2))
    return always(
        id, f"No frame of {sender} is accepted before one was sent.",
        that=implies(accepted, sent), covers=covers, on=ON,
    )  # fmt: skip


def _in_a_row(
    id: str, sender: str, accepted: Var, arrives: Var, sends: Expr, lost: Var, covers: list[str]
) -> Property:
    none_yet = ~ago(once(sends), 2)
    unseen = ago(sends, 2) & ~previous(accepted & (arrives == "newest"))
    return always(
        id,
        f"Frames of {sender} lost in a row are counted, up to eight: one not seen for two steps adds to "
        f"the count, an accepted one ends it.",
        that=lost
        == ite(accepted | none_yet, 0, ite(unseen, minimum(previous(lost) + 1, MANY), previous(lost))),
        covers=covers, on=ON,
    )  # fmt: skip


def _counter(
    id: str, sender: str, accepted: Var, arrives: Var, executed: Expr, changed: Var, covers: list[str]
) -> Iterator[Property]:
    """What a changed alive counter means; the frame that was built last holds all executions before it."""
    newest, older = accepted & (arrives == "newest"), accepted & (arrives == "older")
    yield always(
        f"PSY-25-{id}a", f"Without an accepted frame of {sender} its alive counter does not change.",
        that=implies(changed, accepted), covers=covers, on=ON,
    )  # fmt: skip
    yield always(
        f"PSY-25-{id}b",
        f"An accepted frame that was built just after the supervisor of {sender} executed has another count.",
        that=implies(newest & ago(executed, 1) | older & ago(executed, 2), changed),
        covers=covers, on=ON, from_tick=3,
    )  # fmt: skip
    yield always(
        f"PSY-25-{id}c",
        f"Of two frames of {sender} accepted in a row the second has the same count if the supervisor did "
        f"not execute in the two steps before.",
        that=implies(accepted & previous(accepted) & ~ago(executed, 1) & ~ago(executed, 2), ~changed),
        covers=covers, on=ON, from_tick=3,
    )  # fmt: skip
    lost = ~ago(accepted, 1) & ~ago(accepted, 2) & ~ago(accepted, 3)
    yield always(
        f"PSY-25-{id}d",
        f"After three steps without a frame of {sender} an accepted one has another count if the supervisor "
        f"executed before them.",
        that=implies(accepted & lost & ago(executed, 4), changed), covers=covers, on=ON, from_tick=5,
    )  # fmt: skip
    yield always(
        f"PSY-25-{id}e",
        f"A frame of {sender} that comes three steps after another, without an execution of the supervisor "
        f"in those steps, has the same count.",
        that=implies(
            accepted & ago(newest, 3)
            & ~ago(executed, 1) & ~ago(executed, 2) & ~ago(executed, 3),
            ~changed,
        ),
        covers=covers, on=ON, from_tick=4,
    )  # fmt: skip
    newest_before, older_before = previous(newest), previous(older)
    yield always(
        f"PSY-25-{id}f",
        f"Of two frames of {sender} accepted in successive steps the second has another count exactly if the "
        f"supervisor executed after the first was built.",
        that=all_of(
            implies(newest & newest_before, changed == ago(executed, 1)),
            implies(newest & older_before, changed == (ago(executed, 1) | ago(executed, 2))),
            implies(older & older_before, changed == ago(executed, 2)),
        ),
        covers=covers, on=ON, from_tick=4,
    )  # fmt: skip
    yield always(
        f"PSY-25-{id}g",
        f"The first accepted frame of {sender} has another count than 0 exactly if the supervisor executed "
        f"before it was built.",
        that=implies(
            accepted & ~previous(once(accepted)),
            changed == ite(arrives == "newest", previous(once(executed)), ago(once(executed), 2)),
        ),
        covers=covers, on=ON,
    )  # fmt: skip
    yield reachable(
        f"REACH-SAME-COUNT-{id}", f"A frame of {sender} is accepted whose count has not changed.",
        that=accepted & ~changed, covers=covers, on=ON,
    )  # fmt: skip


PSY_24_B1 = _arrival("PSY-24-B1", "Board 1", b2.rx_update, arrives12, board1_powered, ["B2-COM-05"])
PSY_24_B2 = _arrival("PSY-24-B2", "Board 2", b1.rx_update, arrives21, TRUE, ["B2-COM-05", "B1-RX-01"])
PSY_24b_B1 = _begins("PSY-24b-B1", "Board 1", b2.rx_update, arrives12, board1_powered, ["B2-COM-05"])
PSY_24b_B2 = _begins("PSY-24b-B2", "Board 2", b1.rx_update, arrives21, TRUE, ["B2-COM-05", "B1-RX-01"])
PSY_24c_B1 = _in_a_row(
    "PSY-24c-B1", "Board 1", b2.rx_update, arrives12, board1_powered, lost12, ["B2-COM-05"]
)
PSY_24c_B2 = _in_a_row("PSY-24c-B2", "Board 2", b1.rx_update, arrives21, TRUE, lost21, ["B2-COM-05"])
(
    PSY_25_B1a, PSY_25_B1b, PSY_25_B1c, PSY_25_B1d, PSY_25_B1e, PSY_25_B1f, PSY_25_B1g, REACH_SAME_COUNT_B1,
) = _counter("B1", "Board 1", b2.rx_update, arrives12, runs_1, b2.sup_update, ["B2-FLT-01"])  # fmt: skip
(
    PSY_25_B2a, PSY_25_B2b, PSY_25_B2c, PSY_25_B2d, PSY_25_B2e, PSY_25_B2f, PSY_25_B2g, REACH_SAME_COUNT_B2,
) = _counter(
    "B2", "Board 2", b1.rx_update, arrives21, runs_2, b1.heartbeat_update, ["B2-COM-06", "B1-SUP-01"]
)  # fmt: skip
