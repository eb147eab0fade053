"""Obstacle chart of Board 2, degraded state: stop for any obstacle within 3 m [spec §3.4.2, Fig 28]."""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import Var, any_of
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board2 import B2DecDegraded, d1, d2, d3, number

# Drawn as check_emergency_stop(sonars), as in the other chart, but with the limit of the text: 300 cm.
check300 = named("check_emergency_stop(sonars)", any_of(d1 <= 300, d2 <= 300, d3 <= 300))


def obstacles_degraded(name: str = "ObstaclesDegraded", decision: Var = B2DecDegraded) -> Chart:
    """An instance of the chart that writes ``decision``.

    Board 2 holds two: one beside the non-degraded chart, executed in every step, and one in the
    subsystem that executes only while Board 2 drives.  ``number``: E04.
    """
    return Chart(name, [
        State("check_sonars_for_stopping", entry=[assign(decision, number(5))], transitions=[
            to("check_sonars_for_moving_again", when=check300),
        ]),
        State("check_sonars_for_moving_again", entry=[assign(decision, number(6))], transitions=[
            to("check_sonars_for_stopping", when=~check300),
        ]),
    ], default="check_sonars_for_stopping",
       text="Obstacles in the degraded state [spec §3.4.2, Fig 28]")  # fmt: skip


drawn_d = obstacles_degraded()
"""The chart beside the non-degraded one."""
