"""``rovercheck simulate``: run both boards in a scenario, tell what happens, and draw it."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from enum import IntEnum
from io import StringIO
from itertools import pairwise
from math import nan
from pathlib import Path

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, err, out, write
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.silence import silent
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.simulate.story import heading, story, traffic, verdicts
from rovercheck.checker.extras import PLOT
from rovercheck.checker.io.files import replaced
from rovercheck.checker.render.lanes import (
    Band,
    ChartLane,
    Curve,
    LaneLimit,
    LaneRow,
    LaneRows,
    Lanes,
    Mark,
    Tone,
)
from rovercheck.checker.render.run_plot import SUFFIXES, PlotError, draw
from rovercheck.supervisor import bench
from rovercheck.supervisor.bench import Outcome, Record, Scenario, ScenarioError, judge, loads
from rovercheck.supervisor.bench.columns import Scalar, inputs1, inputs2, outputs1, outputs2
from rovercheck.supervisor.bench.conditions import WHEELS
from rovercheck.supervisor.bench.judge import history
from rovercheck.supervisor.bench.record import Driver, Side
from rovercheck.supervisor.bench.signals import SIGNALS, name_of
from rovercheck.supervisor.types import Level, SafetyState, SupervisorCommand

# --- A simulated run in the terms of pictures ----------------------------------------------------------

FULL_SCALE_RPM = 160
COMMANDS = {
    SupervisorCommand.CMD_NORMAL: Tone.IDLE,
    SupervisorCommand.CMD_STOP: Tone.DEGRADED,
    SupervisorCommand.CMD_ESTOP: Tone.CRITICAL,
}
STATUSES1 = ("temp_status", "batt_status", "rx_status", "b2_sup_status")
ACTS = ("rover_safety_state", "current_action", "actuate_emergency_stop")
STATUSES2 = ("esp_status", "imu_status", "rx_status", "b1_sup_status")


def lanes(scenario: Scenario, record: Record, name: str) -> Lanes:
    """The picture of a run."""
    end_s = scenario.duration_us / 10**6
    phase = f"Board 2 {scenario.phase_us / 1000:g} ms after Board 1"
    drift = f", its clock {scenario.drift_ppm:+d} ppm" if scenario.drift_ppm else ""
    return Lanes(
        title=scenario.title or name,
        note=f"{phase}{drift}; seed {scenario.seed}",
        end_s=end_s,
        lanes=(*_charts(record), *_rows(record, end_s)),
        marks=[Mark(e.number, e.at_us / 10**6, e.end_us / 10**6, e.label) for e in scenario.events],
    )


def _charts(record: Record) -> Iterable[ChartLane]:
    yield ChartLane(
        "joystick",
        [_curve(record, "board2.ay_norm", "y, forward"), _curve(record, "board2.bx_norm", "x, left")],
        -1,
        1,
        ticks=(-1, -0.5, 0, 0.5, 1),
    )
    yield ChartLane(
        "speed references",
        [
            _curve(record, "board1.v_ref", "v_ref, Board 1"),
            _curve(record, "board2.v_ref_actuation", "v_ref, Board 2"),
            _curve(record, "board1.omega_ref", "omega_ref, Board 1"),
            _curve(record, "board2.omega_ref_actuation", "omega_ref, Board 2"),
        ],
        -0.2,
        1,
        ticks=(-1, -0.5, 0, 0.5, 1),
    )
    wheels = [_curve(record, f"rover.wheel_{w}", w, steps=False) for w in WHEELS]
    yield ChartLane("wheels in rpm", wheels, 0, FULL_SCALE_RPM / 2, ticks=(-160, -80, 0, 80, 160))
    yield ChartLane("heading in °", [_turning(record)], 0, 360, ticks=(0, 90, 180, 270, 360))
    yield ChartLane(
        "obstacles in cm",
        [
            _curve(record, "board2.d1", "left"),
            _curve(record, "board2.d2", "centre"),
            _curve(record, "board2.d3", "right"),
        ],
        0,
        301,
        [LaneLimit(70, "70 stop"), LaneLimit(100, "100"), LaneLimit(300, "300 degraded")],
        ticks=(0, 100, 200, 300),
    )
    yield ChartLane(
        "temperature in °C",
        [_curve(record, "board1.temperature_degC", "last valid")],
        20,
        30,
        [
            LaneLimit(-15, "−15"),
            LaneLimit(-5, "−5"),
            LaneLimit(55, "55 degraded"),
            LaneLimit(60, "60 critical"),
        ],
    )
    yield ChartLane(
        "battery in %",
        [_curve(record, "board1.battery_pct", "last valid")],
        0,
        100,
        [LaneLimit(15, "15 critical"), LaneLimit(25, "25 OK above"), LaneLimit(23, "")],
        ticks=(0, 50, 100),
    )


def _curve(record: Record, signal: str, name: str, *, steps: bool = True) -> Curve:
    """A signal as a curve; one that keeps its values needs only the times at which they change."""
    told = history(record, signal)
    points = [(t / 10**6, float(v)) for t, v in zip(told.times_us, told.values, strict=True)]
    if steps:
        points = _corners(points)
    return Curve(name, [t for t, _ in points], [v for _, v in points], steps)


def _corners(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    kept = [after for before, after in pairwise(points) if after[1] != before[1]]
    return [*points[:1], *kept, *points[-1:]]


def _turning(record: Record) -> Curve:
    """The heading; where it passes 360° the line is interrupted."""
    times: list[float] = []
    values: list[float] = []
    for sample in record.samples:
        if values and abs(sample.heading - values[-1]) > 180:
            times.append(sample.time_us / 10**6)
            values.append(nan)
        times.append(sample.time_us / 10**6)
        values.append(sample.heading)
    return Curve("clockwise", times, values)


def _rows(record: Record, end_s: float) -> Iterable[LaneRows]:
    wheels = [f"wheel_status_{w}" for w in WHEELS]
    one = (*STATUSES1, *wheels, *ACTS, "give_b2_actuation")
    yield LaneRows("Board 1", [_row(record, f"board1.{name}", end_s) for name in one])
    two = (*STATUSES2, *ACTS, "command", "autorized_to_send_command")
    yield LaneRows("Board 2", [_row(record, f"board2.{name}", end_s) for name in two])
    yield LaneRows("relay", [_row(record, f"rover.{n}", end_s) for n in ("relay", "driven_by")])


def _row(record: Record, signal: str, end_s: float) -> LaneRow:
    told = history(record, signal)
    bands: list[Band] = []
    since, value = 0.0, SIGNALS[signal].initial
    for time_us, new in zip(told.times_us, told.values, strict=True):
        if new != value:
            bands.append(_band(since, time_us / 10**6, value))
            since, value = time_us / 10**6, new
    bands.append(_band(since, end_s, value))
    return LaneRow(signal.partition(".")[2], bands)


def _band(start_s: float, end_s: float, value: Scalar) -> Band:
    return Band(start_s, end_s, _label(value), _tone(value))


def _label(value: Scalar) -> str:
    if isinstance(value, IntEnum):
        return value.name.removeprefix("CMD_").removeprefix("SAFETY_").replace("BOARD_", "Board ")
    return name_of(value)


def _tone(value: Scalar) -> Tone:
    if isinstance(value, Level | SafetyState):
        return (Tone.OK, Tone.DEGRADED, Tone.CRITICAL)[value]
    if isinstance(value, Side | Driver):
        return {"BOARD_1": Tone.FIRST, "BOARD_2": Tone.SECOND}.get(value.name, Tone.IDLE)
    if isinstance(value, SupervisorCommand):
        return COMMANDS.get(value, Tone.ACTION)
    return Tone.ACTION if value is True else Tone.IDLE


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
    _print_outcomes(scenario, record, outcomes, place)
    if log is not None:
        _write_logs(record, log)
    if plot:
        _write_plot(scenario, record, place, output, suffix)
    return Exit.AS_EXPECTED if all(outcome.met for outcome in outcomes) else Exit.FAILED


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
    if not PLOT.installed:
        raise UsageError(f"{whole(output)}: {PLOT.needed('A plot')}. Or write --no-plot.")
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


def _print_outcomes(scenario: Scenario, record: Record, outcomes: list[Outcome], place: Path) -> None:
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
        _print_line(f"The motion of the rover is {whole(target)}.")
        return
    try:
        picture = draw(lanes(scenario, record, place.stem), suffix)
    except PlotError as error:
        err.print(f"No plot: {error}", markup=False)
        return
    write(picture, target)
    _print_line(f"The plot is {whole(target)}.")


def _print_line(sentence: str) -> None:
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
            _print_line(f"The log of {name} is {whole(target)}.")
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
