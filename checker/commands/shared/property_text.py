"""Properties in structured English, for the terminal and for the reports."""

from collections.abc import Sequence

from rovercheck.checker.commands.shared.output import out, text_width
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.model import Model
from rovercheck.properties.english import HOW_TO_READ, definitions, sentence
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems


def in_english(properties: Sequence[Property], model: Model) -> None:
    """Print each property with its formal sentence, and the formulas it names spelled out."""
    out.print(filled(HOW_TO_READ, text_width()), markup=False)
    for prop in properties:
        out.print("\n" + paragraph(prop, model), markup=False)


def paragraph(prop: Property, model: Model) -> str:
    """One property in lines of 80 columns."""
    head = f"{prop.id} (on {prop.on}; expected: {model.expected(prop.id).verdict})"
    return "\n".join(
        (
            head,
            filled(prop.text, text_width()),
            *map(_indented, formally(prop, model.systems[prop.on])),
        )
    )


def formally(prop: Property, system: System | None = None, lead: str = "Formally: ") -> tuple[str, ...]:
    """What is checked, in a sentence, and a sentence for each formula that it names.

    ``system`` is what it is checked on, by default the rover's system of that name.
    """
    system = system or systems()[prop.on]
    tick_ms, measured = system.tick_ms, system.elapsed is not None
    return f"{lead}{sentence(prop, tick_ms, measured)}", *definitions(prop, tick_ms, measured)


def _indented(text: str) -> str:
    return filled(text, text_width(), "  ", "    ")
