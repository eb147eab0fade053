"""How an implementation under test is run: one file per kind of implementation.

They are discovered automatically: every module of this folder that has a ``start``.

An adapter has a ``KIND``, the ``FORM`` of its addresses, a one-line ``SUMMARY`` and the functions of
``Adapter``: ``start``, and ``carried`` and ``moved``, by which an implementation is started elsewhere.
What an implementation does, it does in a process that can be killed.
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from rovercheck.checker.adapters.implementation import Implementation, ImplementationError
from rovercheck.spec_model.lang.errors import did_you_mean

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board


@dataclass(frozen=True)
class AdapterLimits:
    """What an implementation may spend: seconds for one step, seconds to start, bytes of its own data.

    ``hostile``: it is given what its places hold, whether or not the board has such a value, and what it
    cannot hold not at all.  ``flags`` compile its sources besides, ``environment`` is added to its process.
    """

    step: float = 5.0
    start: float = 30.0
    memory: int = 4 << 30
    hostile: bool = False
    flags: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)


LIMITS = AdapterLimits()


class Adapter(Protocol):
    """Runs implementations of one kind."""

    KIND: str
    FORM: str
    SUMMARY: str

    def start(self, what: str, board: "Board", limits: AdapterLimits) -> Implementation:
        """The implementation at an address (without its kind), at power-up.

        Linux ends it with the thread that starts it.  Raises ``ImplementationError`` if it cannot be started.
        """
        ...

    def carried(self, what: str) -> tuple[Path, ...]:
        """The files and folders that an address means, to be sent to another machine.

        Raises ``ImplementationError`` where it can only be started here.
        """
        ...

    def moved(self, what: str, there: Callable[[Path], Path]) -> str:
        """The address of the same implementation, the files of which are elsewhere."""
        ...


def adapters() -> dict[str, Adapter]:
    """The adapters in this folder, by kind."""
    found: dict[str, Adapter] = {}
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        module = importlib.import_module(f"{__name__}.{entry.name}")
        if hasattr(module, "KIND"):
            found[module.KIND] = module
    return found


def start(address: str, board: "Board", limits: AdapterLimits = LIMITS) -> Implementation:
    """The implementation of a board at an address ``KIND:WHAT``, at power-up.

    Raises ``ImplementationError`` for an address without meaning and for one that cannot be started.
    """
    adapter, what = _found(address)
    return adapter.start(what, board, limits)


def carried(address: str) -> tuple[Path, ...]:
    """The files of an implementation.  Raises ``ImplementationError`` where it can only be started here."""
    adapter, what = _found(address)
    return adapter.carried(what)


def moved(address: str, there: Callable[[Path], Path]) -> str:
    """The address of an implementation, the files of which are elsewhere.  Raises ``ImplementationError``."""
    adapter, what = _found(address)
    return f"{adapter.KIND}:{adapter.moved(what, there)}"


def _found(address: str) -> tuple[Adapter, str]:
    kind, colon, what = address.partition(":")
    known = adapters()
    if not colon or kind not in known or not what:
        forms = "\n".join(f"  {adapter.FORM:<30} {adapter.SUMMARY}" for adapter in known.values())
        hint = f" {did_you_mean(kind, known)}" if colon and kind not in known else ""
        raise ImplementationError(f"{address!r} names no implementation.{hint} Write one of\n{forms}")
    return known[kind], what


__all__ = ["LIMITS", "Adapter", "AdapterLimits", "adapters", "carried", "moved", "start"]
