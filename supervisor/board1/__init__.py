"""The supervisor of Board 1, which drives the rover unless it loses Board 2."""

from rovercheck.supervisor.board1.board import Board1
from rovercheck.supervisor.board1.signals import Board1Inputs, Board1Outputs, Statuses

__all__ = ["Board1", "Board1Inputs", "Board1Outputs", "Statuses"]
