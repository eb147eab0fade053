"""What logs are checked against: boards, properties and expected verdicts, as specified or changed."""

from collections.abc import Callable, Mapping
from functools import cache

from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs.selection import PropertySelection, choose
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.properties.forms import Property
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems


class LogReference:
    """The charts of the boards, the properties and their systems; what is made of them is made once.

    ``boards`` are those that a log may be of; ``expected`` is the expected verdict of a property, by its id.
    """

    def __init__(
        self,
        boards: Mapping[str, Board],
        properties: Mapping[str, Property],
        systems: Mapping[str, System],
        expected: Callable[[str], str],
    ) -> None:
        self.expected = expected
        self.boards, self._properties, self._systems = boards, properties, systems
        self._vocabularies: dict[str, Vocabulary] = {}
        self._cones: dict[tuple[str, frozenset[str], frozenset[str]], tuple[LogCone, ...]] = {}
        self._choices: dict[tuple[str, frozenset[str]], PropertySelection] = {}

    def vocabulary(self, board: str) -> Vocabulary:
        """The names of a board."""
        if board not in self._vocabularies:
            self._vocabularies[board] = Vocabulary(self.boards[board])
        return self._vocabularies[board]

    def cones(self, board: str, seen: frozenset[str], logged: frozenset[str]) -> tuple[LogCone, ...]:
        """The parts of a board of which these inputs are seen and these outputs logged."""
        key = board, seen, logged
        if key not in self._cones:
            self._cones[key] = cones(self.vocabulary(board).board, seen, logged)
        return self._cones[key]

    def choice(self, board: str, known: frozenset[str]) -> PropertySelection:
        """The properties of which a log with these variables tells."""
        key = board, known
        if key not in self._choices:
            properties = self._properties.values()
            self._choices[key] = choose(self.vocabulary(board), known, properties, self._systems.__getitem__)
        return self._choices[key]


@cache
def as_drawn() -> LogReference:
    """The charts as specified, every interpretation at its default."""
    return LogReference(boards(), catalogue(), systems(), lambda id: expected(id).verdict)
