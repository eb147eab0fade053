"""Phases that lead Board 1 into its deep states: manoeuvres, half turns, stops, hand-over and return."""

from collections.abc import Iterator

from hypothesis import strategies as st

from rovercheck.checker.compare.environment import Blocks, Environment
from rovercheck.checker.compare.phases import (
    age,
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
from rovercheck.checker.compare.scenes import combinations
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Toward
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.signals.board1 import WHEELS
from rovercheck.spec_model.signals.common import COMMAND

COMMANDS = tuple(COMMAND.values)
NORMAL, ESTOP = COMMAND.raw("CMD_NORMAL"), COMMAND.raw("CMD_ESTOP")
FRAMES, HEARTBEATS = "b2_data_last_valid_ms", "last_valid_b2_ms"
FORWARD: tuple[tuple[str, Change], ...] = (("y_norm", 1), ("cmd", NORMAL))


@st.composite
def manoeuvre(draw: st.DrawFn, env: Environment) -> Blocks:
    """A command, or several, while the stick is pushed forward."""
    blocks = [InputBlock(draw(short()), (("cmd", NORMAL), ("y_norm", draw(st.sampled_from((1, 0.5, 0.8))))))]
    for _ in range(draw(st.integers(1, 4))):
        changed: list[tuple[str, Change]] = [("cmd", draw(st.sampled_from(COMMANDS)))]
        if draw(st.booleans()):
            changed.append(("y_norm", draw(value(env, "y_norm"))))
        if draw(st.booleans()):
            changed.append(("x_norm", draw(value(env, "x_norm"))))
        blocks.append(InputBlock(draw(short()), tuple(changed)))
    return blocks


@st.composite
def half_turn(draw: st.DrawFn, env: Environment) -> Blocks:
    """The stick pulled back, the heading on its way, perhaps to the end, and the stick again."""
    begin: tuple[tuple[str, Change], ...] = (
        ("y_norm", draw(st.sampled_from((-1, -0.6, -0.501)))),
        ("cmd", NORMAL),
    )
    if draw(st.booleans()):
        begin += (("current_yaw", draw(value(env, "current_yaw"))),)
    blocks = [
        InputBlock(draw(st.integers(1, 3)), (("y_norm", 0), ("cmd", NORMAL))),
        InputBlock(draw(short()), begin),
    ]
    for _ in range(draw(st.integers(1, 4))):
        blocks += draw(head(env))
        if draw(st.booleans()):
            name = draw(st.sampled_from(("y_norm", "x_norm", "cmd", "crit_mask_b2", "degr_mask_b2")))
            blocks.append(InputBlock(draw(short()), ((name, draw(value(env, name))),)))
    if draw(st.booleans()):
        blocks.append(InputBlock(draw(st.integers(1, 4)), (("current_yaw", Toward("targetAngle180", 0.0)),)))
        blocks.append(InputBlock(draw(short()), (("y_norm", draw(value(env, "y_norm"))),)))
    return blocks


CAUSES: tuple[tuple[tuple[str, Change], ...], ...] = (
    (("cmd", ESTOP),),
    (("crit_mask_b2", 1),),
    (("crit_mask_b2", 2),),
    (("hasNoFeedback_FL", True), ("isMotionConsistent", False)),
)


@st.composite
def stop(draw: st.DrawFn, env: Environment) -> Blocks:
    """An emergency stop from motion: wheels that come to rest, for about as long as it takes, and go on."""
    cause = draw(st.sampled_from(CAUSES))
    calm = dict(env.at_rest)
    wheels = [f"wheel_speed_rpm_{w}" for w in WHEELS]
    rolling = draw(st.sampled_from((0, 2.5, 2.499, 60)))
    blocks = [
        InputBlock(draw(st.integers(1, 4)), FORWARD),
        InputBlock(draw(short()), (*cause, *((w, rolling) for w in wheels))),
    ]
    for _ in range(draw(st.integers(1, 3))):
        speeds = tuple((w, draw(st.sampled_from((0, 0, 2.4, 2.499, 2.5)))) for w in wheels)
        blocks.append(InputBlock(draw(steps(env)), speeds))
        if draw(st.booleans()):
            blocks.append(InputBlock(draw(short()), ((draw(st.sampled_from(wheels)), 2.5),)))
    over = tuple((name, calm[name]) for name, _ in cause)
    return [
        *blocks,
        InputBlock(draw(st.sampled_from((50, 51, 52, 53))), tuple((w, 0) for w in wheels)),
        InputBlock(draw(short()), over if draw(st.booleans()) else ()),
        InputBlock(draw(short()), over),
    ]


@st.composite
def hand_over(draw: st.DrawFn, env: Environment) -> Blocks:
    """Board 2 falls silent, Board 1 gives the motors away, and takes them back after about 3 s without."""
    stamps = draw(st.sampled_from(((FRAMES, HEARTBEATS), (HEARTBEATS,), (FRAMES,))))
    silent, back = tuple((s, SILENT) for s in stamps), tuple((s, Every()) for s in stamps)
    blocks = [InputBlock(draw(st.sampled_from((7, 8, 9, 20))), silent)]
    if draw(st.booleans()):
        blocks.append(InputBlock(draw(st.sampled_from((10, 140, 149, 150))), back))
        blocks.append(InputBlock(draw(st.sampled_from((6, 7, 8))), silent))
    blocks.append(InputBlock(draw(short()), (*back, *draw(manoeuvre(env))[-1].changes)))
    blocks.append(InputBlock(draw(st.sampled_from((144, 148, 149, 150, 151, 152, 153)))))
    return [*blocks, InputBlock(draw(short()), FORWARD)]


@st.composite
def toggle(draw: st.DrawFn, env: Environment) -> Blocks:
    """The presses that toggle backward mode."""
    return draw(combination(env, ("btn1", "btn2"), ("x_norm", "y_norm")))


def scenes(env: Environment) -> Iterator[tuple[str, Blocks, Blocks]]:
    """Sequences in which one step counts."""
    for scene in combinations(env, ("btn1", "btn2"), ("x_norm", "y_norm")):
        yield "presses", [], scene


BOARD1 = Environment(
    boards()["board1"],
    themes={
        "anything": ([], (disturb, flicker, rest, lose)),
        "driving": ([InputBlock(2, FORWARD)], (manoeuvre, manoeuvre, half_turn, disturb, flicker, rest)),
        "turning": ([], (half_turn, half_turn, toggle, disturb)),
        "buttons": ([], (toggle, toggle, manoeuvre, half_turn)),
        "stopping": ([InputBlock(2, FORWARD)], (stop, stop, half_turn, disturb, rest)),
        "sources": ([], (lose, rhythm, rhythm, age, disturb, wait)),
        "relay": ([InputBlock(2, FORWARD)], (hand_over, hand_over, toggle, half_turn, stop, disturb)),
        "sensors": ([], (disturb, age, wait, lose)),
    },
    means=(2,),
    scenes=scenes,
)
"""The mean of ten intervals, 40 ms, is computed by the abstraction and stands in no chart."""
