"""Short runs that put a part of a board to the test each."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial

from rovercheck.checker.compare.beside import Run, played
from rovercheck.checker.compare.check import RunCache
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.stimulus import InputBlock, Stimulus
from rovercheck.checker.compare.strategy import ENVIRONMENTS

Runs = Callable[[Environment], Iterable[Run]]

SCENES: dict[str, dict[str, list[tuple[int, dict[str, float]]]]] = {
    "board1": {
        "warm, then hot": [(5, {}), (10, {"temperature_degC": 57}), (5, {"temperature_degC": 25}),
                           (210, {"temperature_degC": 62}), (10, {"temperature_degC": 25})],
        "battery": [(5, {}), (10, {"battery_pct": 20}), (260, {"battery_pct": 10})],
        "wheel": [(5, {}), (20, {"hasNoFeedback_FL": True}), (20, {"isMotionConsistent": False}),
                  (5, {"hasNoFeedback_FL": False, "isMotionConsistent": True})],
        "driving": [(5, {}), (170, {"y_norm": 0.8}), (30, {"x_norm": 0.4}), (20, {"y_norm": 0.0})],
    },
    "board2": {
        "obstacle": [(5, {}), (20, {"ay_norm": 0.8}), (20, {"d2": 60}), (60, {"d2": 301})],
        "in charge": [(5, {"crit_mask_b1": 4}), (200, {"ay_norm": 0.8}), (20, {"d1": 50}), (20, {"d1": 301})],
    },
}  # fmt: skip
"""Of each board, how long which inputs are held; the others are at rest."""


def scenes(env: Environment) -> Iterator[Run]:
    """The scenes of a board, as the charts go through them."""
    for name, blocks in SCENES[env.board.name].items():
        (steps, first), *rest = blocks
        held = [InputBlock(steps, (*env.at_rest, *first.items()))]
        held += [InputBlock(n, tuple(changes.items())) for n, changes in rest]
        yield name, played(env.board, env.fields, Stimulus(tuple(held)))


def once(runs: Callable[[Environment], Iterator[Run]]) -> Runs:
    """The same, gone through once for all tests on the boards as drawn; other charts each time."""
    drawn = {name: RunCache(partial(runs, env)) for name, env in ENVIRONMENTS.items()}

    def asked(env: Environment) -> Iterable[Run]:
        name = env.board.name
        return drawn[name] if env is ENVIRONMENTS.get(name) else runs(env)

    return asked
