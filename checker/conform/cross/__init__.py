"""Cross-check: an implementation and the charts side by side, under the same inputs."""

from checker.conform.cross.beside import Difference, Mismatch, Step
from checker.conform.cross.check import cross_check, known_runs, quick_check, replay
from checker.conform.cross.result import SHOWN, Failure, Result
from checker.conform.cross.search import Effort, effort
from checker.conform.cross.stimulus import SILENT, Block, Every, Stimulus

__all__ = [
    "SHOWN",
    "SILENT",
    "Block",
    "Difference",
    "Effort",
    "Every",
    "Failure",
    "Mismatch",
    "Result",
    "Step",
    "Stimulus",
    "cross_check",
    "effort",
    "known_runs",
    "quick_check",
    "replay",
]
