"""The direct interpreter and the lowering of drawn models agree on random charts and diagrams."""

from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.drawn.records import DrawnModel
from tests.drawn.random_calls import random_calls
from tests.drawn.random_charts import random_model
from tests.drawn.random_diagrams import random_diagram
from tests.drawn.two_readings import compared, random_rows
from tests.profiles import full

ROWS = 60
PARTS = 4
"""Seeds are shared out among so many tests, which may run side by side."""
SMALL, LARGE, DIAGRAMS, CALLS = (600, 400, 400, 200) if full() else (40, 8, 40, 8)


def small_model(seed: int, folder: Path) -> DrawnModel:
    """A model with few states."""
    return random_model(seed, folder, small=True)


@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize(
    ("drawn", "count"),
    [(small_model, SMALL), (random_model, LARGE), (random_diagram, DIAGRAMS), (random_calls, CALLS)],
)
def test_both_give_the_same_in_every_row(
    tmp_path: Path, drawn: Callable[[int, Path], DrawnModel], count: int, part: int
) -> None:
    refused = []
    for seed in range(part, count, PARTS):
        found = compared(drawn(seed, tmp_path), random_rows(Random(seed), ROWS), f"seed {seed}")
        assert found.refused or found.fault or found.rows == ROWS
        refused += [f"seed {seed}: {found.refused}"] if found.refused else []
    assert len(refused) * 20 <= count // PARTS, f"more than one in 20 are refused: {refused}"


def test_what_initialization_leaves_may_be_outside_a_range_that_is_learned_later(tmp_path: Path) -> None:
    """Lowering ended with an error about a variable that starts outside its domain."""
    assert compared(small_model(1088, tmp_path), random_rows(Random(1088), ROWS)).rows == ROWS
