"""Wheel monitors of Board 1 under other interpretations (S27 to S32, S65)."""

from rovercheck.spec_model.interpretations import Alternative, alternative
from rovercheck.spec_model.interpretations.links import FRAME_AGES
from rovercheck.spec_model.lang.change import formula, guards, without
from rovercheck.spec_model.lang.chart import to
from rovercheck.spec_model.lang.edit import also, begin, drop
from rovercheck.spec_model.signals.board1 import WHEELS, has_no_feedback, is_motion_consistent


def of_a_wheel(wheel: str) -> tuple[Alternative, ...]:
    chart, flag, consistent = f"Monitor_wheel_{wheel}", has_no_feedback[wheel], is_motion_consistent
    degraded_first = to("Wheel_DEG", when=flag & ~consistent)
    return (
        alternative("S27", "HOLD", "With feedback and inconsistent motion the status is kept.", chart,
            lambda drawn: drop(drawn, "decide", 4)),
        alternative("S27", "OK", "A wheel with feedback is OK.", chart,
            guards("decide", "Wheel_OK", lambda _: ~flag),
            lambda drawn: drop(drawn, "decide", 4)),
        alternative("S28", "SEQ", "A wheel that was OK becomes degraded before it becomes critical.", chart,
            lambda drawn: also(drawn, "Wheel_OK", degraded_first, first=True),
            lambda drawn: begin(drawn, [degraded_first, *drawn.root.default])),
        alternative("S65", "DEFAULT-OK", "The first step is OK, whatever is measured.", chart,
            lambda drawn: begin(drawn, [to("Wheel_OK")])),
        alternative("S30", "LATCH", "Critical is left for OK only.", chart,
            guards("Wheel_CRIT", "decide", lambda _: ~flag & consistent)),
        alternative("S29", "LATCH", "Critical is never left.", chart, without("Wheel_CRIT", "decide")),
        *(alternative("S31", "IGNORE", "On a dead link nothing speaks against the motion.", chart,
            formula(consistent, consistent | (age > 120)), among=among) for age, among in FRAME_AGES),
        alternative("S32", "TRUE=CORRESPONDENCE", "The flag is true with feedback.", chart,
            formula(flag, ~flag)),
    )  # fmt: skip


ALTERNATIVES = tuple(one for wheel in WHEELS for one in of_a_wheel(wheel))
