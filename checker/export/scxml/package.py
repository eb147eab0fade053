"""A system of charts as one machine of SCXML that does the same in each step."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from xml.etree.ElementTree import Element, indent, tostring

from rovercheck.checker.export.machine import meaning
from rovercheck.checker.export.scxml.content import ContentWriter, comment, element
from rovercheck.checker.export.scxml.formulas import ScxmlFormulas
from rovercheck.checker.export.scxml.names import TICK, ScxmlNames
from rovercheck.checker.export.scxml.order import ExecutionOrder
from rovercheck.spec_model.lang.chart import Path
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import TRUE, Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.wellformed import check_system

SPACE = "http://www.w3.org/2005/07/scxml"


@dataclass(frozen=True)
class ScxmlMachine:
    """What is written of a system.

    ``names`` are those of its variables, ``states`` the ids of its states by chart and path.  ``notes`` say
    what the file does not hold.
    """

    name: str
    text: str
    names: Mapping[str, str]
    states: Mapping[tuple[str, Path], str]
    notes: tuple[str, ...]

    def save(self, path: FilePath) -> tuple[FilePath, ...]:
        """Write it."""
        path.write_text(self.text, encoding="utf-8")
        return (path,)


def scxml_of(system: System) -> ScxmlMachine:
    """The machine of a system: an event ``tick`` with the inputs as its data is a step.

    Raises ``ModelError`` for what SCXML has not, with its place and a way around it.
    """
    check_system(system)
    for chart in system.charts:
        if isinstance(chart, ProgrammedChart):
            raise ModelError(
                f"{system.name}: {chart.name} was read from a file, and its step is a program that no chart "
                "of SCXML has; write aiger, aag, btor2, smv or promela with --format."
            )
    names = ScxmlNames(system)
    known = [*system.inputs.values(), *system.frozen, *system.written.values()]
    given = {one.name: names.data(one.name) for one in known}
    formulas = ScxmlFormulas(system.charts, names)
    order = ExecutionOrder(system, ContentWriter(formulas))
    temporaries = [one for block in system.blocks for one in block.temporaries]
    top = element("parallel", id=names.whole)
    top.append(order.element())
    top.extend([made for _, made in order.regions])
    data = element("datamodel")
    data.extend([*_data(formulas, [*known, *order.variables, *temporaries])])
    root = element("scxml", xmlns=SPACE, version="1.0", datamodel="ecmascript", name=names.machine)
    root.extend([comment(_header(system)), data, top])
    indent(root)
    text = f"{tostring(root, encoding='unicode')}\n"
    return ScxmlMachine(names.machine, text, given, names.states, tuple(_notes(system)))


def _header(system: System) -> str:
    step = f"A step is an event {TICK} with the inputs as its data, every {system.tick_ms} ms."
    return f"{system.name}: {system.text} {step}"


def _data(formulas: ScxmlFormulas, variables: list[Var]) -> Iterator[Element]:
    """The data, with what their numbers mean, and the members of enumerations that formulas name."""
    for var in {one.name: one for one in variables}.values():
        said = "; ".join(filter(None, (meaning(var), var.doc)))
        if said:
            yield comment(said)
        yield element("data", id=formulas.names.data(var.name), expr=_raw(var))
    for name, raw in formulas.names.constants.items():
        yield element("data", id=name, expr=str(raw))


def _raw(var: Var) -> str:
    return str(var.init) if not isinstance(var.sort, Bool) else str(bool(var.init)).lower()


def _notes(system: System) -> Iterator[str]:
    if system.assumed is not TRUE:
        yield f"what is assumed of its inputs is no part of the file: `{system.assumed}`"


__all__ = ["ScxmlMachine", "scxml_of"]
