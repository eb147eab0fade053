"""Cross-check: an implementation and the charts side by side, under the same inputs."""

from checker.compare.beside import Difference, Mismatch, Step
from checker.compare.check import cross_check, known_runs, quick_check, replay
from checker.compare.result import Allowance, Failure, Result, Stage
from checker.compare.search import Effort, effort
from checker.compare.stimulus import SILENT, Block, Every, Stimulus

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
