"""Explaining a trace while a user waits: with progress, a limit of time, and Ctrl-C at any moment."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.results.trace import Trace
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.checker.store.verdicts import VerdictStore

SECONDS = 10.0
"""Of computing, for an explanation that was not asked for: however busy the machine, it is the same."""


@dataclass(frozen=True)
class ExplanationOptions:
    """Whether the cause of a violation is looked for, and for how long (None: as long as it takes).

    With ``quiet`` there is no progress line.  A cause that is in the ``store`` is not looked for again.
    """

    wanted: bool = True
    seconds: float | None = SECONDS
    quiet: bool = False
    store: "VerdictStore | None" = None

    @staticmethod
    def chosen(asked: bool | None, store: "VerdictStore | None" = None) -> "ExplanationOptions":
        """From what a user wrote: --explain, --no-explain or neither."""
        return ExplanationOptions(asked is not False, None if asked else SECONDS, store=store)

    def __call__(self, trace: Trace, prop: Property, systems: Mapping[str, System]) -> Trace:
        """The trace with its cause, or as it is, with a word on why, after Ctrl-C too."""
        if not self.wanted:
            return trace
        from rovercheck.checker.explain.explanation import (  # by solvers, loaded for this alone
            explained_once,
            unexplained,
        )
        from rovercheck.checker.explain.unrolled_run import OutOfTime

        if why := unexplained(trace):
            err.print(f"The cause is not looked for: {why}.", markup=False)
            return trace
        system = systems[trace.system.name]
        task = f"{prop.id}: cause (--no-explain leaves it out)"
        try:
            with Watch(err, 1, self.quiet) as watch:
                return explained_once(
                    trace, prop, system, self.store, lambda line: watch.say(task, line), self.seconds
                )
        except OutOfTime as late:
            err.print(
                f"The cause is not known: {late}. Wait for it with --explain, or leave it out with "
                "--no-explain.",
                markup=False,
            )
        except KeyboardInterrupt:
            err.print("Interrupted: the run is shown without its cause.", markup=False)
        return trace
