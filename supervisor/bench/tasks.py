"""The periodic tasks of a board that is powered: they stop for good when its power goes."""

from dataclasses import dataclass
from itertools import cycle

from rovercheck.supervisor.bench.scenario import Scenario
from rovercheck.supervisor.bench.schedule import LATER, Action, Agenda, Clock, Rank


@dataclass
class Tasks:
    """Runs tasks by the clock of one board, from its power-up to its loss of power."""

    scenario: Scenario
    agenda: Agenda
    clock: Clock
    powered: bool = True

    def every(self, task: str, rank: Rank, action: Action) -> None:
        """Run ``action`` once in every period of the task."""
        periods_us = cycle(self.scenario.periods_us[task])
        first_us = self.scenario.phases_us[task] + (next(periods_us) if task in LATER else 0)

        def run(time_us: int, local_us: int) -> None:
            if self.powered:
                action(time_us)
                enter(local_us + next(periods_us))

        def enter(local_us: int) -> None:
            self.agenda.enter(self.clock.time_us(local_us), rank, lambda time_us: run(time_us, local_us))

        enter(first_us)

    def once(self, time_us: int, rank: Rank, action: Action) -> None:
        """Run ``action`` at that time, if there is still power."""
        self.agenda.enter(time_us, rank, lambda at: action(at) if self.powered else None)

    def now_ms(self, time_us: int) -> int:
        """The clock of the board."""
        return self.clock.now_ms(time_us)
