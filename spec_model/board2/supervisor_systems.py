"""The systems in which the Board 2 supervisor is checked: charts alone with free inputs, and the whole.

The obstacle charts and the motion charts have systems of their own.
"""

from dataclasses import replace

from spec_model import environment_board2 as env
from spec_model.board2 import ACTUATION, SUPERVISOR, acquisition, coherence
from spec_model.board2.classify import process_masks
from spec_model.board2.failure_check import check_board1
from spec_model.board2.masks import fault_masks_2
from spec_model.board2.monitors import RECORDS, monitor_sources, monitors
from spec_model.board2.obstacle_command import obstacle_command, obstacles_driving
from spec_model.board2.obstacles import obstacles_n
from spec_model.board2.obstacles_degraded import obstacles_degraded
from spec_model.board2.safety import safety_state_2
from spec_model.board2.selection import selection
from spec_model.board2.slow2 import forgotten, runs
from spec_model.lang.action import assign
from spec_model.lang.chart import Block, Component, Enabled
from spec_model.lang.domain import enumeration
from spec_model.lang.expr import Var, all_of, flag, implies, ite, var
from spec_model.lang.system import System, in_order
from spec_model.signals import board2_supervisor as b2

GRID = (
    "Time stamps lie on the 20 ms grid: an update carries the time of the step that sees it. "
    "A stamp between two steps lets an age pass a strict limit one step earlier."
)
LONG_OR_SHORT = (
    "Of the gaps only a row of long or of short ones is remembered; a mean of both kinds is free at each "
    "new gap (more runs than the specification)."
)
FORGOTTEN = "The gaps are forgotten: the mean is free at each new gap (more runs than the specification)."
FREE_STATUSES = (
    "What other blocks compute is free in every step, which allows every run of the board and more: what "
    "is proved here holds for the whole board."
)
FEW_VALUES = "Measurements take representative values on each side of every limit."
WITH_FRAMES = "A new alive counter of Board 1 comes with an accepted frame only."

# --- monitors -------------------------------------------------------------------------------------

monitors_exact = in_order(
    "monitors_2",
    *env.clocks,
    *RECORDS,
    monitor_sources,
    text="The monitors of Board 2 with stamps that change at will and the exact mean of ten gaps.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES],
)

_notes, _chart = monitors(runs)
monitors_runs = in_order(
    "monitors_2_rows",
    *env.clocks,
    *_notes,
    _chart,
    text="The monitors of Board 2 with stamps that change at will; means of long and short gaps are open.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES, LONG_OR_SHORT],
    over=True,
    concrete="monitors_2",
)

_free_notes, _free_chart = monitors(forgotten)
monitors_free = in_order(
    "monitors_2_free",
    *env.clocks,
    *_free_notes,
    _free_chart,
    text="The monitors of Board 2 with stamps that change at will, every mean of gaps left open.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES, FORGOTTEN],
    over=True,
    concrete="monitors_2",
)

# --- two boards that share the stamps of one source --------------------------------------------------


def _twin(source: b2.Source) -> b2.Source:
    """The same source of a second Board 2."""

    def renamed(v: Var) -> Var:
        return Var(f"twin.{v.name}", v.domain, v.init, f"{v.doc}, second board")

    return replace(
        source,
        name=f"twin.{source.name}",
        update=renamed(source.update),
        age=renamed(source.age),
        status=renamed(source.status),
        deg=renamed(source.deg),
    )


TWINS = {source.region: _twin(source) for source in b2.SOURCES}
"""The sources of the second board, by region."""

shared = var("shared", enumeration("Shared", list(TWINS)), doc="the source whose stamps both boards see")
_share = Block("Share", [
    assign(TWINS[s.region].update, ite(shared == s.region, s.update, flag(f"other.{s.update.name}")))
    for s in b2.SOURCES
], text="Stamps of one source are the same, those of the others are not")  # fmt: skip
_twin_notes, _twin_chart = monitors(forgotten, tuple(TWINS.values()), "Twin_monitors_2")
_same_answers = Block("ShareMeans", [
    assign(flag(f"twin.{s.name}_mean_slow"), ite(shared == s.region, flag(f"{s.name}_mean_slow"),
                                                flag(f"other.{s.name}_mean_slow")))
    for s in b2.SOURCES
], text="Equal stamps have equal means")  # fmt: skip

monitors_twice = in_order(
    "monitors_2_twice",
    _share,
    _same_answers,
    *env.clocks,
    *_free_notes,
    _free_chart,
    *(env.clock(f"twin.{s.region}.age", s.update, s.age) for s in TWINS.values()),
    *_twin_notes,
    _twin_chart,
    text="The monitors of two Boards 2 that see the same stamps of one source, any of the others.",
    frozen=[shared],
    notes=[GRID, FORGOTTEN, "Equal stamps have equal means; alive counters may change without a frame."],
    over=True,
    concrete="monitors_2_twice_exact",
)

_exact_notes, _exact_chart = monitors(sources=tuple(TWINS.values()), name="Twin_monitors_2")
monitors_twice_exact = in_order(
    "monitors_2_twice_exact",
    _share,
    *env.clocks,
    *RECORDS,
    monitor_sources,
    *(env.clock(f"twin.{s.region}.age", s.update, s.age) for s in TWINS.values()),
    *_exact_notes,
    _exact_chart,
    text="As monitors_2_twice, with the exact means.",
    frozen=[shared],
    notes=[GRID, "Alive counters may change without a frame."],
)

# --- masks, authorisation, safety state, obstacle command ---------------------------------------------

masks = in_order(
    "masks_2",
    fault_masks_2,
    process_masks,
    text="The two fault masks of Board 2 from any statuses, and the classes of both boards' faults.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board2",
)

check_alone = in_order(
    "check_board1",
    process_masks,
    check_board1,
    text="The authorisation of Board 2 for any statuses and any received mask.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board2",
)

_links = (b2.SUP, b2.RX)
_link_notes, _link_chart = monitors(forgotten, _links)
check_links = in_order(
    "check_board1_links",
    *(c for c, s in zip(env.clocks, b2.SOURCES, strict=True) if s in _links),
    *_link_notes,
    _link_chart,
    check_board1,
    text="The authorisation of Board 2 behind the two monitors of Board 1; requests to switch are free.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES, FORGOTTEN],
    over=True,
    concrete="board2",
)

safety = in_order(
    "safety_2",
    process_masks,
    Enabled(b2.autorized_to_send_command, safety_state_2, obstacles_driving, obstacle_command),
    text="Safety state and obstacle command of Board 2 for any masks, distances and authorisation.",
    notes=[FREE_STATUSES, FEW_VALUES],
    over=True,
    concrete="board2",
)

# --- coherence, motor commands ------------------------------------------------------------------------

coherence_exact = in_order(
    "coherence",
    *coherence.COHERENCE,
    text="Coherence of IMU and odometry for any stamps, wheel speeds and yaw rates.",
    notes=[GRID, FEW_VALUES],
)

coherence_long = in_order(
    "coherence_long",
    *coherence.LONG_ALONE,
    text="The long windows of the coherence; what they measure, and the result of the short ones, is free.",
    notes=[GRID, FREE_STATUSES],
    over=True,
    concrete="coherence",
)

coherence_short = in_order(
    "coherence_short",
    *coherence.SHORT_ALONE,
    text="The short windows of the coherence; what they measure, and the result of the long ones, is free.",
    notes=[GRID, FREE_STATUSES],
    over=True,
    concrete="coherence",
)

coherence_blocked = in_order(
    "coherence_blocked",
    *coherence.COHERENCE,
    text="Coherence of a rover that the IMU sees turn while its wheels stand still.",
    assume=all_of(
        b2.IMU.update, b2.gz_dps == 2, ~b2.SUP.update, *(w == 0 for w in b2.wheel_speed_rpm.values())
    ),
    notes=[GRID, "2° each second, an IMU sample in every step."],
    under=True,
)

actuation = in_order(
    "actuation_2",
    ACTUATION,
    text="The motor commands of Board 2 for any references and authorisation.",
    notes=[FREE_STATUSES],
    over=True,
    concrete="board2",
)

# --- acquisition --------------------------------------------------------------------------------------

sonar_task = System(
    "acquisition_sonar",
    acquisition.SONAR,
    text="The sonar task with echoes that come or stay away at will.",
    notes=(
        "Ticks of 1 ms; in each the callbacks of the three channels run in order.",
        "A notification that comes while the task does not wait is lost.",
        FEW_VALUES,
    ),
    tick_ms=1,
)

joystick_task = in_order(
    "acquisition_joystick",
    acquisition.ble_task,
    text="The joystick task with reads that are complete or not at will.",
    notes=["The clock is counted modulo 320 ms; it is only compared with the present.", FEW_VALUES],
)

# --- the whole ----------------------------------------------------------------------------------------

FREE_HEADING = "The 45 degree test of the heading is a free input, false in the step of entry."


def _obstacles_and_monitors() -> tuple[Component, ...]:
    charts = selection(
        obstacles_n(),
        obstacles_degraded(),
        deg_mask_b1=b2.degr_mask_b1 != 0,
        crit_mask_b1=b2.crit_mask_b1 != 0,
        autorized=b2.autorized_to_send_command,
    )
    return (*charts, *RECORDS, monitor_sources, fault_masks_2, process_masks, check_board1)


sonar_silence = in_order(
    "sonar_silence",
    env.sonars,
    env.sonar_clock,
    env.masks_of_board1,
    *env.clocks,
    *_obstacles_and_monitors(),
    text="Board 2 with sonar data that stop changing, all four monitored sources delivering in every step.",
    assume=all_of(
        *(s.update for s in b2.SOURCES),
        *(mask == 0 for mask in map(env.arriving, (b2.crit_mask_b1, b2.degr_mask_b1))),
        implies(b2.sonar_age > 0, ~b2.sonar_update),
    ),
    notes=[FEW_VALUES, FREE_HEADING, "One scan in the first step at the earliest, and none after it."],
    under=True,
)

board2 = in_order(
    "board2",
    *env.SNAPSHOTS,
    *env.clocks,
    env.sonar_clock,
    env.check_stop,
    *SUPERVISOR,
    ACTUATION,
    text="The whole supervisor of Board 2 and its motor commands, with exact records of ten gaps.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES, FEW_VALUES, "The heading is a multiple of 2.5 degrees."],
)

SYSTEMS: tuple[System, ...] = (
    monitors_exact,
    monitors_runs,
    monitors_free,
    monitors_twice,
    monitors_twice_exact,
    masks,
    check_alone,
    check_links,
    safety,
    coherence_exact,
    coherence_long,
    coherence_short,
    coherence_blocked,
    actuation,
    sonar_task,
    joystick_task,
    sonar_silence,
    board2,
)
