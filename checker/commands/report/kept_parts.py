"""Parts of a review page that are kept between commands: state graphs, and what repairs change and prove.

A part is kept for all files of rovercheck, and for what it was made of.  An entry is sealed as compiled code
is (``checker.cache.entries``): what others wrote or changed counts as missing.
"""

import pickle
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from rovercheck.checker.cache import entries
from rovercheck.checker.store.tree import tree_key
from rovercheck.checker.store.verdicts import VerdictStore

Kept = TypeVar("Kept")


@dataclass(frozen=True)
class PageParts:
    """Where parts are kept; nothing is without a ``store``."""

    store: VerdictStore | None = None

    def made(
        self, kind: type[Kept], make: Callable[[], Kept], lasting: Callable[[Kept], bool], *of: object
    ) -> Kept:
        """What was made ``of`` some values before, or is made now; kept if it would be the same again."""
        name = self._name(kind.__name__, of)
        found = None if name is None else self._read(name)
        if isinstance(found, kind):
            return found
        new = make()
        if name is not None and lasting(new):
            entries.write(name, pickle.dumps(new))
        return new

    @staticmethod
    def _read(name: str) -> object:
        whole = entries.read(name, code=False)
        try:
            return None if whole is None else pickle.loads(whole)
        except Exception:  # an entry of other classes of the same names: the part is made anew
            return None

    def _name(self, kind: str, of: tuple[object, ...]) -> str | None:
        if self.store is None or self._tree is None:
            return None
        return self.store.about(f"page {kind}", self._tree, *of)

    @cached_property
    def _tree(self) -> str | None:
        try:
            return tree_key()
        except OSError:
            return None


NOT_KEPT = PageParts()
