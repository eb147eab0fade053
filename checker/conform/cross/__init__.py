"""Cross-check: an implementation and the charts side by side, under the same inputs."""

from checker.conform.cross.beside import Difference, Mismatch, Step
from checker.conform.cross.check import cross_check, known_runs, quick_check, replay
from checker.conform.cross.result import Allowance, Failure, Result, Stage
from checker.conform.cross.search import Effort, effort
from checker.conform.cross.stimulus import SILENT, Block, Every, Stimulus

__all__ = [
    "SILENT",
    "Allowance",
    "Block",
    "Difference",
    "Effort",
    "Every",
    "Failure",
    "Mismatch",
    "Result",
    "Stage",
    "Step",
    "Stimulus",
    "cross_check",
    "effort",
    "known_runs",
    "quick_check",
    "replay",
]
