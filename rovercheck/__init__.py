"""rovercheck: charts as transition systems, and properties of them decided with evidence.

What a model or a script needs is imported from here; ``rovercheck.api`` lists the names.  They are loaded
when the first of them is used, so that ``rovercheck --help`` loads none.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rovercheck.api import *  # noqa: F403


def __getattr__(name: str) -> object:
    if name == "__all__" or not name.startswith("_"):
        api = import_module(f"{__name__}.api")
        if name in ("__all__", *api.__all__):
            return getattr(api, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *import_module(f"{__name__}.api").__all__})
