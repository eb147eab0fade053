"""``rovercheck simulate``: run both boards in a scenario, tell what happens, and draw it."""

import csv
from collections.abc import Iterable, Mapping
from enum import IntEnum
from io import StringIO
from pathlib import Path

from checker.commands.shared.codes import Exit, UsageError
from checker.commands.shared.output import counted, err, out, write
from checker.commands.shared.progress import ProgressLine
from checker.commands.shared.silence import silent
from checker.commands.shared.wrapping import whole
from checker.commands.simulate.lanes import lanes
from checker.commands.simulate.story import heading, story, traffic, verdicts
from checker.io.files import replaced
from checker.render.run_plot import NEEDED, SUFFIXES, PlotError, available, draw
from supervisor import bench
from supervisor.bench import Outcome, Record, Scenario, ScenarioError, judge, loads
from supervisor.bench.columns import Scalar, inputs1, inputs2, outputs1, outputs2

TABLE = ".csv"
"""The format in which ``--output`` is the motion of the rover instead of a plot."""


def simulate(place: Path, output: Path | None, log: Path | None, plot: bool) -> Exit:
    """Run the scenario of a file; exit code 1 if it expects something else than what happens.

    Without ``output`` the plot goes to the current folder, under the name of the scenario, where matplotlib
    is installed.  Raises ``UsageError`` for a scenario without meaning and a place that cannot be written.
    """
    if output is not None and not plot:
        raise UsageError(f"--no-plot and --output {whole(output)} exclude each other; write one of them.")
    suffix = _suffix(output)
    scenario = _read(place)
    record = _run(scenario)
    outcomes = judge(scenario, record)
    _tell(scenario, record, outcomes, place)
    if log is not None:
        _write_logs(record, log)
    if plot:
        _write_plot(scenario, record, place, output, suffix)
    return Exit.AS_EXPECTED if all(outcome.met for outcome in outcomes) else Exit.CHANGED


def _run(scenario: Scenario) -> Record:
    """The run; a terminal shows how far it is."""
    whole = f"{scenario.duration_us / 10**6:g} s"
    with ProgressLine() as line:
        return bench.simulate(scenario, lambda at: line.show(f"simulated {at // 10**6} of {whole}"))


def _suffix(output: Path | None) -> str:
    """The format of the plot, known before anything is run."""
    if output is None:
        return SUFFIXES[0]
    if (suffix := output.suffix.lower()) == TABLE:
        return suffix
    if suffix not in SUFFIXES:
        known = ", ".join((*SUFFIXES, TABLE))
        raise UsageError(
            f"{whole(output)}: {suffix or 'a name without suffix'!r} is no format; write one of {known}."
        )
    if not available():
        raise UsageError(f"{whole(output)}: {NEEDED} Or write --no-plot.")
    return suffix


def _read(place: Path) -> Scenario:
    try:
        return loads(place.read_text(encoding="utf-8"))
    except UnicodeDecodeError as error:
        raise UsageError(f"{whole(place)} is no text in UTF-8, as TOML is: {error.reason}.") from error
    except OSError as error:
        raise UsageError(
            f"Cannot read {whole(place)}: {error.strerror}. Write the path of a scenario."
        ) from error
    except ScenarioError as error:
        raise UsageError(f"{whole(place)}: {error}") from error


def _tell(scenario: Scenario, record: Record, outcomes: list[Outcome], place: Path) -> None:
    told = [heading(scenario, place.stem), story(scenario, record), traffic(record)]
    if outcomes:
        unmet = sum(not outcome.met for outcome in outcomes)
        summary = counted(len(outcomes), "expectation", "expectations")
        told.append(f"{verdicts(outcomes)}\n{summary}: {f'{unmet} not met' if unmet else 'met'}.")
    out.print("\n\n".join(told), markup=False)


def _write_plot(scenario: Scenario, record: Record, place: Path, output: Path | None, suffix: str) -> None:
    target = output or Path(place.stem + suffix)
    if suffix == TABLE:
        write(_csv("time_ms", ((s.time_us / 1000, s.columns()) for s in record.samples)), target)
        _say(f"The motion of the rover is {whole(target)}.")
        return
    try:
        picture = draw(lanes(scenario, record, place.stem), suffix)
    except PlotError as error:
        err.print(f"No plot: {error}", markup=False)
        return
    write(picture, target)
    _say(f"The plot is {whole(target)}.")


def _say(sentence: str) -> None:
    if not silent():
        err.print(sentence, markup=False)


def _write_logs(record: Record, folder: Path) -> None:
    one = (inputs1(step.inputs) | outputs1(step.outputs) for step in record.board1)
    two = (inputs2(step.inputs) | outputs2(step.outputs) for step in record.board2)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, steps in (("board1", one), ("board2", two)):
            target = folder / f"{name}.csv"
            replaced(target, _csv("time_ms", ((step["now_ms"], step) for step in steps)).encode())
            _say(f"The log of {name} is {whole(target)}.")
    except OSError as error:
        raise UsageError(
            f"Cannot write into {whole(folder)}: {error.strerror}. Choose another --log."
        ) from error


def _csv(time: str, rows: Iterable[tuple[Scalar, Mapping[str, Scalar]]]) -> str:
    """A line for each row, its time first; enumerations and truth values as numbers."""
    text = StringIO()
    lines = csv.writer(text, lineterminator="\n")
    for number, (at, row) in enumerate(rows):
        if not number:
            lines.writerow([time, *row])
        lines.writerow(map(_cell, (at, *row.values())))
    return text.getvalue()


def _cell(value: Scalar) -> str:
    return str(int(value)) if isinstance(value, bool | IntEnum) else repr(value)
