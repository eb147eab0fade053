"""Cross-check: an implementation and the charts side by side, under the same inputs."""

from rovercheck.checker.compare.beside import ComparedStep, StepDifference, StepMismatch
from rovercheck.checker.compare.check import cross_check, known_runs, quick_check
from rovercheck.checker.compare.result import Allowance, CompareResult, CompareStage, Failure
from rovercheck.checker.compare.run_follower import RecordedRun
from rovercheck.checker.compare.search import CompareEffort, effort

__all__ = [
    "Allowance",
    "CompareEffort",
    "CompareResult",
    "CompareStage",
    "ComparedStep",
    "Failure",
    "RecordedRun",
    "StepDifference",
    "StepMismatch",
    "cross_check",
    "effort",
    "known_runs",
    "quick_check",
]
