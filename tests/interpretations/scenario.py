"""Running a scenario that tells interpretations apart: blocks of time and what is given meanwhile.

Time 0 is the first step of the scenario, in ms; what is not given stays nominal.
"""

from collections.abc import Iterator, Mapping, Sequence

from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import TICK_MS, System

Given = Mapping[str, bool | float | str]
Blocks = Sequence[tuple[int, Given]]

BOARD1: Given = {
    "temp_update": True, "temp_reading": 25, "batt_update": True, "batt_reading": 80,
    "rx_update": True, "heartbeat_update": True, "frame_isMotionConsistent": True,
    "frame_cmd": "CMD_NORMAL", "frame_y_norm": 1, "frame_x_norm": 0,
}  # fmt: skip
"""Board 1 when nothing is wrong; an input that is not listed takes its initial value."""

WARM_UP = 400
"""Time of nominal inputs before a scenario: ten intervals of every record, and some more."""


def shown(
    system: System, blocks: Blocks, watched: Sequence[str], nominal: Given = BOARD1
) -> Iterator[dict[str, str]]:
    """The watched signals after each step, as shown to people.

    An input that the system has not is ignored: a scenario runs on a chart alone and on the board.
    """
    rover = Interpreter(system)
    for length, given in blocks:
        values = {**nominal, **given}
        inputs = {n: v.domain.raw(values[n]) if n in values else v.init for n, v in system.inputs.items()}
        for _ in range(length // TICK_MS):
            rover.step(inputs)
            yield {n: system.written[n].domain.show(rover.data[n]) for n in watched}


def histories(
    system: System,
    blocks: Blocks,
    watched: Sequence[str],
    *,
    nominal: Given = BOARD1,
    warm_up: int = WARM_UP,
) -> list[str]:
    """All values of each watched signal from time 0 on, with the ms at which each begins: ``0 500 1``."""
    before: Blocks = [(warm_up, {})] if warm_up else []
    steps = list(shown(system, [*before, *blocks], watched, nominal))[warm_up // TICK_MS :]
    return [_history([step[name] for step in steps]) for name in watched]


def _history(values: Sequence[str]) -> str:
    words = values[:1] if values else []
    changes = [f"{n * TICK_MS} {v}" for n, v in enumerate(values) if n and v != values[n - 1]]
    return " ".join([*words, *changes])
