"""Runs that are tried before the random ones: every aimed value alone, flags in pairs, timers, old data."""

from collections.abc import Iterator
from itertools import combinations, groupby, pairwise, zip_longest

from rovercheck.checker.compare.aims import formulas
from rovercheck.checker.compare.environment import AROUND, Blocks, Environment
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Stimulus
from rovercheck.spec_model.abstraction import Value
from rovercheck.spec_model.abstraction.signals import computed, plain
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Temporal, When
from rovercheck.spec_model.lang.walk import nodes, variables

CLOSE = 0.0011
"""How far from a moving boundary a value of a fixed run lies at most."""
LATE_MS = (120, 140, 160, 500, 5_000, 70_000)
"""When a first step may come that finds nothing measured or received since power-up."""
LONG = 1500
"""Steps of a fixed run, about."""

Labelled = tuple[str, Stimulus]


def fixed(env: Environment, tried: Environment | None = None) -> Iterator[Labelled]:
    """Every fixed run of a board, with what it is for; what is also in those of ``tried`` is left out."""
    before = frozenset() if tried is None else frozenset(_first_steps(tried))
    yield from (run for run in _first_steps(env) if run not in before)
    known: set[tuple[str, tuple[InputBlock, ...]]] = set()
    if tried is not None:
        known.update((label, tuple(part)) for label, _, parts in _themes(tried) for part in parts)
    for label, begin, parts in _themes(env):
        yield from _in_runs(env, label, begin, [part for part in parts if (label, tuple(part)) not in known])


def _themes(env: Environment) -> Iterator[tuple[str, Blocks, list[Blocks]]]:
    """What runs are for, how they begin, and what is in them."""
    for theme, (begin, _) in env.themes.items():
        if begin or theme == "anything":
            yield f"each value ({theme})", begin, list(_each_value(env))
    yield "flags in pairs", [], list(_pairs(env))
    yield "timers of inputs", [], list(_held(env))
    yield "silences", [], list(_silences(env))
    yield "rhythms", [], list(_rhythms(env))
    yield "old measurements", [], list(_aging(env))
    for label, scenes in groupby(env.scenes(env), key=lambda scene: scene[0]):
        parts = list(scenes)
        yield label, parts[0][1], [part for _, _, part in parts]


def _in_runs(env: Environment, label: str, begin: Blocks, parts: list[Blocks]) -> Iterator[Labelled]:
    """The parts one after another, in as many runs as their length asks for."""
    opening = [InputBlock(2, env.at_rest), *begin]
    blocks = list(opening)
    for part in parts:
        if sum(b.steps for b in blocks) > LONG:
            yield label, Stimulus(tuple(blocks))
            blocks = list(opening)
        blocks += part
    if len(blocks) > len(opening):
        yield label, Stimulus(tuple(blocks))


def _first_steps(env: Environment) -> Iterator[Labelled]:
    """Power-up with the first value of every input, then with the second, and so on; and in silence."""
    names = sorted(env.values.aimed)
    stamps: tuple[tuple[str, Change], ...] = tuple((s, Every()) for s in env.values.stamps)
    calm = dict(env.at_rest)
    for values in zip_longest(*(env.values.aimed[name] for name in names)):
        chosen = tuple((n, calm[n] if v is None else v) for n, v in zip(names, values, strict=True))
        yield "first step", Stimulus((InputBlock(1, (*stamps, *chosen)), InputBlock(2, env.at_rest)))
    for late_ms in LATE_MS:
        yield "late first step", Stimulus((InputBlock(3), InputBlock(3, env.at_rest)), late_ms)
    for flags in combinations(_flags(env), 2):
        yield (
            "first step",
            Stimulus((InputBlock(1, (*env.at_rest, *((f, not calm[f]) for f in flags))), InputBlock(2))),
        )
    for one in env.values.stamps:
        yield (
            "first step",
            Stimulus((InputBlock(30, (*env.at_rest, (one, SILENT))), InputBlock(5, env.at_rest))),
        )
    yield "silence", Stimulus((InputBlock(max(env.timers)), InputBlock(max(env.timers), env.at_rest)))


def _flags(env: Environment) -> list[str]:
    return [name for name, s in env.values.signals.items() if isinstance(s.domain.sort, Bool)]


def _each_value(env: Environment) -> Iterator[Blocks]:
    calm = dict(env.at_rest)
    for name, values in env.values.aimed.items():
        for value in values:
            yield [InputBlock(2, ((name, value),)), InputBlock(1, ((name, calm[name]),))]


def _pairs(env: Environment) -> Iterator[Blocks]:
    """Every change from one combination of two flags to another that differs in one or in both."""
    calm = dict(env.at_rest)
    for a, b in combinations(_flags(env), 2):
        tour = ((1, 0), (1, 1), (0, 1), (1, 0), (0, 1), (0, 0), (1, 1), (0, 0))
        at_rest = (bool(calm[a]), bool(calm[b]))
        yield [InputBlock(1, ((a, bool(x) != at_rest[0]), (b, bool(y) != at_rest[1]))) for x, y in tour]


def _silences(env: Environment) -> Iterator[Blocks]:
    """Each source silent for just short of, at and beyond each age, stamped at various ms before a step."""
    for stamp in env.values.stamps:
        for rhythm in env.lags:
            for length in env.silences(stamp):
                yield [InputBlock(2, ((stamp, rhythm),)), InputBlock(length, ((stamp, SILENT),))]
        yield [InputBlock(3, ((stamp, Every()),))]


def _rhythms(env: Environment) -> Iterator[Blocks]:
    """Each source in each rhythm, for a little more than ten gaps, and in every step again."""
    for stamp in env.values.stamps:
        if env.values.aims.silences.get(stamp, (99,))[0] < 20:  # whose mean gap is watched
            for rhythm in env.rhythms:
                gaps = max(len(rhythm.gaps), 11)
                yield [InputBlock(gaps * sum(rhythm.gaps) // len(rhythm.gaps) + 1, ((stamp, rhythm),))]
                yield [InputBlock(11, ((stamp, Every()),))]


def _aging(env: Environment) -> Iterator[Blocks]:
    """Measurements beside each boundary that moves, until it has moved past them."""
    for boundary, value in env.values.aging:
        if abs(float(value) - float(boundary.value)) <= CLOSE:
            fresh: tuple[tuple[str, Change], ...] = ((boundary.signal, value), (boundary.source, Every()))
            yield [
                InputBlock(2, fresh),
                InputBlock(boundary.steps + 1, ((boundary.source, SILENT),)),
                InputBlock(1, fresh),
            ]


def _held(env: Environment) -> Iterator[Blocks]:
    """Conditions on inputs that must last: for a little less than long enough, long enough, and more."""
    calm = dict(env.at_rest)
    for word in nodes(*formulas(env.board.system)):
        if isinstance(word, Temporal) and word.when is When.HELD and word.arg is not None and word.span:
            ticks = word.span.ticks(env.board.system.step_ms)
            names = {plain(v) for v in variables(word.arg).values()} & env.values.signals.keys()
            for name in sorted(names):
                for value in _at_the_ends(env, name, word):
                    for more in AROUND:
                        yield [
                            InputBlock(ticks + more, ((name, value),)),
                            InputBlock(2, ((name, calm[name]),)),
                        ]
                for value in _beside_the_limits(env, name, word):
                    yield [
                        InputBlock(ticks + max(AROUND), ((name, value),)),
                        InputBlock(2, ((name, calm[name]),)),
                    ]


def _at_the_ends(env: Environment, name: str, word: Temporal) -> list[Value]:
    """The first and the last aimed value of an input for which the condition holds."""
    found = [value for value, holds in _aimed(env, name, word) if holds]
    return [found[0], found[-1]] if found else []


def _beside_the_limits(env: Environment, name: str, word: Temporal) -> list[Value]:
    """The aimed values of an input next to one another of which the condition holds for one only."""
    found: dict[Value, None] = {}
    for (one, first), (two, second) in pairwise(_aimed(env, name, word)):
        if first != second:
            found |= {one: None, two: None}
    return list(found)


def _aimed(env: Environment, name: str, word: Temporal) -> list[tuple[Value, bool]]:
    """The aimed values of an input, and whether the condition holds for each."""
    assert word.arg is not None
    found: list[tuple[Value, bool]] = []
    for value in env.values.aimed[name]:
        read = env.board.reader().step(env.board.at_power_up() | {name: value})
        if variables(word.arg).keys() <= read.keys():
            found.append((value, bool(evaluate(word.arg, computed(read)))))
    return found
