"""Cells of variables with more values than are listed: as those of a variable whose values are."""

from random import Random

import pytest

from rovercheck import integer, var
from rovercheck.checker.system import cells
from rovercheck.checker.system.partition import partition
from rovercheck.checker.system.wide_cells import TooManyValues
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, any_of, const, ite
from rovercheck.spec_model.lang.words import maximum, minimum, quotient


def condition(random: Random, x: Var, depth: int = 2) -> Expr:
    """A condition about a number, in which it is compared with constants only."""
    if depth and random.random() < 0.6:
        parts = [condition(random, x, depth - 1) for _ in range(2)]
        return random.choice([all_of, any_of])(*parts) if random.random() < 0.7 else ~parts[0]
    limit = random.randint(-300, 300)
    side = random.choice([x, x + 7, 3 - x, x * 3, quotient(x + 400, 7), minimum(x, 50), maximum(x, limit)])
    return random.choice(
        [side < limit, side <= limit, side > limit, side >= limit, side == limit, side != limit, limit < side]
    )


@pytest.mark.parametrize("seed", range(60))
def test_stretches_between_limits_are_the_cells_of_a_list(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    random = Random(seed)
    x = var("x", integer(-200, 200), 0)
    roots = [condition(random, x) for _ in range(3)]
    if random.random() < 0.3:
        roots.append(ite(roots[0], const(1), const(0)))
    listed = partition(x, roots, {"x": x})
    monkeypatch.setattr(cells, "MOST_LISTED", 10)
    wide = partition(x, roots, {"x": x})
    assert wide.cells == listed.cells
    assert [wide.cell_of[v] for v in listed.values] == list(listed.numbers)
    assert list(wide.members(0)) == list(listed.members(0))


def test_a_clock_in_32_bits_has_three_cells() -> None:
    clock = var("clock_ms", integer(0, 2**32 - 1))
    found = partition(clock, [clock < 1000, clock <= 5_000_000], {"clock_ms": clock})
    assert [(one.value, one.size) for one in found.cells] == [
        (0, 1000), (1000, 4_999_001), (5_000_001, 2**32 - 5_000_001)
    ]  # fmt: skip
    assert found.cell_of[4_000_000_000] == 2 and len(found.values) == 2**32


def test_a_clock_that_is_copied_has_no_cells_and_says_so() -> None:
    """It was listed, all 4,294,967,296 values, until the memory was full."""
    clock = var("clock_ms", integer(0, 2**32 - 1))
    with pytest.raises(TooManyValues, match=r"each of 4,294,967,296 values of clock_ms matters"):
        partition(clock, [clock], {"clock_ms": clock})
