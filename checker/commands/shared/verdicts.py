"""Verdicts as they are found, with what is under way on the terminal meanwhile."""

from collections.abc import Generator, Mapping, Sequence
from contextlib import closing

from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.progress import SearchWatch
from rovercheck.checker.process.pool import cores
from rovercheck.checker.store.times import keep_times, known_times
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import (
    MachineWarning,
    SearchActivity,
    SearchEnd,
    SearchesPlanned,
    SearchSettings,
    events,
)
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System

BY_DEFAULT = SearchSettings()


def results(
    properties: Sequence[Property],
    systems: Mapping[str, System],
    search: SearchSettings = BY_DEFAULT,
    quiet: bool = False,
) -> Generator[Result, None, None]:
    """Decide the properties, several searches at a time; results come as they are found.

    With ``quiet``, nothing is said meanwhile.  On Ctrl-C the searches under way are ended and
    ``KeyboardInterrupt`` is raised.
    """
    known = known_times() if search.store is not None else {}
    watching = SearchWatch(
        err, len(properties), quiet, known, search.jobs if isinstance(search.jobs, int) else cores()
    )
    with closing(events(properties, systems, search)) as found, watching as watch:
        for one in found:
            match one:
                case SearchesPlanned(titles):
                    watch.plan(titles)
                case SearchActivity(task, line):
                    watch.say(task.title, line)
                case SearchEnd(task):
                    watch.over(task.title)
                case MachineWarning(text):
                    err.print(text, markup=False)
                case Result():
                    watch.counted()
                    yield one
    if search.store is not None:
        keep_times(watching.took)
