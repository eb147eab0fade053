"""The forms of properties, with an example of each and the sentence that is made from it."""

import inspect
from typing import Any

from docs.reference.language import TABLE, fenced, signature
from rovercheck.properties import forms
from rovercheck.properties.english import sentence
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, implies, var
from rovercheck.spec_model.lang.time import ms, sec

HEAD = """# Forms of properties

From `rovercheck`. A property has an id, the sentence that people mean, a form, the requirements that
it covers, and the system it is about. A formula is read at the end of a tick, with the inputs of the tick.
Below each form is an example, and the sentence that `rovercheck list properties --english` makes from it for
a system with steps of 20 ms.

Every form but the last four is broken by a finite run, which is shown. `reachable` is shown by a run.
`leads_to` and `settles` are broken by a run that ends in a loop; `recoverable` by a run after which no
continuation leads back. `from_tick=2` requires a property only from the second tick on.
"""
SCOPE = {
    "level": var("level", integer(0, 100, "%")),
    "fault": flag("fault"),
    "pumping": flag("pumping"),
    "implies": implies,
    "ms": ms,
    "sec": sec,
}


def page() -> str:
    """The reference as Markdown."""
    return HEAD + "".join(_form(name, entry["example"]) for name, entry in TABLE["forms"].items())


def _form(name: str, example: str) -> str:
    build = getattr(forms, name)
    shown = f'{name}(\n    "TANK-1", "What people mean.",\n    {example},\n    covers=["R1"], on="Tank",\n)'
    prop: Property = eval(shown, {**SCOPE, name: build})
    meaning = (inspect.getdoc(type(prop.form)) or "").replace("``", "`")
    told = sentence(prop, tick_ms=20)
    call = fenced(signature(name, build))
    return f"\n## {name}\n\n{meaning}\n\n{call}\nFor example\n\n{fenced(shown)}\n> {told}\n"


def builders() -> dict[str, Any]:
    """The functions that make a property of a form, by name."""
    return {
        name: made
        for name, made in vars(forms).items()
        if inspect.isfunction(made)
        and not name.startswith("_")
        and "covers" in inspect.signature(made).parameters
    }
