"""A record of each kind of the language, other values of its fields, and what of them is no part of a key."""

import importlib
import inspect
import pkgutil
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from fractions import Fraction
from typing import Any

from rovercheck.properties import forms
from rovercheck.properties.forms import Always, Property
from rovercheck.spec_model import lang
from rovercheck.spec_model.lang.action import Assign, If, Send, assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, Transition, to
from rovercheck.spec_model.lang.domain import Bool, Domain, Num, Unit, boolean, integer
from rovercheck.spec_model.lang.domain import Enum as EnumSort
from rovercheck.spec_model.lang.expr import Apply, Const, Named, Temporal, Var, When, flag, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.stateflow.message import label_text
from rovercheck.spec_model.lang.system import Assumption, System, in_order
from rovercheck.spec_model.lang.time import Span, ticks
from rovercheck.spec_model.lang.words import after

GO, PUSH, COUNT = flag("go"), flag("push"), var("count", integer(0, 5))


def lamp(text: str = "", doc: str = "", note: str = "") -> System:
    """The same lamp, with other words for readers."""
    go = Var("go", boolean, 0, doc)
    chart = Chart(
        "Lamp",
        [
            State("Off", transitions=[to("On", when=go)]),
            State("On", transitions=[to("Off", when=after(3 * ticks))]),
        ],
        default="Off",
        text=text,
    )
    counting = Block("Counting", [assign(COUNT, COUNT)], text=text)
    return in_order("lamp", chart, counting, text=text, notes=[note] if note else [])


LEFT_OUT = {
    "Transition.place": "where it is written",
    "State.place": "where it is written",
    "System.place": "where it is written",
    "Property.place": "where it is written",
    "System.text": "for readers",
    "System.notes": "for readers: what is said beside a proof is taken from the system as it is now",
    "Assumption.text": "for readers",
    "Var.doc": "for readers",
    "Property.text": "for readers",
    "Property.covers": "for readers: what is told is taken from the property as it is now",
    "Property.interpretations": "which charts are chosen; these enter themselves",
    "Property.costly": "when it is asked, not what",
    "Property.area": "for readers",
    "Property.about": "the system that it is about enters itself",
}
"""The fields of records that do not enter a key, and why no verdict depends on them."""
NO_PART = {
    "TransitionSystem": "made of a System, never written",
    "FlowWay": "made when a system is lowered",
    "_Word": "made when a system is lowered",
    "FiredTransition": "what the interpreter says of a run",
    "_Route": "what the interpreter follows",
    "_Count": "what the interpreter counts",
    "ActionPlace": "where something is written",
    "Leg": "what is looked at when charts are judged",
    "_Site": "what is looked at when charts are judged",
    "Place": "where something is written",
    "ChartFigure": "where something is drawn",
    "StepProgram": "enters with its chart, whole",
    "ActionCall": "how shared actions are shown: the actions themselves enter",
    "Array": "variables under one name: a System holds the variables",
    "Extent": "a part of a label's text",
    "Function": "formulas or actions under one name: a System holds what they make",
    "LabelNames": "what a label may name, while it is read",
    "LabelText": "a label while it is read",
    "StateParts": "a label while it is read",
    "TransitionParts": "a label while it is read",
    "duration": "half a formula: a Temporal once it is compared",
}
"""Records of the language that are no part of a question."""


def records() -> dict[str, type]:
    """Every record of the language of charts and of properties."""
    found: dict[str, type] = {}
    modules = [forms]
    for entry in pkgutil.walk_packages(lang.__path__, f"{lang.__name__}."):
        modules.append(importlib.import_module(entry.name))
    for module in modules:
        for name, kind in inspect.getmembers(module, inspect.isclass):
            if is_dataclass(kind) and kind.__module__ == module.__name__:
                found[name] = kind
    return found


SORT, NUMBERS = Bool(), Num(Fraction(1), Unit())
SAMPLES: dict[type, tuple[Any, dict[str, Any]]] = {
    Const: (Const(1, SORT), {"value": 0, "sort": NUMBERS}),
    Var: (GO, {"name": "stop", "domain": integer(0, 1), "init": 1, "hidden": True}),
    Apply: (
        Apply(Op.AND, (GO, PUSH), SORT),
        {"op": Op.OR, "args": (PUSH, GO), "sort": NUMBERS},
    ),
    Named: (Named("n", GO), {"name": "m", "body": PUSH}),
    Temporal: (
        Temporal(When.HELD, GO, Span(Fraction(2), "tick"), False),
        {"when": When.PREVIOUS, "arg": PUSH, "span": None, "strict": True},
    ),
    Span: (Span(Fraction(2), "tick"), {"amount": Fraction(3), "unit": "s"}),
    Unit: (Unit((("m", 1),)), {"powers": (("m", 2),)}),
    EnumSort: (EnumSort("E", (("a", 0), ("b", 1))), {"name": "F", "members": (("a", 0), ("c", 1))}),
    Num: (NUMBERS, {"resolution": Fraction(1, 2), "unit": Unit((("m", 1),))}),
    Domain: (integer(0, 3), {"sort": Num(Fraction(1, 2), Unit()), "values": range(0, 5)}),
    Assign: (Assign(GO, PUSH), {"var": PUSH, "value": GO}),
    If: (If(GO, (Assign(GO, PUSH),)), {"condition": PUSH, "then": (), "otherwise": (Assign(GO, PUSH),)}),
    Send: (Send("e", "C"), {"event": "f", "receiver": "D"}),
    Transition: (
        Transition("A", GO, "e", (), ()),
        {
            "target": "B",
            "guard": None,
            "event": None,
            "do": (Assign(GO, PUSH),),
            "then": (Assign(GO, PUSH),),
            "label": label_text("[go]"),
        },
    ),
    Assumption: (Assumption("A", "", GO), {"id": "B", "formula": PUSH}),
    System: (
        lamp(),
        {
            "name": "other",
            "components": (),
            "frozen": (COUNT,),
            "assume": GO,
            "tick_ms": 10,
            "step_ms": 40,
            "over": True,
            "under": True,
            "concrete": "rover",
            "assumptions": (Assumption("A", "", GO),),
            "elapsed": COUNT,
        },
    ),
    Property: (
        Property("P", "", Always(GO), ("R",), "lamp"),
        {"id": "Q", "form": Always(PUSH), "on": "other", "from_tick": 2},
    ),
}
"""A record of each kind, and for each of its fields that matters another value."""


def form_samples() -> Iterator[tuple[Any, dict[str, Any]]]:
    """Of each form of property one, and another value of each field."""
    others = {
        "within": 3 * ticks,
        "for_": 3 * ticks,
        "bound": 3 * ticks,
        "fair": (COUNT == 1,),
        "by": COUNT == 1,
    }
    given = {"within": 2 * ticks, "for_": 2 * ticks, "bound": None, "fair": (), "by": None}
    for kind in forms.Form.__args__:  # type: ignore[attr-defined]
        names = [f.name for f in fields(kind)]
        yield (
            kind(**{n: given.get(n, GO) if n in given else GO for n in names}),
            {n: others.get(n, PUSH) for n in names},
        )


def samples() -> dict[str, tuple[Any, dict[str, Any]]]:
    named = {kind.__name__: sample for kind, sample in SAMPLES.items()}
    return named | {type(one).__name__: (one, more) for one, more in form_samples()}
