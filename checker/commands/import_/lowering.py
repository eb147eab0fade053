"""What of a model of Simulink can be checked: its system, beside the direct interpreter."""

from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.drawn.lower.lowered import RangeNotKnown
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.model.two_readings import compared_readings, rounding_note
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower

SECONDS = 5.0
"""Seconds of the processor for which the two readings of a model are compared."""


@dataclass(frozen=True)
class LoweringReport:
    """The system of a model: how large it is, what is noted, and whether the interpreter agrees with it.

    ``refused`` says why there is none, ``needed`` which domains a person must give first.
    """

    refused: str = ""
    needed: str = ""
    inputs: int = 0
    variables: int = 0
    notes: tuple[str, ...] = ()
    runs: int = 0
    steps: int = 0
    difference: str = ""
    alike: bool = True
    """Whether both readings gave the same; a difference by rounding is a note."""


def lowering_of(path: Path, model: DrawnModel) -> LoweringReport:
    """The report on a model.  Raises ``ModelError`` for a file of domains that cannot be read."""
    said = read_domains(domains_path(path))
    try:
        lowered = lowered_model(model, path.name, said.domains, said.step)
        system = lower(lowered.system)
        found = compared_readings(lowered, SECONDS, said.step)
    except RangeNotKnown as error:
        return LoweringReport(needed=str(error))
    except (NotLowered, ModelError) as error:
        return LoweringReport(refused=str(error).rstrip("."))
    difference = found.difference
    note = "" if difference is None else rounding_note(lowered, difference, said.domains)
    notes = (*lowered.notes, *([note] if note else []))
    return LoweringReport(
        inputs=len(system.inputs), variables=len(system.variables), notes=notes,
        runs=found.runs, steps=found.steps, difference="" if difference is None or note else str(difference),
        alike=difference is None,
    )  # fmt: skip


__all__ = ["LoweringReport", "lowering_of"]
