"""Cross-check: an implementation and the charts side by side, under the same inputs."""

from checker.compare.beside import ComparedStep, StepDifference, StepMismatch
from checker.compare.check import cross_check, known_runs, quick_check, replay
from checker.compare.result import Allowance, CompareResult, CompareStage, Failure
from checker.compare.search import CompareEffort, effort
from checker.compare.stimulus import SILENT, Every, InputBlock, Stimulus

__all__ = [
    "SILENT",
    "Allowance",
    "CompareEffort",
    "CompareResult",
    "CompareStage",
    "ComparedStep",
    "Every",
    "Failure",
    "InputBlock",
    "StepDifference",
    "StepMismatch",
    "Stimulus",
    "cross_check",
    "effort",
    "known_runs",
    "quick_check",
    "replay",
]
