"""Phases that lead Board 2 into its deep states: driving, obstacles that pass, deviations, half turns."""

from collections.abc import Iterator

from hypothesis import strategies as st

from rovercheck.checker.compare.environment import Blocks, Environment
from rovercheck.checker.compare.phases import (
    combination,
    disturb,
    flicker,
    head,
    lose,
    rest,
    rhythm,
    short,
    steps,
    value,
    wait,
)
from rovercheck.checker.compare.scenes import braking, combinations, recovering, resuming, rotating, turning
from rovercheck.checker.compare.scenes import passing as passing_in_time
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Toward
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.signals.board1 import WHEELS

SONARS = ("d1", "d2", "d3")
NO_ECHO = 301
PAIRS = ((1, 2), (2, 1), (2, 3), (3, 2), (1, 3), (3, 1))
SWITCH, SWITCH_TOO, EMERGENCY = 1 << 2, 1 << 7, 1
"""Bits of the critical mask of Board 1: it misses Board 2, by the frames or the heartbeat; another fault."""
FRAMES, HEARTBEATS, JOYSTICK, IMU = (
    "b1_data_last_valid_ms", "last_valid_b1_ms", "ble_last_valid_ms", "imu_last_valid_ms",
)  # fmt: skip
SPEEDS = tuple(f"wheel_speed_rpm_{w}" for w in WHEELS)
DRIVE: tuple[tuple[str, Change], ...] = (
    ("crit_mask_b1", SWITCH), ("ay_norm", 1), *((d, NO_ECHO) for d in SONARS),
)  # fmt: skip

Changes = tuple[tuple[str, Change], ...]
CAUSES: tuple[Changes, ...] = (
    (("d2", 300),), (("crit_mask_b1", SWITCH | EMERGENCY),), ((JOYSTICK, SILENT),),
)  # fmt: skip
"""Why Board 2 stops while it drives."""
HEALTHY: Changes = (("crit_mask_b1", 0),)
LOSSES: tuple[tuple[Changes, Changes], ...] = (
    (((FRAMES, SILENT), (HEARTBEATS, SILENT)), ((FRAMES, Every()), (HEARTBEATS, Every()))),
    (((HEARTBEATS, SILENT),), ((HEARTBEATS, Every()),)),
)
"""What makes Board 2 drive although it is not asked, and how it ends."""


@st.composite
def passing(draw: st.DrawFn, env: Environment) -> Blocks:
    """An obstacle passes from one sonar to another, within about 3 s, perhaps back."""
    blocks: Blocks = []
    for _ in range(draw(st.integers(1, 3))):
        first, second = draw(st.sampled_from(PAIRS))
        near = draw(st.sampled_from((101, 200, 300)))
        gap = draw(st.one_of(short(), short(), st.sampled_from([n for n in env.timers if 140 < n < 160])))
        then = draw(st.sampled_from((NO_ECHO, NO_ECHO, 301, 100, 71)))
        blocks += [
            InputBlock(draw(short()), ((f"d{first}", near),)),
            InputBlock(gap, ((f"d{first}", then),)),
            InputBlock(draw(short()), ((f"d{second}", draw(st.sampled_from((near, 101, 300, 100)))),)),
        ]
        if draw(st.booleans()):
            blocks.append(InputBlock(draw(short()), ((f"d{second}", NO_ECHO),)))
        blocks += draw(deviate(env))
    return blocks


@st.composite
def deviate(draw: st.DrawFn, env: Environment) -> Blocks:
    """The heading during a deviation, to its end or beside it; sometimes a stop in between."""
    blocks = [InputBlock(draw(st.sampled_from((1, 2, 5, 23, 24, 25, 26))))]
    if draw(st.booleans()):
        stopping = draw(st.sampled_from(SONARS))
        blocks += [
            InputBlock(draw(short()), ((stopping, 70),)),
            InputBlock(draw(short()), ((stopping, NO_ECHO),)),
        ]
    offset = draw(st.sampled_from((0.0, 0.125, -0.125, 1.0, -1.0, 45.0, -45.0, 180.0)))
    return [*blocks, InputBlock(draw(short()), (("yaw", Toward("B2.targetAngle", offset)),))]


@st.composite
def degrade(draw: st.DrawFn, env: Environment) -> Blocks:
    """Board 1 is degraded, or needs Board 2, for a while: another obstacle chart decides."""
    name, bits = draw(
        st.sampled_from((("degr_mask_b1", 1), ("crit_mask_b1", SWITCH), ("crit_mask_b1", EMERGENCY)))
    )
    sonar = draw(st.sampled_from(SONARS))
    return [
        InputBlock(draw(short()), ((name, bits),)),
        InputBlock(draw(short()), ((sonar, draw(value(env, sonar))),)),
        InputBlock(draw(steps(env)), ((name, 0),)),
    ]


@st.composite
def drive(draw: st.DrawFn, env: Environment) -> Blocks:
    """Board 2 drives by the stick; faults of Board 1 and obstacles come and go."""
    blocks = [InputBlock(draw(st.integers(1, 4)), DRIVE)]
    for _ in range(draw(st.integers(1, 4))):
        names = ("ay_norm", "ay_norm", "bx_norm", "d2", "crit_mask_b1", "yaw")
        name = draw(st.sampled_from(names))
        blocks.append(InputBlock(draw(short()), ((name, draw(value(env, name))),)))
    return blocks


@st.composite
def half_turn(draw: st.DrawFn, env: Environment) -> Blocks:
    """The stick pulled back while Board 2 drives, and the heading on its way."""
    begin: tuple[tuple[str, Change], ...] = (*DRIVE, ("ay_norm", 0))
    if draw(st.booleans()):
        begin += (("yaw", draw(value(env, "yaw"))),)
    pulled = draw(st.sampled_from((-1, -0.6, -0.501)))
    blocks = [InputBlock(draw(st.integers(1, 4)), begin), InputBlock(draw(short()), (("ay_norm", pulled),))]
    for _ in range(draw(st.integers(1, 4))):
        blocks += draw(head(env))
        if draw(st.booleans()):
            name = draw(st.sampled_from(("ay_norm", "bx_norm", "crit_mask_b1", "d1")))
            blocks.append(InputBlock(draw(short()), ((name, draw(value(env, name))),)))
    if draw(st.booleans()):
        blocks.append(InputBlock(draw(st.sampled_from((96, 97, 98, 99, 100, 101, 102)))))
    if draw(st.booleans()):
        blocks.append(InputBlock(draw(st.integers(1, 4)), (("yaw", Toward("B2.targetAngle180", 0.0)),)))
        blocks.append(InputBlock(draw(short()), (("ay_norm", draw(value(env, "ay_norm"))),)))
    return blocks


@st.composite
def stop(draw: st.DrawFn, env: Environment) -> Blocks:
    """An emergency stop while Board 2 drives: wheels that come to rest for about 1 s, and go on."""
    cause = draw(st.sampled_from(CAUSES))
    over: dict[str, Change] = {"d2": NO_ECHO, "crit_mask_b1": SWITCH, JOYSTICK: Every()}
    blocks = [
        InputBlock(draw(st.integers(2, 4)), DRIVE),
        InputBlock(draw(st.sampled_from((1, 2, 8, 12))), (*cause, *((w, 60) for w in SPEEDS))),
    ]
    for _ in range(draw(st.integers(1, 3))):
        speeds = tuple((w, draw(st.sampled_from((0, 0, 2.4, 2.499, 2.5)))) for w in SPEEDS)
        blocks.append(InputBlock(draw(steps(env)), speeds))
    return [
        *blocks,
        InputBlock(draw(st.sampled_from((49, 50, 51, 52, 53))), tuple((w, 0) for w in SPEEDS)),
        InputBlock(draw(st.sampled_from((1, 2, 50, 51, 52))), tuple((name, over[name]) for name, _ in cause)),
        InputBlock(draw(short()), DRIVE),
    ]


@st.composite
def take_over(draw: st.DrawFn, env: Environment) -> Blocks:
    """Board 2 is asked to drive, or must, and gives back after about 3 s without a reason."""
    asked = draw(st.sampled_from((SWITCH, SWITCH_TOO)))
    reason, gone = draw(st.sampled_from((((("crit_mask_b1", asked),), HEALTHY), *LOSSES)))
    blocks = [InputBlock(draw(st.sampled_from((1, 2, 8, 9, 12))), reason), *draw(drive(env))[1:]]
    if draw(st.booleans()):
        blocks += [
            InputBlock(draw(st.sampled_from((100, 148, 149, 150))), gone),
            InputBlock(draw(st.integers(1, 9)), reason),
        ]
    blocks.append(InputBlock(draw(short()), (*gone, ("crit_mask_b1", 0))))
    return [*blocks, InputBlock(draw(st.sampled_from((148, 149, 150, 151, 152, 153))))]


@st.composite
def rotate(draw: st.DrawFn, env: Environment) -> Blocks:
    """The rover turns by the gyroscope, by the wheels, or by both, for one window or many."""
    rate = draw(value(env, "gz_dps"))
    left, right = draw(st.sampled_from(((0, 0), (0, 0), (20, 10), (2.5, 0), (60, 0), (0, 60), (7.25, 0))))
    wheels = tuple(zip(SPEEDS, (left, right, left, right), strict=True))
    blocks = [InputBlock(draw(steps(env)), (("gz_dps", rate), *wheels))]
    if draw(st.booleans()):
        stamp = draw(st.sampled_from((HEARTBEATS, IMU)))
        blocks.append(
            InputBlock(draw(st.integers(1, 12)), ((stamp, draw(st.sampled_from((SILENT, *env.rhythms)))),))
        )
        blocks.append(InputBlock(draw(steps(env)), ((stamp, Every()),)))
    return blocks + ([InputBlock(draw(short()), (("gz_dps", 0),))] if draw(st.booleans()) else [])


@st.composite
def toggle(draw: st.DrawFn, env: Environment) -> Blocks:
    """The presses that toggle backward mode while Board 2 drives."""
    return draw(combination(env, ("btn1", "btn2"), ("bx_norm", "ay_norm")))


def scenes(env: Environment) -> Iterator[tuple[str, Blocks, Blocks]]:
    """Sequences in which one step counts."""
    rolling: Changes = tuple((speed, 60) for speed in SPEEDS)
    driving = [InputBlock(4, DRIVE)]
    for scene in combinations(env, ("btn1", "btn2"), ("bx_norm", "ay_norm")):
        yield "presses", driving, scene
    for scene in passing_in_time(env, SONARS, ((1, 2), (2, 1), (2, 3), (3, 2))):
        yield "obstacles that pass", [], scene
    for scene in turning(SONARS):
        yield "turns across north", [], scene
    for scene in rotating(SPEEDS, HEARTBEATS, IMU):
        yield "rotations", [], scene
    for scene in recovering(env):
        yield "recoveries", [], scene
    for scene in braking(DRIVE, rolling, FRAMES, 100):
        yield "braking without the link", driving, scene
    for scene in resuming(DRIVE, HEALTHY, max(env.timers)):
        yield "driving again", driving, scene


BOARD2 = Environment(
    boards()["board2"],
    themes={
        "anything": ([], (disturb, flicker, rest, lose)),
        "obstacles": ([], (passing, passing, degrade, disturb, rest)),
        "driving": ([InputBlock(4, DRIVE)], (drive, drive, half_turn, stop, disturb)),
        "turning": ([InputBlock(4, DRIVE)], (half_turn, half_turn, toggle, drive)),
        "buttons": ([InputBlock(4, DRIVE)], (toggle, toggle, drive, half_turn)),
        "sources": ([], (lose, rhythm, rhythm, disturb, wait)),
        "authority": ([], (take_over, take_over, drive, toggle, stop)),
        "coherence": ([], (rotate, rotate, rotate, lose, rhythm)),
    },
    scenes=scenes,
)
