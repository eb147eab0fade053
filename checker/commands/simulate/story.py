"""A simulated run as a table for the terminal: what happened, and when, in lines of 80 columns."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from rovercheck.checker.commands.shared.output import text_width
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.supervisor.bench import Outcome, Record, Scenario
from rovercheck.supervisor.bench.changes import Change, changes
from rovercheck.supervisor.bench.record import Traffic
from rovercheck.supervisor.bench.signals import name_of

INDENT = 21
LONGEST_CYCLE = 6
"""So many lines that repeat at once are shown once."""
OFTEN = 3
WHO = {"board1": "Board 1", "board2": "Board 2", "rover": "rover"}


@dataclass(frozen=True)
class StoryLine:
    """What happened to one part of the rover at one time."""

    time_us: int
    who: str
    what: str

    def text(self) -> str:
        """The line, broken where it is too long."""
        head = f"{self.time_us / 1000:>8,.0f} ms  {self.who:<8} "
        return filled(head + self.what, text_width(), then=" " * INDENT)


def story(scenario: Scenario, record: Record) -> str:
    """The whole table."""
    lines = sorted([*_events(scenario), *_changes(record)], key=lambda line: line.time_us)
    return "\n".join(_folded(lines))


def _events(scenario: Scenario) -> Iterator[StoryLine]:
    for event in scenario.events:
        yield StoryLine(event.at_us, "", f"▸ {event.number}: {event.label}")
        if event.for_us:
            yield StoryLine(event.end_us, "", f"▸ {event.number} is over")


def _changes(record: Record) -> Iterator[StoryLine]:
    def place(change: Change) -> tuple[int, str]:
        return change.time_us, change.signal.partition(".")[0]

    for (time_us, who), together in groupby(sorted(changes(record), key=place), key=place):
        yield StoryLine(time_us, WHO[who], "; ".join(_sentences(list(together))))


def _sentences(together: Sequence[Change]) -> Iterator[str]:
    """Changes of one instant; wheels that change alike are reported at once."""
    alike: dict[tuple[str, str, str], list[str]] = {}
    for change in together:
        name = change.signal.partition(".")[2]
        stem, _, wheel = name.rpartition("_") if name.startswith("wheel_status") else (name, "", "")
        key = stem, name_of(change.old), name_of(change.new)
        alike.setdefault(key, []).append(wheel)
    for (stem, old, new), wheels in alike.items():
        which = f"_{'/'.join(wheels)}" if wheels[0] else ""
        yield f"{stem}{which}: {old} → {new}"


def _folded(lines: Sequence[StoryLine]) -> Iterator[str]:
    """The lines; some that repeat in the same order again and again are shown once, with their number."""
    place = 0
    while place < len(lines):
        long, times = _cycle(lines[place:])
        yield from (line.text() for line in lines[place : place + long])
        place += long * times
        if times > 1:
            last = f"the last {long} lines" if long > 1 else "the same"
            until = f"{lines[place - 1].time_us / 1000:,.0f} ms"
            yield f"{'':{INDENT}}… {last} {times - 1} times more, until {until}"


def _cycle(lines: Sequence[StoryLine]) -> tuple[int, int]:
    """How many of the first lines repeat, and how often they are there; (1, 1) if none does often enough."""
    what = [(line.who, line.what) for line in lines]
    for long in range(1, min(LONGEST_CYCLE, len(lines) // OFTEN) + 1):
        times = 1
        while what[times * long : (times + 1) * long] == what[:long]:
            times += 1
        if times >= OFTEN:
            return long, times
    return 1, 1


def heading(scenario: Scenario, name: str) -> str:
    """What is run, in a few lines."""
    phase = f"Board 2 starts {scenario.phase_us / 1000:g} ms after Board 1"
    drift = f", and its clock gains {scenario.drift_ppm:g} ppm" if scenario.drift_ppm else ""
    lines = [filled(scenario.title or name, text_width()), filled(scenario.about, text_width())]
    lines.append(f"{scenario.duration_us / 10**6:g} s; {phase}{drift}; seed {scenario.seed}.")
    return "\n".join(filter(None, lines))


def traffic(record: Record) -> str:
    """The frames of both directions."""
    return "\n".join(
        _frames(way, told) for way, told in (("1 to 2", record.b1_to_b2), ("2 to 1", record.b2_to_b1))
    )


def _frames(way: str, told: Traffic) -> str:
    parts = [f"{told.sent:,} sent", f"{told.accepted:,} accepted"]
    parts += [f"{number:,} refused ({reason})" for reason, number in sorted(told.refused.items())]
    if told.dropped:
        parts.append(f"{told.dropped:,} not sent, the line was busy")
    return filled(f"frames {way}: {', '.join(parts)}", text_width(), then=" " * 15)


def verdicts(outcomes: Iterable[Outcome]) -> str:
    """Each expectation with a tick or a cross."""
    width, marked = text_width(), (f"{'✓' if outcome.met else '✗'} {outcome.said}" for outcome in outcomes)
    return "\n".join(filled(line, width, then="  ") for line in marked)
