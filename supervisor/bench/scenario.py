"""A scenario: how long the rover runs, from what, what happens to it, and what is expected of it."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from rovercheck.supervisor.bench.course import Course, Setting
from rovercheck.supervisor.bench.errors import ScenarioError
from rovercheck.supervisor.bench.events import Event, courses, parse_event, parse_settings
from rovercheck.supervisor.bench.expectation import Expectation, parse_expectation
from rovercheck.supervisor.bench.quantities import DRIFT, shown, time_us
from rovercheck.supervisor.bench.schedule import PERIODS_US
from rovercheck.supervisor.bench.table import Table

LONGEST_US = 600 * 10**6
MOST_PHASE_US = 19_999
MOST_DRIFT_PPM = 10_000
SHORTEST_US, MOST_PERIODS = 1_000, 10
"""A period lasts a millisecond at least, and at most so many times what it should."""
KEYS = (
    *("title", "about", "duration", "phase", "drift", "seed"),
    *("initial", "phases", "periods", "event", "expect"),
)


@dataclass(frozen=True)
class Scenario:
    """A run to be made; two runs of the same scenario are equal.

    Board 1 is powered up at time 0 and Board 2 ``phase_us`` later; the clock of Board 2 gains
    ``drift_ppm`` microseconds a second on that of Board 1.  ``phases_us`` shifts single tasks within their
    period, ``periods_us`` has what each period of a task lasts, in turn and again and again; ``seed`` decides
    which frames and bits the link damages.
    """

    title: str
    about: str
    duration_us: int
    phase_us: int
    drift_ppm: int
    seed: int
    phases_us: Mapping[str, int]
    periods_us: Mapping[str, tuple[int, ...]]
    events: tuple[Event, ...]
    expectations: tuple[Expectation, ...]
    courses: Mapping[str, Course]

    def at(self, name: str, time_us: int) -> Setting:
        """What a condition is at a time."""
        return self.courses[name].at(time_us)

    def number(self, name: str, time_us: int) -> float:
        """The same for a condition that is a number."""
        return float(self.courses[name].at(time_us))


def loads(text: str) -> Scenario:
    """The scenario that a TOML text describes; ScenarioError if it has no meaning."""
    try:
        written = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise ScenarioError("", f"This is no TOML: {error}.") from error
    return parse(written)


def parse(written: Mapping[str, object]) -> Scenario:
    """The scenario that the tables of a file describe; ScenarioError if it has no meaning."""
    top = Table("", written)
    duration_us = _duration(top)
    initial = parse_settings(Table("initial", top.take("initial", {})))
    events = tuple(
        parse_event(number, table, duration_us) for number, table in enumerate(top.tables("event"), 1)
    )
    scenario = Scenario(
        title=top.text("title"),
        about=top.text("about"),
        duration_us=duration_us,
        phase_us=_phase(top),
        drift_ppm=_drift(top),
        seed=top.whole("seed"),
        phases_us=MappingProxyType(_phases(Table("phases", top.take("phases", {})))),
        periods_us=MappingProxyType(_periods(Table("periods", top.take("periods", {})))),
        events=tuple(sorted(events, key=lambda event: event.at_us)),
        expectations=tuple(parse_expectation(table, duration_us) for table in top.tables("expect")),
        courses=MappingProxyType(courses(initial, events)),
    )
    top.end(KEYS)
    return scenario


def _duration(top: Table) -> int:
    if not 20_000 <= (duration_us := top.time_us("duration", -1)) <= LONGEST_US:
        if duration_us == -1:
            top.need("duration", '"10 s"')
        raise ScenarioError(
            "duration", f"{shown(duration_us)} is no run; write 20 ms to {shown(LONGEST_US)}."
        )
    return duration_us


def _phase(top: Table) -> int:
    if (phase_us := top.time_us("phase")) > MOST_PHASE_US:
        raise ScenarioError(
            "phase",
            f"{shown(phase_us)} is no phase of a task of 20 ms; write less than 20 ms. A board that starts "
            'later is board_2 = "off" at first and "on" in an event.',
        )
    return phase_us


def _drift(top: Table) -> int:
    drift = DRIFT.parse("drift", top.take("drift", "0 ppm"))
    if drift.denominator != 1 or abs(drift) > MOST_DRIFT_PPM:
        raise ScenarioError(
            "drift", f'write whole ppm from -{MOST_DRIFT_PPM} to {MOST_DRIFT_PPM}, as in drift = "50 ppm".'
        )
    return int(drift)


def _phases(table: Table) -> dict[str, int]:
    """Shifts of single tasks, each less than the period of the task."""
    phases = {}
    for task, period_us in PERIODS_US.items():
        phases[task] = table.time_us(task)
        if phases[task] >= period_us:
            raise ScenarioError(
                table.at(task),
                f"{shown(phases[task])} is no phase of a task of {shown(period_us)}; write less than that.",
            )
    table.end(PERIODS_US)
    return phases


def _periods(table: Table) -> dict[str, tuple[int, ...]]:
    """What the periods of single tasks last, those of the others as they should."""
    periods = {}
    for task, period_us in PERIODS_US.items():
        written = table.take(task, [f"{period_us} us"])
        path, several = table.at(task), written if isinstance(written, list) else [written]
        periods[task] = tuple(time_us(path, one) for one in several)
        if not periods[task]:
            raise ScenarioError(path, 'there is no period; write one, as in "19 ms", or several in a list.')
        for found in periods[task]:
            if not SHORTEST_US <= found <= MOST_PERIODS * period_us:
                most = shown(MOST_PERIODS * period_us)
                raise ScenarioError(
                    path, f"{shown(found)} is no period; write {shown(SHORTEST_US)} to {most}."
                )
    table.end(PERIODS_US)
    return periods
