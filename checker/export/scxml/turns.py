"""Whose turn it is: an event for each level of states, raised by whoever had the turn before.

A step is one macrostep.  At most one event waits at any moment, so that data written by a region are seen by
the next one, an outer state is asked before what is inside it, and a state that is entered in a step has no
turn in it.  A send gives its receiver the turn, and gets it back.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.export.scxml.content import Content, ContentWriter, chosen, raised
from rovercheck.spec_model.lang.action import Assign, Send, each_action
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var

NO_EVENT = "no_event"


@dataclass
class _Receiver:
    """A state that is sent events: the one that it is executed with, who sent it, and where those go on."""

    event: Var
    sender: Var
    resumed: list[str] = field(default_factory=list)


class ChartTurns:
    """The turns of one chart.

    ``end`` is what follows its step; states in ``idle`` do nothing of their own when it is their turn.
    """

    def __init__(self, chart: Chart, content: ContentWriter, idle: Collection[Path], end: Content) -> None:
        self.chart, self._content, self._idle, self._end = chart, content, idle, end
        self._names = content.formulas.names
        sent = [a for a in each_action(chart.all_actions) if isinstance(a, Send)]
        events = enumeration(f"event of {chart.name}", [NO_EVENT, *dict.fromkeys(a.event for a in sent)])
        self._receivers = dict[Path, _Receiver]()
        self._left: dict[str, tuple[list[Path], Path]] = {}
        for path in dict.fromkeys(chart.path(a.receiver) for a in sent):
            name = ".".join((chart.name, *path))
            doc = f"the event with which {name} is executed"
            sender = Var(f"{name}.sender", integer(0, len(sent)), 0, f"who waits for {name} to be executed")
            self._receivers[path] = _Receiver(Var(f"{name}.event", events, 0, doc), sender)

    @property
    def variables(self) -> Iterator[Var]:
        """What is remembered of sends."""
        for one in self._receivers.values():
            yield from (one.event, one.sender)

    # --- events --------------------------------------------------------------------------------------------

    def event(self, path: Path) -> str:
        """The event at which a state has its turn: that of its level; a region has its own."""
        region = self.chart.states[path[:-1]].parallel
        return self._named("at", path) if region else self.event_inside(path[:-1])

    def event_inside(self, path: Path) -> str:
        """The event at which the active state inside has its turn."""
        return self._named("in", path)

    def _named(self, word: str, path: Path) -> str:
        return self._names.events(f"{word} {self._names.states[self.chart.name, path]}")

    def heard(self, event: str, path: Path) -> Expr:
        """The condition that a state is executed with an event."""
        around = [self._receivers[one] for one in _around(path) if one in self._receivers]
        found: Expr = FALSE
        for one in around:  # the outermost first; an inner one was sent to later
            is_it = one.event == event
            found = is_it if found is FALSE else is_it | ((one.event == NO_EVENT) & found)
        return found

    # --- turns ---------------------------------------------------------------------------------------------

    def execute(self, path: Path) -> Content:
        """It is the turn of an active state."""
        return self.inside(path) if path in self._idle else raised(self.event(path))

    def inside(self, path: Path) -> Content:
        """A state has taken no transition, and has done what it does: it is the turn of what is inside."""
        state = self.chart.states[path]
        if state.parallel:
            return self.execute((*path, state.states[0].name))
        return raised(self.event_inside(path)) if state.states else self.after(path)

    def after(self, path: Path) -> Content:
        """A state was executed."""
        return raised(self._named("end", path)) if path in self._receivers else self._further(path)

    def _further(self, path: Path) -> Content:
        """The same of a state that was not sent to: it is the turn of the next region, if it is one."""
        if not path:
            return self._end
        above = self.chart.states[path[:-1]]
        if above.parallel and above.states[-1].name != path[-1]:
            number = [one.name for one in above.states].index(path[-1])
            return self.execute((*path[:-1], above.states[number + 1].name))
        return self.after(path[:-1])

    def taken(self, source: Path, scope: Path) -> Content:
        """A transition from a state was taken inside a composite: the rest of that is not executed."""
        if scope == source[:-1]:
            return self.after(source)
        sent_to = [p for p in _around(source)[len(scope) :] if p in self._receivers]
        if not sent_to:
            return self.after(scope)
        event = f"{self._named('left', sent_to[-1])} in {self._names.states[self.chart.name, scope]}"
        self._left[self._names.events(event)] = sent_to, scope
        return raised(self._names.events(event))

    # --- sends ---------------------------------------------------------------------------------------------

    def sent(self, send: Send, resumed: str) -> Content:
        """The receiver has the turn if it is active; then its sender goes on at an event."""
        path = self.chart.path(send.receiver)
        one = self._receivers[path]
        one.resumed.append(resumed)
        raw = one.event.domain.raw(send.event)
        told = self._content([_become(one.event, raw), _become(one.sender, len(one.resumed))])
        active = self._content.formulas.is_active(self.chart.name, path)
        return chosen(active, (*told, *self.execute(path)), raised(resumed))

    def ends(self) -> Iterator[tuple[str, Expr, Content]]:
        """What follows once receivers were executed, by event and condition, when all sends are known."""
        for path in self._receivers:
            yield from self._ends(self._named("end", path), [path], self._further(path))
        for event, (sent_to, scope) in self._left.items():
            yield from self._ends(event, sent_to, self.after(scope))

    def _ends(
        self, event: str, sent_to: Sequence[Path], further: Content
    ) -> Iterator[tuple[str, Expr, Content]]:
        """Senders go on, if one waits; of several, the one that sent to what is innermost."""
        for one in (self._receivers[path] for path in reversed(sent_to)):
            cleared = self._content([_become(one.event, 0), _become(one.sender, 0)])
            for number, resumed in enumerate(one.resumed, 1):
                yield event, one.sender == number, (*cleared, *raised(resumed))
        if further:
            yield event, TRUE, further


def _become(var: Var, raw: int) -> Assign:
    return Assign(var, Const(raw, var.sort))


def _around(path: Path) -> list[Path]:
    """What a state lies in, the outermost first, and itself."""
    return [path[:depth] for depth in range(1, len(path) + 1)]


__all__ = ["ChartTurns"]
