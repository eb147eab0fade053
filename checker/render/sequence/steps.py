"""A trace as messages between lifelines and notes on them, tick by tick, with the quiet stretches between."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.render.periods import RepeatedTicks, folded
from rovercheck.checker.render.sequence.flow import ENVIRONMENT, SequenceFlow, flow
from rovercheck.checker.render.story import Quiet, Repeats, Row, StoryChange, StoryEvent, start_of
from rovercheck.checker.results.trace import TakenTransition, Trace
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.walk import variables

MOST = 7
"""Lifelines beyond which sensors have none of their own."""


INSIDE = "changes inside only"
"""Of ticks in which something happens that no other lifeline reads and no transition tells."""


@dataclass(frozen=True)
class Message:
    """Values that one lifeline hands to others; ``lost``: flags that fall, as nothing came."""

    sender: str
    receivers: tuple[str, ...]
    told: tuple[str, ...]
    lost: bool = False


@dataclass(frozen=True)
class SequenceNote:
    """What happens on a lifeline: transitions fired, and results that the property speaks of."""

    lifeline: str
    told: tuple[str, ...]


@dataclass(frozen=True)
class SequenceStep:
    """A tick in which something happened; ``ms`` is the time at its end."""

    number: int
    ms: int
    items: tuple[Message | SequenceNote, ...]


@dataclass(frozen=True)
class Pause:
    """Ticks ``first`` to ``last``, of which nothing is told, and why; ``again``: they repeat what is told."""

    first: int
    last: int
    why: str
    again: bool = False


Told = SequenceStep | Pause | Repeats


@dataclass(frozen=True)
class MessageSequence:
    """The lifelines that take part, and what happens on and between them.

    ``idle`` are those that only start in the first tick; they are left out.
    """

    lifelines: tuple[str, ...]
    steps: tuple[Told, ...]
    idle: tuple[str, ...] = ()


def message_sequence(trace: Trace, *, everything: bool = False) -> MessageSequence:
    """The messages of a run: what the property depends on, or ``everything``.

    Raises ``ModelError`` for a run in which nobody talks to anybody.
    """
    shown = trace if everything or not trace.property.relevant else trace.focused()
    between = flow(trace, everything=everything)
    story = list(folded(shown))
    steps, used = _steps(shown, between, story, apart=True)
    if len(used) > MOST:
        steps, used = _steps(shown, between, story, apart=False)
    if not any(
        isinstance(item, Message) for step in steps if isinstance(step, SequenceStep) for item in step.items
    ):
        raise ModelError(
            f"In this run of {trace.system.name} nothing is handed from one chart or board to another, "
            "so there is no message to draw. Use the format svg, which shows every value over time."
        )
    idle = tuple(name for name in used if name not in _busy(steps))
    busy = [_without(step, idle) if isinstance(step, SequenceStep) else step for step in steps]
    return MessageSequence(tuple(n for n in used if n not in idle), tuple(_joined(busy)), idle)


def _busy(steps: Sequence[Told]) -> set[str]:
    """The lifelines with a message, or with a note after the first tick."""
    told = ((step, item) for step in steps if isinstance(step, SequenceStep) for item in step.items)
    return {
        name
        for step, item in told
        if step.number > 1 or isinstance(item, Message)
        for name in _ends(item)
    }  # fmt: skip


def _without(step: SequenceStep, idle: Sequence[str]) -> SequenceStep:
    return replace(step, items=tuple(item for item in step.items if _ends(item)[0] not in idle))


def _steps(
    trace: Trace, between: SequenceFlow, story: Sequence[Row | RepeatedTicks], *, apart: bool
) -> tuple[list[Told], tuple[str, ...]]:
    """What is told, and the lifelines that take part; ``apart``: sensors have lifelines of their own."""
    steps = [_described(trace, between, row, apart) for row in story]
    used = {
        name
        for step in steps
        if isinstance(step, SequenceStep)
        for item in step.items
        for name in _ends(item)
    }
    known = dict.fromkeys((ENVIRONMENT, *between.sources, *between.lifelines))
    return steps, tuple(name for name in known if name in used)


def _ends(item: Message | SequenceNote) -> tuple[str, ...]:
    return (item.sender, *item.receivers) if isinstance(item, Message) else (item.lifeline,)


def _joined(steps: Sequence[Told]) -> Iterator[Told]:
    """With pauses that follow each other as one, but for repetitions."""
    pause: Pause | None = None
    for step in steps:
        if isinstance(step, Pause) and not step.again:
            pause = replace(pause, last=step.last, why=INSIDE) if pause else step
            continue
        if pause:
            yield pause
            pause = None
        yield step
    if pause:
        yield pause


def _described(trace: Trace, between: SequenceFlow, row: Row | RepeatedTicks, apart: bool) -> Told:
    match row:
        case Quiet():
            return Pause(row.first, row.last, "nothing but timers" if row.counters else "nothing changes")
        case RepeatedTicks():
            return Pause(row.first, row.last, f"{row.told} again, {row.times} times", again=True)
        case StoryEvent():
            step = _step(trace, between, row, apart)
            empty = not step.items and row.number < len(trace)
            return Pause(row.number, row.number, INSIDE) if empty else step
        case Repeats():
            return row


def _step(trace: Trace, between: SequenceFlow, event: StoryEvent, apart: bool) -> SequenceStep:
    """Messages and notes in the order in which the parts execute."""
    found: list[tuple[int, Message | SequenceNote]] = [
        *_messages(trace, between, event, apart), *_notes(trace, between, event)
    ]  # fmt: skip
    found.sort(key=lambda pair: (pair[0], isinstance(pair[1], Message)))
    return SequenceStep(event.number, event.ms, tuple(item for _, item in found))


def _messages(
    trace: Trace, between: SequenceFlow, event: StoryEvent, apart: bool
) -> Iterator[tuple[int, Message]]:
    """One for each sender and circle of receivers, with every value that changes on the way."""
    told: dict[tuple[str, tuple[str, ...]], list[StoryChange]] = {}
    for change in event.changes:
        if between.counts(change.name) and _rises(trace, change.name, event.number):
            continue
        origins = between.origins(change.name)
        receivers = tuple(n for n in between.lifelines if n in between.readers(change.name) - origins)
        for sender in sorted(origins) if receivers else ():
            sender = between.source(change.name) if apart and sender == ENVIRONMENT else sender
            told.setdefault((sender, receivers), []).append(change)
    for (sender, receivers), changes in told.items():
        place = min(between.place(change.name) for change in changes)
        lost = sender in between.lifelines[1:] and all(change.new == "false" for change in changes)
        yield place, Message(sender, receivers, tuple(f"{c.name} = {c.new}" for c in changes), lost)


def _rises(trace: Trace, name: str, number: int) -> bool:
    """Whether a number is higher after this tick than before."""
    before = trace.ticks[number - 2].after if number > 1 else trace.before
    return name in before and trace.ticks[number - 1].after.get(name, 0) > before[name]


def _notes(trace: Trace, between: SequenceFlow, event: StoryEvent) -> Iterator[tuple[int, SequenceNote]]:
    """The transitions of each chart, and results of the property that no other lifeline reads."""
    told: dict[str, list[tuple[int, str]]] = {}
    places = {piece.part.name: i for i, piece in enumerate(between.pieces)}
    owners = {piece.part.name: piece.owner for piece in between.pieces}
    for transition in event.transitions:
        if transition.chart in owners and transition.source != transition.target:
            owner = owners[transition.chart]
            told.setdefault(owner, []).append((places[transition.chart], _fired(transition, owner)))
    asked = {name for expr in trace.property.false_parts for name in variables(expr)}
    for change in event.changes:
        for owner in between.origins(change.name) - {ENVIRONMENT}:
            if change.name in asked and not between.readers(change.name) - {owner}:
                told.setdefault(owner, []).append(
                    (between.place(change.name), f"{change.name} = {change.new}")
                )
    for owner, lines in told.items():
        yield max(place for place, _ in lines), SequenceNote(owner, tuple(line for _, line in sorted(lines)))


def _fired(transition: TakenTransition, owner: str) -> str:
    """The transition in a few words: its composite once, its chart where the lifeline has several."""
    inside, _, source = transition.source.rpartition(".")
    chart = "" if transition.chart == owner else f"{transition.chart}: "
    if inside and transition.order and transition.target.startswith(f"{inside}."):
        short = replace(transition, source=source, target=transition.target[len(inside) + 1 :])
        return f"{chart}{inside}: {_whole(start_of(short))}"
    return f"{chart}{_whole(start_of(transition))}"


def _whole(told: str) -> str:
    """With the number of the transition on one line."""
    return told.replace("(transition ", "(transition\N{NO-BREAK SPACE}")
