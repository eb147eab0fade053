"""The events of a scenario, and the course that each condition takes through them."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite

from rovercheck.supervisor.bench.conditions import BOTH, CONDITIONS, NO_ECHO
from rovercheck.supervisor.bench.course import Course, Piece, Setting
from rovercheck.supervisor.bench.errors import ScenarioError, nearest
from rovercheck.supervisor.bench.quantities import shown, time_us
from rovercheck.supervisor.bench.table import Table

KEYS = ("at", "over", "for", "label")


@dataclass(frozen=True)
class Event:
    """Conditions that change together.

    Numbers run evenly to their new values within ``over_us``.  With ``for_us`` everything is so long as
    written, and then again what it was before.
    """

    number: int
    at_us: int
    settings: Mapping[str, Setting]
    label: str
    over_us: int = 0
    for_us: int = 0

    @property
    def end_us(self) -> int:
        """When the last change of it is done."""
        return self.at_us + self.over_us + self.for_us

    @property
    def path(self) -> str:
        return f"event[{self.number}]"


def parse_settings(table: Table, other_keys: Sequence[str] = ()) -> dict[str, Setting]:
    """The conditions that a table sets; ScenarioError for what is none."""
    settings: dict[str, Setting] = {}
    for key, written in table.rest().items():
        if key not in CONDITIONS and key not in BOTH:
            hint = nearest(key, (*CONDITIONS, *BOTH, *other_keys))
            raise ScenarioError(table.at(key), f"there is no such condition. {hint}")
        for name in BOTH.get(key, (key,)):
            settings[name] = CONDITIONS[name].parse(table.at(key), written)
    return settings


def parse_event(number: int, table: Table, duration_us: int) -> Event:
    """One ``[[event]]``; ScenarioError if it has no meaning."""
    at_us = time_us(table.at("at"), table.need("at", '"2.5 s"'))
    over_us, for_us = table.time_us("over"), table.time_us("for")
    label = table.text("label")
    settings = parse_settings(table, KEYS)
    if not settings:
        raise ScenarioError(table.path, "sets nothing; write a condition and its value, such as stick_y = 1.")
    if at_us + over_us + for_us > duration_us:
        raise ScenarioError(
            table.at("at"),
            f"it ends at {shown(at_us + over_us + for_us)}, after the run, which lasts {shown(duration_us)}; "
            "let it end earlier or the run last longer.",
        )
    if over_us:
        for name in settings:
            if not CONDITIONS[name].is_number:
                raise ScenarioError(
                    table.at("over"), f"{name} is no number and changes at once; leave it out."
                )
    return Event(number, at_us, settings, label or described(settings), over_us, for_us)


def described(settings: Mapping[str, Setting]) -> str:
    """What an event without label sets, in one line; both directions of the link as one."""
    left = dict(settings)
    parts = []
    for short, names in BOTH.items():
        if all(name in left for name in names) and len({left[name] for name in names}) == 1:
            parts.append(f"{short} {_value(names[0], left[names[0]])}")
            left = {name: value for name, value in left.items() if name not in names}
    return ", ".join(parts + [f"{name} {_value(name, value)}" for name, value in left.items()])


def _value(name: str, value: Setting) -> str:
    if isinstance(value, bool | str):
        return str(value).lower()
    dimension = CONDITIONS[name].dimension
    if not isfinite(value):
        return NO_ECHO
    return f"{value:g} {next(iter(dimension.units))}" if dimension else f"{value:g}"


def courses(initial: Mapping[str, Setting], events: Iterable[Event]) -> dict[str, Course]:
    """The course of every condition; ScenarioError where two events change one at the same time."""
    ordered = sorted(events, key=lambda event: event.at_us)
    return {
        name: _course(name, initial.get(name, condition.initial), ordered)
        for name, condition in CONDITIONS.items()
    }


def _course(name: str, value: Setting, events: Iterable[Event]) -> Course:
    pieces = [Piece(0, value)]
    last: Event | None = None
    for event in events:
        if name not in event.settings:
            continue
        if last is not None and event.at_us < last.end_us:
            raise ScenarioError(
                f"{event.path}.{name}",
                f"{last.path} changes it until {shown(last.end_us)}; begin then, or let that end earlier.",
            )
        pieces += _pieces(name, value, event)
        value = value if event.for_us else event.settings[name]
        last = event
    return Course(tuple(pieces))


def _pieces(name: str, before: Setting, event: Event) -> list[Piece]:
    """What one event adds to a course."""
    value = event.settings[name]
    if not event.over_us:
        pieces = [Piece(event.at_us, value)]
    elif isinstance(before, str) or isinstance(value, str) or not (isfinite(before) and isfinite(value)):
        raise ScenarioError(
            f"{event.path}.over", f'{name} is "{NO_ECHO}" before or after it; set a distance first, at once.'
        )
    else:
        pieces = [Piece(event.at_us, value, before, event.at_us + event.over_us)]
    return [*pieces, Piece(event.end_us, before)] if event.for_us else pieces
