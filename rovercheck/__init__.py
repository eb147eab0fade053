"""rovercheck: charts as transition systems, and properties of them decided with evidence.

What a model or a script needs is imported from here: the words of charts and properties
(``rovercheck.language``), and functions that check a model (``rovercheck.library``).  Everything else is
internal and changes without notice.  Names are loaded when they are used: ``rovercheck --help`` needs none.

>>> from rovercheck import Chart, State, flag, to
>>> lit = flag("lit")
>>> Chart("Lamp", [State("Off", transitions=[to("On", when=lit)]), State("On")], default="Off").name
'Lamp'
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rovercheck.language import *  # noqa: F403
    from rovercheck.library import *  # noqa: F403

_PARTS = (f"{__name__}.language", f"{__name__}.library")


def __getattr__(name: str) -> object:
    if name == "__all__":
        return [word for part in _PARTS for word in import_module(part).__all__]
    if not name.startswith("_"):
        for part in map(import_module, _PARTS):
            if name in part.__all__:
                return getattr(part, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *(word for part in map(import_module, _PARTS) for word in part.__all__)})
