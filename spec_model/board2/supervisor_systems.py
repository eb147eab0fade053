"""The systems in which the Board 2 supervisor is checked: charts alone with free inputs, and the whole.

The obstacle charts and the motion charts have systems of their own.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache

from rovercheck.spec_model.board2 import ACTUATION, acquisition, coherence, supervisor
from rovercheck.spec_model.board2.classify import process_masks
from rovercheck.spec_model.board2.failure_check import check_board1
from rovercheck.spec_model.board2.heading import measured
from rovercheck.spec_model.board2.masks import fault_masks_2
from rovercheck.spec_model.board2.monitor_systems import FORGOTTEN, GRID, WITH_FRAMES, watching
from rovercheck.spec_model.board2.monitors import RECORDS, monitor_sources
from rovercheck.spec_model.board2.obstacle_command import obstacle_command, obstacles_driving
from rovercheck.spec_model.board2.obstacles import obstacles_n
from rovercheck.spec_model.board2.obstacles_degraded import obstacles_degraded
from rovercheck.spec_model.board2.safety import safety_state_2
from rovercheck.spec_model.board2.selection import selection
from rovercheck.spec_model.board2.slow2 import exact, forgotten, gaps_of
from rovercheck.spec_model.environment import board2 as env
from rovercheck.spec_model.environment.milliseconds import CONSTANT_PHASE
from rovercheck.spec_model.environment.sonars import scanned
from rovercheck.spec_model.interpretations import woven
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.expr import Expr, all_of, any_of, implies, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import SONARS
from rovercheck.spec_model.signals.board2_supervisor import SourceSignals
from rovercheck.spec_model.signals.rotation import TARGET
from rovercheck.spec_model.system_table import SystemTable

FREE_STATUSES = (
    "What other blocks compute is free in every step, which allows every run of the board and more: what "
    "is proved here holds for the whole board."
)
FEW_VALUES = "Measurements take representative values on each side of every limit."
HEADING = "The heading is a multiple of 2.5 degrees."

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

LINKS = (b2.SUP, b2.RX)

check_links_exact = in_order(
    "check_board1_links",
    env.masks_of_board1,
    *watching(LINKS, exact),
    fault_masks_2,
    process_masks,
    check_board1,
    text="The authorisation of Board 2 behind the masks of Board 1 and the two monitors of Board 1.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES, "The joystick and IMU monitors are left out: the authorisation reads neither."],
)


def _check_links() -> System:
    exact = in_order(
        "check_board1_links_free",
        *watching(LINKS, forgotten),
        check_board1,
        assume=env.heartbeat_travels_in_frames,
        notes=[GRID, WITH_FRAMES, FORGOTTEN, "Requests to switch are free in every step."],
        over=True,
        concrete="check_board1_links",
    )
    free = free_timers(
        woven(exact),
        ["Check_Board1"],
        name="check_board1_links_free",
        text="As check_board1_links; the monitors return at will.",
    )
    return replace(free, concrete="check_board1_links")


FADING = (
    "The first frame comes at 60 ms, then one in every step, each with a new alive counter, until they stop "
    "for good; no mask bit of Board 1 is set."
)
check_fading = replace(
    check_links_exact,
    name="check_board1_fading",
    text="As check_board1_links, with frames that come slowly, then quickly, and then stop.",
    assume=all_of(
        b2.SUP.update == b2.RX.update,
        env.arriving(b2.crit_mask_b1) == 0,
        implies(gaps_of(b2.RX) == 0, b2.RX.update == (b2.RX.age >= 40)),
        implies((gaps_of(b2.RX) > 0) & (b2.RX.age > 0), ~b2.RX.update),
    ),
    notes=(GRID, FADING),
    under=True,
)

check_requests = in_order(
    "check_board1_requests",
    env.masks_of_board1,
    process_masks,
    check_board1,
    text="The authorisation of Board 2 while its links are in order, for any masks of Board 1.",
    assume=(b2.rx_status == "RX_OK") & (b2.b1_sup_status == "SUP_OK"),
    notes=["Both links of Board 1 are OK in every step."],
    under=True,
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
    notes=[
        GRID,
        FEW_VALUES,
        "A sum of more than 6200° by the IMU, or 4000 rpm·s by the wheels (400° and 800 rpm·s in a short "
        "window), grows no more: a silent IMU can leave a window open for so long.",
    ],
)

coherence_any_sums = in_order(
    "coherence_any_sums",
    *coherence.FROM_ANY_SUMS,
    text="The coherence with any sums before each step.",
    notes=[GRID, FEW_VALUES, "What was summed up before is free in every step."],
    over=True,
    concrete="coherence",
)

coherence_comparison = in_order(
    "coherence_comparison",
    *coherence.COMPARISON_ALONE,
    text="How any sums compare in steps that add nothing to them.",
    notes=["The sums are free in every step, and no datum comes."],
    under=True,
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


def _blocked(name: str, rate: int) -> System:
    """The coherence as a whole where the rover turns at ``rate`` degrees per second on resting wheels."""
    wheels_rest = (speed == 0 for speed in b2.wheel_speed_rpm.values())
    return in_order(
        name,
        *coherence.COHERENCE,
        text="Coherence of a rover that the IMU sees turn while its wheels stand still.",
        assume=all_of(b2.IMU.update, b2.gz_dps == rate, ~b2.SUP.update, *wheels_rest),
        notes=[GRID, f"{rate}° each second, an IMU sample in every step."],
        under=True,
    )


coherence_blocked = _blocked("coherence_blocked", 2)
coherence_spinning = _blocked("coherence_spinning", 10)

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

# --- what reaches Board 2 -------------------------------------------------------------------------------

inputs = in_order(
    "inputs_2",
    *env.SNAPSHOTS,
    *env.clocks,
    env.sonar_clock,
    text="The data of the sensors and of Board 1 as Board 2 reads them, and the ages of their stamps.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES, FEW_VALUES, HEADING],
)

# --- the whole ----------------------------------------------------------------------------------------

FREE_HEADING = "The 45 degree test of the heading is a free input, false in the step of entry."


targetAngle = var("B2.targetAngle", TARGET, 0, "heading at which a deviation from an obstacle ends")


def _whole(sources: Sequence[SourceSignals]) -> tuple[Component, ...]:
    charts = supervisor(heading=measured(motion.yaw, targetAngle), sources=sources)
    return (*env.SNAPSHOTS, *env.clocks_of(sources), env.sonar_clock, *charts, ACTUATION)


@cache
def _drawn() -> tuple[Component, ...]:
    """Both the obstacle chart and the motion chart read the one heading."""
    return _whole(b2.SOURCES)


@cache
def _obstacles_and_monitors() -> tuple[Component, ...]:
    charts = selection(
        obstacles_n(),
        obstacles_degraded(),
        deg_mask_b1=b2.degr_mask_b1 != 0,
        crit_mask_b1=b2.crit_mask_b1 != 0,
        autorized=b2.autorized_to_send_command,
    )
    return (*charts, *RECORDS, monitor_sources, fault_masks_2, process_masks, check_board1)


one_scan = Block("OneScan", [when(b2.sonar_update, [assign(scanned, True)])])


def _all_is_well(name: str, text: str, scans: Expr, note: str) -> tuple[str, Callable[[], System]]:
    """Obstacle charts and monitors, with sound Board 1 and sources, and sonar data as told."""
    return name, lambda: in_order(
        name,
        env.sonars,
        env.sonar_clock,
        one_scan,
        env.masks_of_board1,
        *env.clocks,
        *_obstacles_and_monitors(),
        text=text,
        assume=all_of(
            *(s.update for s in b2.SOURCES),
            *(env.arriving(mask) == 0 for mask in (b2.crit_mask_b1, b2.degr_mask_b1)),
            scans,
        ),
        notes=[FEW_VALUES, FREE_HEADING, "All four monitored sources deliver in every step.", note],
        under=True,
    )


sonar_silence = _all_is_well(
    "sonar_silence",
    "Board 2 with sonar data that stop changing.",
    b2.sonar_update == ~scanned,
    "One scan in the first step, and none after it.",
)

sonar_without_echo = _all_is_well(
    "sonar_without_echo",
    "Board 2 with sonars of which none hears an echo.",
    all_of(b2.sonar_update, *(env.arriving(d) == 301 for d in SONARS)),
    "A scan without echo in every step.",
)

ON_ITS_OWN = (
    "No frame of Board 1 ever arrives; joystick and IMU deliver in every step, no sonar hears an echo, the "
    "rover keeps its heading, the stick is pushed forward or not, to the left or not."
)


def _on_its_own() -> System:
    return in_order(
        "board2_on_its_own",
        *_drawn(),
        text="Board 2 with a Board 1 that never sends.",
        assume=all_of(
            ~b2.SUP.update,
            ~b2.RX.update,
            b2.BLE.update,
            b2.IMU.update,
            b2.sonar_update,
            *(env.arriving(d) == 301 for d in SONARS),
            *(env.arriving(still) == 0 for still in (motion.yaw, b2.gz_dps)),
            *(~env.arriving(button) for button in (motion.btn1, motion.btn2)),
            any_of(*(env.arriving(motion.ay_norm) == y for y in (0, 1))),
            any_of(*(env.arriving(motion.bx_norm) == x for x in (0, 1))),
        ),
        notes=[GRID, ON_ITS_OWN],
        under=True,
    )


@cache
def board2() -> System:
    """The whole supervisor of Board 2."""
    return in_order(
        "board2",
        *_drawn(),
        text="The whole supervisor of Board 2 and its motor commands, with exact records of ten gaps.",
        assume=env.heartbeat_travels_in_frames,
        notes=[GRID, WITH_FRAMES, FEW_VALUES, HEADING],
    )


def _board2_ms() -> System:
    text = (
        "The whole supervisor of Board 2; data come any ms before a step, those of a source always as many."
    )
    return replace(
        board2(),
        name="board2_ms",
        components=_whole(b2.SOURCES_MS),
        text=text,
        frozen=tuple(s.phase for s in b2.SOURCES_MS if s.phase is not None),
        notes=(CONSTANT_PHASE, WITH_FRAMES, FEW_VALUES, HEADING),
        place=None,
    )


SYSTEMS = SystemTable(
    masks,
    check_alone,
    check_links_exact,
    ("check_board1_links_free", _check_links),
    check_fading,
    check_requests,
    safety,
    coherence_exact,
    coherence_long,
    coherence_short,
    coherence_blocked,
    coherence_spinning,
    coherence_any_sums,
    coherence_comparison,
    actuation,
    sonar_task,
    joystick_task,
    inputs,
    sonar_silence,
    sonar_without_echo,
    ("board2_on_its_own", _on_its_own),
    ("board2", board2),
    ("board2_ms", _board2_ms),
)
