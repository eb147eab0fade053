"""Phases that suit any board: disturbances at the boundaries, losses, rhythms, ages and waiting."""

from collections.abc import Callable, Sequence

from hypothesis import strategies as st

from rovercheck.checker.compare.environment import SHORT, Blocks, Environment
from rovercheck.checker.compare.stimulus import SILENT, Change, InputBlock, Turning
from rovercheck.checker.compare.values import PARTS
from rovercheck.spec_model.abstraction import Value

Draw = Callable[[st.SearchStrategy], object]
LONGEST_AGE = 250
"""Steps of silence that are drawn at random; longer ones are among the fixed runs."""


def short() -> st.SearchStrategy[int]:
    """Steps that wait for nothing."""
    return st.sampled_from(SHORT)


def steps(env: Environment) -> st.SearchStrategy[int]:
    """Steps of a block: short, or around a timer."""
    return st.one_of(short(), short(), st.sampled_from(env.timers))


def value(env: Environment, name: str) -> st.SearchStrategy[Value]:
    """A value for an input: mostly at or beside a boundary, sometimes anywhere."""
    aimed = st.sampled_from(env.values.aimed[name])
    cells = env.values.cells.get(name)
    if cells is None:
        return aimed
    anywhere = st.builds(
        lambda cell, part: env.values.inside(name, cell, part),
        st.integers(0, len(cells) - 1),
        st.integers(0, PARTS),
    )
    return st.one_of(aimed, aimed, anywhere)


@st.composite
def changes(draw: st.DrawFn, env: Environment, most: int = 4) -> tuple[tuple[str, Change], ...]:
    """New values for a few inputs."""
    names = draw(
        st.lists(st.sampled_from(sorted(env.values.signals)), min_size=1, max_size=most, unique=True)
    )
    return tuple((name, draw(value(env, name))) for name in names)


@st.composite
def disturb(draw: st.DrawFn, env: Environment) -> Blocks:
    """A few inputs change and stay so for a while; perhaps they return."""
    changed = draw(changes(env))
    blocks = [InputBlock(draw(steps(env)), changed)]
    if draw(st.booleans()):
        calm = dict(env.at_rest)
        blocks.append(InputBlock(draw(steps(env)), tuple((name, calm[name]) for name, _ in changed)))
    return blocks


@st.composite
def flicker(draw: st.DrawFn, env: Environment) -> Blocks:
    """Inputs that change in every step or two."""
    count = draw(st.integers(1, 12))
    return [InputBlock(draw(st.sampled_from((1, 1, 1, 2))), draw(changes(env, 2))) for _ in range(count)]


@st.composite
def lose(draw: st.DrawFn, env: Environment) -> Blocks:
    """A source, or two, fall silent for about as long as the charts tolerate, and return; perhaps again."""
    stamps = draw(st.lists(st.sampled_from(env.values.stamps), min_size=1, max_size=2, unique=True))
    lengths = [n for s in stamps for n in env.silences(s)]
    blocks: Blocks = []
    for _ in range(draw(st.integers(1, 3))):
        rhythm = draw(st.sampled_from(env.lags))
        silent = draw(st.one_of(st.sampled_from(lengths), st.sampled_from(lengths), steps(env)))
        blocks += [
            InputBlock(draw(short()), tuple((s, rhythm) for s in stamps)),
            InputBlock(silent, tuple((s, SILENT) for s in stamps)),
        ]
    return [
        *blocks,
        InputBlock(draw(steps(env)), tuple((s, draw(st.sampled_from(env.lags))) for s in stamps)),
    ]


@st.composite
def rhythm(draw: st.DrawFn, env: Environment) -> Blocks:
    """A source is updated in another rhythm, for somewhat more than the ten gaps of a mean."""
    stamp = draw(st.sampled_from(env.values.stamps))
    chosen = draw(st.sampled_from(env.rhythms))
    average = max(1, round(sum(chosen.gaps) / len(chosen.gaps)))
    blocks = [InputBlock(average * draw(st.integers(9, 14)), ((stamp, chosen),))]
    if draw(st.booleans()):
        blocks.append(InputBlock(draw(steps(env)), ((stamp, draw(st.sampled_from(env.lags))),)))
    return blocks


@st.composite
def age(draw: st.DrawFn, env: Environment) -> Blocks:
    """A measurement grows old until the estimate from it crosses a boundary."""
    young = [(b, v) for b, v in env.values.aging if b.steps <= LONGEST_AGE]
    if not young:
        return draw(disturb(env))
    boundary, measured = draw(st.sampled_from(young))
    rhythm = draw(st.sampled_from(env.lags))
    return [
        InputBlock(2, ((boundary.signal, measured), (boundary.source, rhythm))),
        InputBlock(boundary.steps + draw(st.sampled_from((-1, 0, 1, 3))), ((boundary.source, SILENT),)),
        InputBlock(draw(short()), ((boundary.source, rhythm),)),
    ]


@st.composite
def head(draw: st.DrawFn, env: Environment) -> Blocks:
    """The heading goes to, past or away from one that the charts hold."""
    signal, toward = draw(st.sampled_from(env.values.relative))
    rate = draw(st.sampled_from((0.0, 0.0, 0.0, 1.25, -1.25, 7.5, -7.5, 0.125)))
    turning: tuple[tuple[str, Change], ...] = ((signal, Turning(rate)),) if rate else ()
    return [InputBlock(1, ((signal, toward),)), InputBlock(draw(short()), turning)]


@st.composite
def wait(draw: st.DrawFn, env: Environment) -> Blocks:
    """Nothing changes for about as long as a timer."""
    return [InputBlock(draw(st.sampled_from(env.timers)))]


@st.composite
def rest(draw: st.DrawFn, env: Environment) -> Blocks:
    """Everything calm again."""
    return [InputBlock(draw(steps(env)), env.at_rest)]


@st.composite
def combination(draw: st.DrawFn, env: Environment, buttons: tuple[str, str], axes: tuple[str, str]) -> Blocks:
    """The presses that toggle backward mode, at intervals around a timer; sometimes a wrong one."""
    pressed = draw(st.sampled_from(("1122", "1122", "1122", "1122", "112", "1222", "1212", "11122")))
    near = [n for n in env.timers if n <= min(env.timers[-1], 60)]
    blocks = [
        InputBlock(
            draw(st.integers(1, 3)), ((axes[0], 0), (axes[1], 0), (buttons[0], False), (buttons[1], False))
        )
    ]
    for one in pressed:
        name = buttons[int(one) - 1]
        down = draw(st.sampled_from((1, 1, 2, 5)))
        between = draw(st.one_of(short(), short(), short(), st.sampled_from(near)))
        blocks += [InputBlock(down, ((name, True),)), InputBlock(max(1, between - down), ((name, False),))]
    moves = draw(st.booleans())
    return blocks + ([InputBlock(draw(short()), ((axes[1], draw(value(env, axes[1]))),))] if moves else [])


def one_after_another(parts: Sequence[Blocks]) -> Blocks:
    """The blocks of several phases."""
    return [block for part in parts for block in part]
