"""The forty faults against the cross-check in its CI profile, up to the first mismatch of each."""

from dataclasses import dataclass, replace
from typing import cast

from benchmarks.faults.by_hand import Fault
from benchmarks.faults.recorded import supervisor
from rovercheck.checker.adapters.firmware import places
from rovercheck.checker.adapters.implementation import Implementation, Value, Values
from rovercheck.checker.adapters.python_calls import Instance
from rovercheck.checker.compare import effort, known_runs
from rovercheck.checker.compare.search import CompareSearch
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.spec_model.abstraction import boards


@dataclass(frozen=True)
class Caught:
    """How a fault was found: in which run, after how many steps of all runs, and in which output."""

    origin: str
    steps: int
    output: str


class InProcess:
    """A supervisor as an implementation, in this process."""

    def __init__(self, fault: Fault) -> None:
        self._make = fault.make or (lambda: Instance(supervisor(fault.board), places(boards()[fault.board])))
        self.reset()

    def reset(self) -> None:
        """Power-up."""
        self._instance = self._make()

    def step(self, inputs: Values) -> Values:
        """One step."""
        return cast(dict[str, Value], self._instance.step(inputs))

    def close(self) -> None:
        """Nothing runs outside."""


def hunt(fault: Fault, examples: int | None = None) -> Caught | int:
    """What the cross-check finds first, or after how many steps it found nothing."""
    env = replace(ENVIRONMENTS[fault.board], board=fault.varied())
    implementation: Implementation = InProcess(fault)
    search = CompareSearch(env, implementation, effort("ci", examples), stop_early=True)
    result = search.run(known_runs(env))
    if not result.mismatches:
        return result.coverage.steps
    first = result.mismatches[0]
    return Caught(first.origin, result.coverage.steps, first.differences[0].name)
