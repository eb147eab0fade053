"""Faults put into the two stages of a tick on purpose: the comparison with the naive search sees each."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from rovercheck.checker.encode import code_motion, path_statements, paths
from rovercheck.checker.encode.native import body, search
from rovercheck.checker.encode.path_statements import Choose
from rovercheck.checker.system import partition
from rovercheck.spec_model.lang.expr import TRUE, Expr
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.engines.compared import Differs, compare
from tests.engines.test_stages import GROUPS
from tests.faults import PatchSuite


def only_the_first_fine_cell_is_taken(patch: pytest.MonkeyPatch) -> None:
    def finer(*args: Any) -> Choose:
        made = real(*args)
        if made.span is None:
            return replace(made, values=made.values[:1])
        first: Expr = made.span[0]
        return replace(made, span=(first, first + 1))

    real = paths._finer
    patch.setattr(paths, "_finer", finer)


def fine_cells_of_other_coarse_ones_are_taken(patch: pytest.MonkeyPatch) -> None:
    real = paths._finer
    patch.setattr(paths, "_finer", lambda *args: replace(real(*args), span=None))


def the_assumption_is_left_out_of_coarse_cells(patch: pytest.MonkeyPatch) -> None:
    def partitions(system: TransitionSystem) -> Any:
        return partition.partitions(replace(system, assume=TRUE))

    patch.setattr(paths, "partitions", partitions)


def the_valuation_is_lost(patch: pytest.MonkeyPatch) -> None:
    def complete(self: body.Body) -> None:
        self.complete = lambda: None
        real(self)

    real = body.Body._complete
    patch.setattr(body.Body, "_complete", complete)


def the_coarse_choice_is_not_restored(patch: pytest.MonkeyPatch) -> None:
    def saved(program: Any, live: Any) -> Any:
        return {n: tuple(v for v in kept if v.name not in chosen) for n, kept in real(program, live).items()}

    real, chosen = path_statements.saved, {v.name for made in GROUPS for v in made()[0].inputs}
    patch.setattr(search, "saved", saved)


def statements_overtake_others(patch: pytest.MonkeyPatch) -> None:
    """What a goal reads is overwritten before."""
    patch.setattr(code_motion, "_overtaken", lambda *_: iter(()))


def what_is_stored_is_sunk(patch: pytest.MonkeyPatch) -> None:
    """The last statement that what is stored depends on comes too late."""

    def needed(*args: Any) -> Iterator[int]:
        return iter(list(real(*args))[1:])

    real = code_motion._needed
    patch.setattr(code_motion, "_needed", needed)


def differences() -> Iterator[str]:
    """The systems on which the engine and the naive search differ."""
    for made in GROUPS:
        try:
            compare(made)
        except Differs:
            yield made.__name__


class TestStages(PatchSuite):
    FAULTS = (
        only_the_first_fine_cell_is_taken,
        fine_cells_of_other_coarse_ones_are_taken,
        the_assumption_is_left_out_of_coarse_cells,
        the_valuation_is_lost,
        the_coarse_choice_is_not_restored,
        statements_overtake_others,
        what_is_stored_is_sunk,
    )

    def wrong(self) -> Iterator[str]:
        return differences()
