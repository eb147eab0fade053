"""Random stimuli of a board, as Hypothesis draws and shrinks them."""

from collections.abc import Mapping
from dataclasses import replace

from hypothesis import strategies as st

from rovercheck.checker.compare.environment import Blocks, Environment
from rovercheck.checker.compare.phases import (
    changes,
    disturb,
    flicker,
    one_after_another,
    rest,
    short,
    steps,
    wait,
)
from rovercheck.checker.compare.phases1 import BOARD1
from rovercheck.checker.compare.phases2 import BOARD2
from rovercheck.checker.compare.stimulus import InputBlock, Stimulus
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.stamps import CLOCK

ENVIRONMENTS: Mapping[str, Environment] = {"board1": BOARD1, "board2": BOARD2}
"""The environment of each board of the rover, by its name."""
PHASES = 24
"""Phases of a stimulus at most; six on average."""
LONGEST = 1500
"""Steps of a stimulus; what is beyond is cut off."""


def environment(board: Board) -> Environment:
    """The environment of a board of the rover, also with changed charts; of a model what suits any charts."""
    if not board.model:
        known = ENVIRONMENTS[board.name]
        return known if known.board is board else replace(known, board=board)
    return Environment(board, themes={"anything": ([], (disturb, disturb, flicker, wait, rest))})


@st.composite
def openings(draw: st.DrawFn, env: Environment) -> tuple[int, Blocks]:
    """Time and blocks from power-up to calm: at once, after silence, or just before the clock wraps."""
    calm = InputBlock(draw(short()), env.at_rest)
    kind = draw(st.sampled_from(("calm", "calm", "calm", "calm", "silent", "some", "wrap")))
    if kind == "silent":
        return env.board.tick_ms, [InputBlock(draw(steps(env))), calm]
    if kind == "some":
        known = env.values.stamps
        stamps = draw(st.lists(st.sampled_from(known), unique=True)) if known else []
        first = (*draw(changes(env)), *((stamp, draw(st.sampled_from(env.lags))) for stamp in stamps))
        return env.board.tick_ms, [InputBlock(draw(short()), first), InputBlock(draw(short())), calm]
    if kind == "wrap":  # every stamp is new in the first step, or it would be as old as the clock
        return CLOCK - env.board.tick_ms * draw(st.integers(1, 60)), [calm]
    return env.board.tick_ms, [calm]


@st.composite
def stimuli(draw: st.DrawFn, env: Environment) -> Stimulus:
    """A stimulus: a theme, an opening, and phases of that theme."""
    begin, phases = env.themes[draw(st.sampled_from(sorted(env.themes)))]
    start_ms, opening = draw(openings(env))
    drawn = draw(st.lists(st.one_of([phase(env) for phase in phases]), min_size=1, max_size=PHASES))
    return Stimulus(tuple(cut([*opening, *begin, *one_after_another(drawn)])), start_ms)


def cut(blocks: Blocks) -> Blocks:
    """The first blocks, up to the longest stimulus."""
    kept: Blocks = []
    left = LONGEST
    for block in blocks:
        if left <= 0:
            break
        kept.append(InputBlock(min(block.steps, left), block.changes))
        left -= block.steps
    return kept
