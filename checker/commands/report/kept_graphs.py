"""State graphs that are kept between commands, since a review page explores every system for them.

A graph is kept for all files of rovercheck and for the system and the properties that it was made of.  An
entry is sealed as compiled code is (``checker.cache.entries``): what others wrote or changed counts as missing.
"""

import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from rovercheck.checker.cache import entries
from rovercheck.checker.results.graph import StateGraph
from rovercheck.checker.store.tree import tree_key
from rovercheck.checker.store.verdicts import VerdictStore
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class MadeGraph:
    """A graph with the properties whose breaking is marked, and those that would be too much; or why not."""

    graph: StateGraph | None
    marked: tuple[str, ...] = ()
    unmarked: tuple[str, ...] = ()
    why: str = ""


@dataclass(frozen=True)
class GraphStore:
    """Where graphs are kept; None where nothing is."""

    store: VerdictStore | None = None

    def read(self, system: System, asked: Sequence[Property]) -> MadeGraph | None:
        """What was made of a system before."""
        name = self._name(system, asked)
        whole = None if name is None else entries.read(name, code=False)
        if whole is None:
            return None
        try:
            found = pickle.loads(whole)
        except Exception:  # whatever an old file makes of it: the graph is made anew
            return None
        return found if isinstance(found, MadeGraph) else None

    def write(self, system: System, asked: Sequence[Property], made: MadeGraph) -> None:
        """Keep what was made of a system."""
        name = self._name(system, asked)
        if name is not None:
            entries.write(name, pickle.dumps(made))

    def _name(self, system: System, asked: Sequence[Property]) -> str | None:
        if self.store is None or self._tree is None:
            return None
        return self.store.about("graph", self._tree, system, *asked)

    @cached_property
    def _tree(self) -> str | None:
        try:
            return tree_key()
        except OSError:
            return None
