"""The values of inputs that are tried when a run is explained."""

from collections.abc import Iterable
from dataclasses import replace

from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.partition import Partition, partitions
from rovercheck.checker.system.wide_cells import MOST_LISTED, TooManyValues
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem


def cells_of(system: TransitionSystem, run: Run) -> dict[str, Partition]:
    """The cells of each input.

    Of an input with so many values that they are not listed, some stand for all: those of the run, those
    beside them, the ends, and one of each cell, where there are cells.
    """
    few = tuple(_few(v, system, run) if len(v.domain) > MOST_LISTED else v for v in system.inputs)
    return partitions(replace(system, inputs=few))


def _few(var: Var, system: TransitionSystem, run: Run) -> Var:
    values = {var.domain.low, var.domain.high, var.init, *_near(tick[var.name] for tick in run.inputs)}
    try:
        alone = replace(system, inputs=(var,))
        values |= {cell.value for cell in partitions(alone)[var.name].cells}
    except TooManyValues:
        pass
    return replace(var, domain=Domain(var.sort, tuple(one for one in values if one in var.domain)))


def _near(values: Iterable[int]) -> Iterable[int]:
    return (one + by for one in set(values) for by in (-1, 0, 1))


__all__ = ["cells_of"]
