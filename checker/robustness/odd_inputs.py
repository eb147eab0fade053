"""Runs of inputs that no model admits: odd values one by one and together, clocks that jump, long pauses."""

from collections.abc import Iterator, Mapping, Sequence
from math import inf, nan
from random import Random

from rovercheck.checker.adapters.implementation import Value, Values
from rovercheck.checker.robustness.rules import NonsenseRule, is_nonsense
from rovercheck.spec_model.abstraction import Board, BoardSignal
from rovercheck.spec_model.abstraction.signals import units
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW
from rovercheck.spec_model.lang.domain import Bool, Enum

HELD = 4
"""Steps for which an odd value is held, and those at rest before it."""
LENGTH = 30
"""Steps of a random run."""
LATE = CLOCK - 60
"""A clock that wraps three steps later."""
JUMPS: Mapping[str, int] = {
    "stands still": 0,
    "goes back a second": -1000,
    "jumps a minute ahead": 60_000,
    "jumps a day ahead": 86_400_000,
    "jumps half its range ahead": CLOCK // 2,
    "goes back a step": -20,
}

Moment = dict[str, Value]
"""What changes in a step, by name; of ``now_ms`` by how much the clock goes on.  Stamps are absolute."""


def odd_values(signal: BoardSignal) -> tuple[Value, ...]:
    """Values that a wire, a bus or a bug can give, the plainest first."""
    sort = signal.domain.sort
    if signal.stamp:
        return (0, CLOCK - 1, CLOCK // 2, CLOCK // 2 + 1)
    if isinstance(sort, Bool):
        return (2, 255)
    if isinstance(sort, Enum):
        top = signal.domain.high
        return (top + 1, -1, 127, 255, 65535, 2**31 - 1, -(2**31))
    if signal.whole:
        return (int(signal.high) + 1, 255, -1, 65535, 2**31 - 1, -(2**31), nan)
    return (
        nan,
        inf,
        -inf,
        signal.high + 1,
        signal.low - 1,
        1e5,
        -1e5,
        1e7,
        -1e7,
        1e9,
        -1e9,
        3.4e38,
        -3.4e38,
        1e-40,
        -0.0,
    )


def started_inputs(board: Board, moments: Sequence[Moment], start: int = 0) -> list[dict[str, Value]]:
    """The inputs of each step: calm ones with every source in time, but for what the moments change."""
    calm = {**board.at_power_up(), **board.interface.resting}
    stamps = [s.name for s in board.inputs if s.stamp and s.name != NOW]
    now, held, found = start, dict[str, Value](), list[dict[str, Value]]()
    for moment in moments:
        now = (now + int(moment.get(NOW, board.tick_ms))) % CLOCK
        held |= {name: value for name, value in moment.items() if name != NOW}
        found.append({**calm, **dict.fromkeys(stamps, now), **held, NOW: now})
    return found


def odd_runs(
    board: Board, rules: Sequence[NonsenseRule], count: int, seed: int
) -> Iterator[tuple[str, int, tuple[Moment, ...]]]:
    """What is tried, with where the clock begins: each oddity by itself, all of a kind, then at random."""
    for signal in board.inputs:
        if signal.name != NOW:
            for value in odd_values(signal):
                yield f"{signal.name} = {value:g}", 0, _held({signal.name: value})
    for number in range(max(len(odd_values(s)) for s in board.inputs)):
        every = {
            s.name: v[number] for s in board.inputs if s.name != NOW and number < len(v := odd_values(s))
        }
        yield f"odd values {number + 1} of all inputs", 0, _held(every)
    for what, by in JUMPS.items():
        for start in (0, LATE):
            jump = [Moment(), Moment(), *[Moment({NOW: by})] * (HELD if by else 50), *[Moment()] * HELD]
            yield f"the clock {what}", start, tuple(jump)
    for what, end in (("its range", CLOCK), ("half its range", CLOCK // 2), ("16 bits", 1 << 16)):
        yield f"the clock passes the end of {what}", end - 60, (Moment(),) * 10
    for rule in rules:
        for name in rule.inputs:
            signal = next(s for s in board.inputs if s.name == name)
            for value in odd_values(signal):
                if is_nonsense(signal, value):
                    held = (Moment({name: value}), *[Moment()] * (rule.steps + HELD))
                    yield f"{name} = {value:g} held", 0, held
    random = Random(seed)
    for number in range(count):
        start = random.choice((0, LATE, CLOCK // 2 - 60))
        yield f"random run {number + 1}", start, tuple(_random(board, random) for _ in range(LENGTH))


def _held(values: Mapping[str, Value]) -> tuple[Moment, ...]:
    return (*[Moment()] * HELD, Moment(values), *[Moment()] * HELD)


def _random(board: Board, random: Random) -> Moment:
    """A few inputs that change, to values that a model has and to odd ones."""
    moment = Moment()
    if random.random() < 0.1:
        moment[NOW] = random.choice(list(JUMPS.values()))
    for signal in random.sample(list(board.inputs), k=min(len(board.inputs), random.choice((0, 1, 1, 2, 5)))):
        if signal.name == NOW:
            continue
        odd = signal.stamp or random.random() < 0.5
        usual = signal.domain.values
        value = random.choice(odd_values(signal)) if odd else units(signal.domain, random.choice(usual))
        moment[signal.name] = value
    return moment


def told(board: Board, inputs: Sequence[Values]) -> Iterator[tuple[int, Moment]]:
    """The steps in which an input is not at rest, or changes, or the clock does not go on as it should."""
    before = started_inputs(board, [Moment()], 0)[0] | {NOW: int(inputs[0][NOW]) - board.tick_ms}
    usual = started_inputs(board, [Moment()] * len(inputs), int(before[NOW]) % CLOCK)
    known: Moment = {}
    for number, (at, calm) in enumerate(zip(inputs, usual, strict=True), 1):
        stamps = {s.name for s in board.inputs if s.stamp and s.name != NOW}
        odd = {
            name: value
            for name, value in at.items()
            if name != NOW and _differs(value, at[NOW] if name in stamps else calm[name])
        }
        expected = (int(before[NOW]) + board.tick_ms) % CLOCK
        changed = {name: v for name, v in odd.items() if name not in known or _differs(known[name], v)}
        changed |= {name: at[name] for name in known if name not in odd}
        if at[NOW] != expected or (number == 1 and at[NOW] != board.tick_ms):
            changed[NOW] = at[NOW]
        if changed:
            yield number, changed
        known, before = odd, dict(at)


def _differs(one: Value, other: Value) -> bool:
    return repr(one) != repr(other)  # NaN is not equal to itself
