"""Makers of concrete signals, named as in the document."""

from collections.abc import Iterable

from rovercheck.spec_model.abstraction.board import BoardSignal, Output, units
from rovercheck.spec_model.lang.domain import Num, fixed
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var

MILLISECONDS = fixed(0, (1 << 32) - 1, 1, "ms")


def stamp(name: str, doc: str) -> BoardSignal:
    """A time of the board's clock, 0 at power-up."""
    return BoardSignal(name, MILLISECONDS, 0, doc, 0, MILLISECONDS.high, whole=True, stamp=True)


def measured(var: Var, low: float, high: float, *, whole: bool = False, name: str = "") -> BoardSignal:
    """A number that firmware measures or receives as it comes."""
    return BoardSignal(name or plain(var), var.domain, units(var.domain, var.init), var.doc, low, high, whole)


def discrete(var: Var, name: str = "") -> BoardSignal:
    """What firmware holds as values of the domain: a boolean, an enumeration, a mask, an output."""
    domain, initial = var.domain, units(var.domain, var.init)
    if isinstance(domain.sort, Num):
        resolution = domain.sort.resolution
        low, high = float(domain.low * resolution), float(domain.high * resolution)
        return BoardSignal(name or plain(var), domain, initial, var.doc, low, high, resolution == 1)
    return BoardSignal(name or plain(var), domain, initial, var.doc)


def outputs(produced: Iterable[Var], unless: Expr = FALSE) -> tuple[Output, ...]:
    """Outputs of the firmware with the names and domains of chart variables."""
    return tuple(Output(discrete(var), var, unless) for var in produced)


def plain(var: Var) -> str:
    """The document's name: without the prefix that tells the boards apart where both are modelled."""
    return var.name.rpartition(".")[2]
