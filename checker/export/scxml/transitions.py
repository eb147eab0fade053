"""The transitions of a state: each path through junctions is one of SCXML, tested in the order of the chart.

Where something happens before a path is known to be complete, or before states are left, a transition
without target does it, and the state goes on at an event of its own: condition actions before further guards
or exit actions, and whatever follows a send.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from xml.etree.ElementTree import Element

from rovercheck.checker.export.scxml.content import (
    Content,
    ContentWriter,
    comment,
    element,
    raised,
    refuse_sends,
    sends,
)
from rovercheck.checker.export.scxml.moments import Arrival, Frame, Moment
from rovercheck.checker.export.scxml.paths import ChartPaths, scope_of, within
from rovercheck.checker.export.scxml.turns import ChartTurns
from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.chart import Path, Transition
from rovercheck.spec_model.lang.expr import Const, Expr, all_of
from rovercheck.spec_model.lang.fired_transition import path_label
from rovercheck.spec_model.lang.lower.timers import ChartTimers

Guards = tuple[Expr, ...]


class TransitionWriter:
    """Writes the transitions of one state, or the default ones of a composite.

    ``source`` is the state that they leave; None for default ones, which are followed by ``onward``.
    """

    def __init__(
        self, paths: ChartPaths, content: ContentWriter, timers: ChartTimers, turns: ChartTurns,
        source: Path | None, composite: Path = (), onward: Content = (),
    ) -> None:  # fmt: skip
        self.chart, self._paths, self._content = paths.chart, paths, content
        self._timers, self._turns, self._names = timers, turns, content.formulas.names
        self._source, self._composite, self._then = source, composite, onward
        self._moments: dict[object, Moment] = {}
        self.waiting: list[Element] = []
        """States in which a composite waits for the rest of a default path."""
        self.between: list[tuple[Path, Element]] = []
        """States that are active between two others, each in a composite."""
        self.arriving: list[Arrival] = []
        """States whose entry actions send something."""

    def leaving(self, holder: Element, event: str) -> None:
        """The transitions of a state, and what it does if it takes none."""
        path = self._source
        assert path is not None
        moment = Moment(holder, event)
        for word, counter in self._timers.durations.get(path, {}).values():
            assert word.arg is not None
            again = self._content([Assign(counter, Const(0, counter.sort))])
            self._write(
                moment, (~word.arg, counter != 0), None, (*again, *raised(event)), f"{word} begins anew"
            )
        self._try(moment, (Frame(self.chart.states[path].transitions, path[:-1]),))

    def default(
        self, holder: Element, event: str | None, entry: Sequence[Action] = (), condition: str = ""
    ) -> None:
        """The default transitions of the composite, from a state in which it waits for them.

        It has waited once a ``condition`` of ECMAScript holds, and then begins with its entry actions.
        """
        moment = Moment(holder, event, condition)
        frames = (Frame(self.chart.states[self._composite].default, self._composite),)
        if entry:
            self._act(moment, (), entry, lambda m: self._try(m, frames))
        else:
            self._try(moment, frames)

    def initial(self) -> Element | None:
        """The default transition as ``<initial>``, if there is one that is always taken."""
        found = self._paths.default(self._composite)
        if found is None:
            return None
        segments, end = found
        actions = [a for s in segments for a in s.do] + [a for s in segments for a in s.then]
        refuse_sends(self.chart, actions, f"a default transition of {self._of}")
        target = self._names.states[self.chart.name, end]
        made = element("initial", (element("transition", self._content(actions), target=target),))
        if label := path_label(segments):
            made.insert(0, comment(label))
        return made

    # --- finding a path ------------------------------------------------------------------------------------

    def _try(self, moment: Moment, frames: Sequence[Frame]) -> None:
        """All that may happen at a moment, the last what a state does if no path is complete."""
        for number, frame in enumerate(frames, 1):
            self._frame(moment, frame, tuple(frames[number:]), ())
        if self._source is not None and not moment.decided:
            self._during(moment, self._source)

    def _frame(self, moment: Moment, frame: Frame, later: tuple[Frame, ...], guards: Guards) -> None:
        for number, segment in enumerate(frame.segments, 1):
            if moment.decided:
                return
            rest = (replace(frame, segments=frame.segments[number:]), *later)
            self._segment(moment, frame, segment, rest, (*guards, *self._guards(segment)))

    def _guards(self, segment: Transition) -> Guards:
        heard = () if segment.event is None else (self._turns.heard(segment.event, self._source or ()),)
        guard = () if segment.guard is None else (self._timers.plainly(segment.guard, self._source),)
        return (*heard, *guard)

    def _segment(
        self, moment: Moment, frame: Frame, segment: Transition, later: tuple[Frame, ...], guards: Guards
    ) -> None:
        """One segment; ``later`` is tested if it completes no path."""
        sure = self._paths.sure(frame.level, segment)
        if sure is not None:
            segments, end = sure
            self._complete(moment, guards, (*frame.so_far, *segments), end, segments)
            return
        target = self._paths.target(frame.level, segment)
        onward = Frame(self.chart.junctions[target].transitions, target[:-1], (*frame.so_far, segment))
        if segment.do:
            label, frames = path_label(onward.so_far), (onward, *later)
            again = id(moment.holder), *(one.key for one in frames)
            self._act(moment, guards, segment.do, lambda m: self._try(m, frames), label, again)
        else:
            self._frame(moment, onward, later, guards)

    # --- taking it -----------------------------------------------------------------------------------------

    def _complete(
        self, moment: Moment, guards: Guards, segments: tuple[Transition, ...], end: Path,
        undone: tuple[Transition, ...] | None = None,
    ) -> None:  # fmt: skip
        """A path that is complete; the condition actions of those segments that are ``undone`` are to run."""
        do = [a for s in (segments if undone is None else undone) for a in s.do]
        then = [a for s in segments for a in s.then]
        label = path_label(segments)
        left = () if self._source is None else self._source[: len(self._scope(end)) + 1]
        if left:
            self._refuse_exits(left)
            do += self.chart.states[left].exit if sends(self.chart.states[left].exit) else ()
        elif sends(then):
            do, then = do + then, []  # nothing is left
        if do and (sends(do) or (left and self._paths.waits_for_exit(do, left))):
            self._act(moment, guards, do, lambda m: self._leave(m, (), [], then, end, label), label)
        else:
            self._leave(moment, guards, do, then, end, label)

    def _leave(
        self,
        moment: Moment,
        guards: Guards,
        do: Sequence[Action],
        then: Sequence[Action],
        end: Path,
        label: str,
    ) -> None:
        """What is left, then transition actions; where these send something, a further state waits."""
        if not sends(then):
            self._enter(moment, guards, self._content([*do, *then]), end, label)
            return
        between = element("state", id=self._names.beside(self.chart.name, self._source or (), "left"))
        self.between.append((self._scope(end), between))
        event = self._fresh()
        done = (*self._content(do), *raised(event))
        self._write(moment, guards, between.get("id"), done, label)
        self._act(Moment(between, event), (), then, lambda m: self._enter(m, (), (), end, label))

    def _enter(self, moment: Moment, guards: Guards, done: Content, end: Path, label: str) -> None:
        """What is entered, down to a state that sends something then, which does so once it is active."""
        scope = self._scope(end)
        entered = self._paths.entered(scope, end)
        onward = self._then if self._source is None else self._turns.taken(self._source, scope)
        sender = next((path for path in entered if sends(self.chart.states[path].entry)), None)
        if sender is not None:
            state, inside = self.chart.states[sender], entered[entered.index(sender) :]
            if moment.event is None or state.parallel or not all(within(p, sender) for p in inside):
                where = f"the entry action of {'.'.join((self.chart.name, *sender))}"
                refuse_sends(self.chart, state.entry, where)
            event, further = self._fresh(), within(end, sender)
            self.arriving.append(Arrival(sender, event, end if further else sender, onward))
            end, onward = sender if further else end, raised(event)
        self._write(moment, guards, self._names.states[self.chart.name, end], (*done, *onward), label)

    def arrive(self, holder: Element, event: str, end: Path) -> None:
        """The entry actions of the state that was entered, and then what is inside on the way to another."""
        path = self._composite
        state = self.chart.states[path]

        def inside(moment: Moment) -> None:
            if end != path:
                self._enter(moment, (), (), end, "")
            elif state.states:
                self._try(moment, (Frame(state.default, path),))
            else:
                self._write(moment, (), None, self._then)

        self._act(Moment(holder, event), (), state.entry, inside)

    def _scope(self, end: Path) -> Path:
        """The composite inside which a path leads."""
        return self._composite if self._source is None else scope_of(self._source, end)

    def _during(self, moment: Moment, path: Path) -> None:
        during = self.chart.states[path].during
        if sends(during):
            self._act(
                moment, (), during, lambda m: self._write(m, (), None, self._turns.inside(path)), "during"
            )
        else:
            self._write(moment, (), None, (*self._content(during), *self._turns.inside(path)))

    def _act(
        self, moment: Moment, guards: Guards, actions: Sequence[Action],
        onward: Callable[[Moment], None], label: str = "", again: object = None,
    ) -> None:  # fmt: skip
        """Actions while nothing is left yet, then what follows them, at another moment.

        What follows other actions ``again`` is written once.
        """
        before = next((n for n, a in enumerate(actions) if sends([a])), len(actions))
        rest = actions[before + 1 :]
        done = self._content(actions[:before])
        if before < len(actions) and isinstance(one := actions[before], If) and not before:
            for more, part in (((self._timers.plainly(one.condition),), one.then), ((), one.otherwise)):
                self._act(moment, (*guards, *more), (*part, *rest), onward, label, again)
            return
        known = self._moments.get(again)
        if before < len(actions) and isinstance(one := actions[before], Send):
            if moment.event is None:
                refuse_sends(self.chart, [one], f"a default transition of {self._of}")
            later = known if known and not rest else self._later(moment)
            assert later.event is not None
            self._write(moment, guards, None, (*done, *self._turns.sent(one, later.event)), label)
        else:
            rest = actions[before:]
            later = known if known and not rest else self._later(moment)
            trigger = () if later.event is None else raised(later.event)
            waits = later.holder.get("id") if later.event is None else None
            self._write(moment, guards, waits, (*done, *trigger), label)
        if rest:
            self._act(later, (), rest, onward, again=again)
        elif later is not known:
            self._moments |= {} if again is None else {again: later}
            onward(later)

    def _later(self, moment: Moment) -> Moment:
        """The moment after another one: at an event of its own, or as soon as a state waits for it."""
        path = self._composite if self._source is None else self._source
        if moment.event is not None:
            return Moment(moment.holder, self._fresh())
        waits = element("state", id=self._names.beside(self.chart.name, path, "default"))
        self.waiting.append(waits)
        return Moment(waits, None)

    def _fresh(self) -> str:
        """An event at which the state goes on."""
        path = self._composite if self._source is None else self._source
        return self._names.events(f"then {self._names.states[self.chart.name, path]}", object())

    def _write(
        self, moment: Moment, guards: Guards, target: str | None, content: Content, label: str = ""
    ) -> None:
        if moment.decided or (not guards and target is None and not content):
            return
        moment.decided = not guards
        if label:
            moment.holder.append(comment(label))
        guard = self._content.formulas(all_of(*guards)) if guards else ""
        cond = f"{moment.holds} && ({guard})" if moment.holds and guard else moment.holds or guard or None
        moment.holder.append(element("transition", content, event=moment.event, cond=cond, target=target))

    # --- what SCXML has not --------------------------------------------------------------------------------

    def _refuse_exits(self, left: Path) -> None:
        """Only what is left last may send something then: it does so before."""
        for path, state in self.chart.states.items():
            if within(path, left) and (path != left or state.states):
                refuse_sends(
                    self.chart, state.exit, f"the exit action of {'.'.join((self.chart.name, *path))}"
                )

    @property
    def _of(self) -> str:
        return ".".join((self.chart.name, *(self._source or self._composite)))


__all__ = ["TransitionWriter"]
