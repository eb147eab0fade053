"""Link monitors of Board 1 under other interpretations: reception and heartbeat (S37 to S39, S41, S65)."""

from rovercheck.spec_model.interpretations import Alternative, Change, alternative
from rovercheck.spec_model.lang.change import ENTERED, formula, guard_of, guards
from rovercheck.spec_model.lang.chart import Chart, to
from rovercheck.spec_model.lang.edit import begin, operator, swap
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.time import Span, sec
from rovercheck.spec_model.lang.words import duration, named
from rovercheck.spec_model.signals.board1 import heartbeat_slow, rx_age, rx_slow
from rovercheck.spec_model.signals.board1_fine import heartbeat_age_ms, rx_age_ms

HEARTBEAT, RECEPTION = "Monitor_heartbeat", "Monitor_reception"


def to_the_ms(system: System) -> bool:
    """Its frames or heartbeats may come between two steps, so that their ages are counted in ms."""
    return any(age.name in chart.read for chart in system.charts for age in (heartbeat_age_ms, rx_age_ms))


def on_the_steps(system: System) -> bool:
    return not to_the_ms(system)


FRAME_AGES = ((rx_age, on_the_steps), (rx_age_ms, to_the_ms))
"""The age of the last frame, and the systems that have it."""


def of_a_link(chart: str, prefix: str, age: str, slow: Var, hold: Span) -> tuple[Alternative, ...]:
    """What both charts have alike.

    ``hold`` is the time of S38 HOLD-TIME, which the document does not give: that of the monitors of Board 2
    for the same source (E29).
    """
    critical, old, new = f"{prefix}_CRIT", f"{age} > 120 ms", f"{age} >= 120 ms"

    def heard_for_long(drawn: Chart) -> Chart:
        silent = guard_of(drawn, "decide", critical)
        return guards(critical, "decide", lambda _: duration(~silent) > hold)(drawn)

    return (
        alternative("S65", "DEFAULT-OK", "The first step is OK, whatever comes.", chart,
            lambda drawn: begin(drawn, [to(f"{prefix}_OK")])),
        alternative("S38", "MEAN-BASED", "Critical is left once the mean is short enough.", chart,
            guards(critical, "decide", lambda _: ~slow)),
        alternative("S38", "HOLD-TIME", "Critical is left once the link was heard for long enough.", chart,
            heard_for_long),
        alternative("S39", "DEG-WINS", "The degraded row is tested before the critical one.", chart,
            lambda drawn: swap(drawn, "decide", 1, 2)),
        alternative("S37", "GE", "The age is critical from the limit on.", chart,
            formula(old, lambda silent: named(new, operator(Op.GT, Op.GE)(silent)))),
    )  # fmt: skip


def on_a_live_link(age: Var) -> tuple[Change, ...]:
    """The heartbeat is judged while frames arrive only; on a dead link the status is kept."""
    sources = (ENTERED, "Sup_OK", "Sup_DEG", "Sup_CRIT")
    return tuple(guards(source, "decide", lambda g: g & ~(age > 120)) for source in sources)


ALTERNATIVES = (
    *of_a_link(RECEPTION, "Rx", "age_R", rx_slow, 1 * sec),
    *of_a_link(HEARTBEAT, "Sup", "age_S", heartbeat_slow, 2 * sec),
    *(alternative("S41", "MASKED", "A dead link masks the heartbeat.", HEARTBEAT, *on_a_live_link(age),
                  among=among) for age, among in FRAME_AGES),
    *(alternative("S37", "GE", "A link is dead from the limit on.", HEARTBEAT,
                  formula(age > 120, age >= 120), among=among) for age, among in FRAME_AGES),
)  # fmt: skip
