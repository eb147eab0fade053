"""Where a record of an implementation holds what a board calls by name."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board

Paths = Mapping[str, str]


@dataclass(frozen=True)
class FirmwarePlaces:
    """The places in the records of the supervisors of this project, as the interface of a board lists them.

    The fields of any other record have the names of the board themselves.
    """

    inputs: Paths = field(default_factory=dict)
    outputs: Paths = field(default_factory=dict)

    def inputs_of(self, record: type) -> Paths:
        """Where a dataclass of inputs holds each name."""
        return self.inputs if _ours(record) else _same(record)

    def outputs_of(self, record: type) -> Paths:
        """Where a dataclass of outputs holds each name."""
        return self.outputs if _ours(record) else _same(record)


def places(board: "Board") -> FirmwarePlaces:
    """The places that the interface of a board lists."""
    return FirmwarePlaces(*board.interface.places())


def _ours(record: type) -> bool:
    return record.__module__.startswith("rovercheck.supervisor.")


def _same(record: type) -> Paths:
    return {f.name: f.name for f in fields(record)}
