"""Cross-check: an implementation and the charts side by side, under the same inputs."""

from rovercheck.checker.compare.beside import ComparedStep, StepDifference, StepMismatch
from rovercheck.checker.compare.check import cross_check, known_runs, quick_check, replay
from rovercheck.checker.compare.result import Allowance, CompareResult, CompareStage, Failure
from rovercheck.checker.compare.search import CompareEffort, effort
from rovercheck.checker.compare.stimulus import SILENT, Every, InputBlock, Stimulus

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
