"""The systems in which the obstacle charts of Board 2 are checked, from one chart alone to both selected."""

from collections.abc import Callable
from functools import cache

from rovercheck.spec_model.board2.heading import headings, measured
from rovercheck.spec_model.board2.obstacles import WINDOWS, obstacles_n
from rovercheck.spec_model.board2.obstacles_degraded import obstacles_degraded
from rovercheck.spec_model.board2.selection import selection
from rovercheck.spec_model.environment.sonars import scan_phase, sonar_scan, turns_as_told
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.chart import Chart, Component
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals.board2 import autorized_prev, crit_mask_b1, d1, d2, d3, deg_mask_b1
from rovercheck.spec_model.system_table import SystemTable

ARBITRARY = "The three distances are arbitrary in every step, on both sides of 70, 100 and 300 cm."
FREE_FLAG = "prevDEG_B1 is arbitrary in every step."
FREE_MASKS = "Non-zero Board 1 masks and the authorisation of the step before are arbitrary in every step."
FREE_HEADING = (
    "The 45 degree test of the heading is a free input, false in the step of entry; for a chart that "
    "meets an arbitrary yaw in every step this adds and loses no run."
)


def _selected(chart: Chart) -> tuple[Component, ...]:
    return selection(
        chart,
        obstacles_degraded(),
        deg_mask_b1=deg_mask_b1,
        crit_mask_b1=crit_mask_b1,
        autorized=autorized_prev,
    )


HEADING_GRID = 15
yaw, targetAngle = headings(HEADING_GRID)
remember_yaw, turning = turns_as_told(yaw, least=HEADING_GRID, most=90)
AS_TOLD = (
    f"During a deviation yaw moves {HEADING_GRID} to 90 degrees a step in the direction of the deviation "
    f"(A06); otherwise it is a multiple of {HEADING_GRID} degrees, arbitrary in every step."
)
SCANNED = (
    "Distances are replaced every third step, in a phase that is constant and unknown (A01, A07).",
    "One distance stands for each of the four sets that the limits 70, 100 and 300 cm divide.",
)
ON_GRID = f"yaw is a multiple of {HEADING_GRID} degrees, arbitrary in every step."


@cache
def as_drawn() -> System:
    """The non-degraded chart alone."""
    return in_order(
        "obstacles_n",
        obstacles_n(),
        text="The non-degraded obstacle chart alone, as drawn.",
        notes=(ARBITRARY, FREE_FLAG, FREE_HEADING),
    )


@cache
def _heading() -> System:
    return in_order(
        "obstacles_heading",
        obstacles_n(measured(yaw, targetAngle)),
        text="The non-degraded obstacle chart alone, with the heading it measures.",
        notes=(ARBITRARY, FREE_FLAG, ON_GRID),
        under=True,
    )


@cache
def _turning() -> System:
    return in_order(
        "obstacles_turning",
        obstacles_n(measured(yaw, targetAngle)),
        remember_yaw,
        text="As obstacles_heading, for a rover that turns as it is told.",
        assume=turning,
        notes=(ARBITRARY, FREE_FLAG, AS_TOLD),
        under=True,
    )


@cache
def _both() -> System:
    return in_order(
        "obstacles",
        *_selected(obstacles_n()),
        text="Both obstacle charts, the selection between them and the command for Board 1.",
        notes=(ARBITRARY, FREE_MASKS, FREE_HEADING),
    )


@cache
def _scan() -> System:
    return in_order(
        "obstacles_scan",
        sonar_scan,
        *_selected(obstacles_n()),
        text="As obstacles, with sonar data that are replaced every 60 ms.",
        frozen=(scan_phase,),
        notes=(*SCANNED, FREE_MASKS, FREE_HEADING),
    )


def _degraded() -> System:
    return in_order(
        "obstacles_d",
        obstacles_degraded(),
        text="The degraded obstacle chart alone.",
        notes=(ARBITRARY,),
    )


TURNS = ("MoveToS1", "MoveToS3")
"""As drawn, these have no timer; where an interpretation gives them one it stays counted (E08)."""

Listed = tuple[str, Callable[[], System]]


def _scene(name: str, scene: str, assume: Expr) -> Listed:
    """The non-degraded chart alone, as drawn, in a scene that leaves few runs: for violations far away."""
    text = "The non-degraded obstacle chart alone, as drawn, in one kind of scene."
    notes = (scene, FREE_FLAG, FREE_HEADING)
    return name, lambda: in_order(name, obstacles_n(), text=text, assume=assume, notes=notes, under=True)


def _counting(*kept: str, name: str, text: str) -> Listed:
    """The non-degraded chart alone; only the timers of the states named are counted."""
    text = f"The non-degraded obstacle chart alone; {text}"
    return name, lambda: free_timers(woven(as_drawn()), (*TURNS, *kept), name=name, text=text)


def _free(exact: str, system: Callable[[], System]) -> Listed:
    name, text = f"{exact}_free", f"As {exact}; every timed stay ends at will."
    return name, lambda: free_timers(woven(system()), TURNS, name=name, text=text)


SYSTEMS = SystemTable(
    ("obstacles_n", as_drawn),
    _counting(name="obstacles_n_free", text="every timed stay ends at will."),
    _counting("MoveToS2", name="obstacles_n_straight", text="only the 0.5 s of MoveToS2 are counted."),
    *(
        _counting(
            window,
            name=f"obstacles_n_{window.removeprefix('timerSonar')}",
            text=f"only the 3 s of {window} are counted.",
        )
        for window in WINDOWS
    ),
    _scene(
        "obstacles_n_left",
        "S2 measures 200 cm and S3 nothing in every step; S1 is arbitrary.",
        (d2 == 200) & (d3 == 301),
    ),
    _scene(
        "obstacles_n_sides",
        "In every step either S2 measures 200 cm, or S1 and S3 do; the others measure nothing.",
        ((d1 == 200) & (d2 == 301) & (d3 == 200)) | ((d1 == 301) & (d2 == 200) & (d3 == 301)),
    ),
    ("obstacles_heading", _heading),
    _free("obstacles_heading", _heading),
    ("obstacles_turning", _turning),
    _free("obstacles_turning", _turning),
    ("obstacles_d", _degraded),
    ("obstacles", _both),
    _free("obstacles", _both),
    ("obstacles_scan", _scan),
    _free("obstacles_scan", _scan),
)
