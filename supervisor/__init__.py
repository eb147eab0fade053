"""The supervisors of both boards as firmware: a second reading of the document, to compare with the charts.

It knows nothing of the charts, the properties or the checker, and needs only Python.
"""

from rovercheck.supervisor.board1 import Board1, Board1Inputs, Board1Outputs
from rovercheck.supervisor.board2.board import Board2
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs

__all__ = ["Board1", "Board1Inputs", "Board1Outputs", "Board2", "Board2Inputs", "Board2Outputs"]
