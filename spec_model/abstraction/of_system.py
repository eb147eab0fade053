"""The board that a system stands for as it is: each input a signal of its own, no stamps but the clock."""

from collections import Counter
from collections.abc import Iterable, Mapping

from rovercheck.spec_model.abstraction.board import Board
from rovercheck.spec_model.abstraction.interface import BoardInterface, InputRow, clock, produced, sample
from rovercheck.spec_model.abstraction.signals import Output, discrete, measured, plain
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System


def board_of(system: System, model: str = "") -> Board:
    """Signals named as the data of the charts; every datum written, and every active state, is an output.

    A number whose domain has gaps is measured: firmware may hold any value from its lowest to its highest.
    Names lose the prefix before the last dot where that leaves them different.  ``model`` is where the system
    was read from.

    Raises ``ModelError`` for a system with parameters that are still to be chosen, with ticks of unlike
    lengths, a machine with delays among them, or with data of the name of the clock.
    """
    if system.frozen:
        chosen = ", ".join(v.name for v in system.frozen)
        raise ModelError(
            f"{system.name} is about every value of {chosen}, and firmware has one of them: write a constant "
            "in its place to compare the system with an implementation."
        )
    if system.elapsed is not None:
        raise ModelError(
            f"{system.name} has ticks of unlike lengths, told by {system.elapsed.name}; an implementation is "
            "executed in steps of one length. Name a system without elapsed=."
        )
    for chart in system.charts:
        if isinstance(chart, ProgrammedChart) and chart.waits:
            raise ModelError(
                f"{chart.name} is a machine with delays: time passes only in its steps without an event. An "
                "implementation is executed in steps of one length; name a system whose steps all take one."
            )
    inputs = tuple(system.inputs.values())
    outputs = _outputs(system)
    names = _names((*inputs, *outputs))
    if NOW in names.values():
        raise ModelError(
            f"{NOW} is the time of the step, which every implementation is given; give the datum of "
            f"{system.name} that has this name another one."
        )
    rows = (clock(), *(_input(var, names[var.name]) for var in inputs))
    made = produced(tuple(Output(discrete(var, names[var.name]), var) for var in outputs))
    return Board(system.name, system, BoardInterface(rows, made), grid_ms=system.tick_ms, model=model)


def _outputs(system: System) -> tuple[Var, ...]:
    written = [v for v in system.written.values() if not v.hidden]
    places = [v for c in system.charts for v in c.locations]
    return tuple({v.name: v for v in (*written, *places)}.values())


def _input(var: Var, name: str) -> InputRow:
    sort, domain = var.domain.sort, var.domain
    if not isinstance(sort, Num) or (domain.dense and sort.resolution == 1):
        return sample(discrete(var, name), var)
    low, high = float(domain.low * sort.resolution), float(domain.high * sort.resolution)
    return sample(measured(var, low, high, whole=sort.resolution == 1, name=name), var)


def _names(variables: Iterable[Var]) -> Mapping[str, str]:
    """Short names, as far as they are no others."""
    short = {v.name: plain(v) for v in variables}
    taken = Counter(short.values())
    return {name: short[name] if taken[short[name]] == 1 else name for name in short}
