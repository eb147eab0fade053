"""Paths of transitions through junctions: which is taken, and what is done on the way."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial

from rovercheck.checker.drawn.grammar.syntax import Expression, Member, Name
from rovercheck.checker.drawn.lower.chart_words import WordWriter
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.symbols import NotLowered, folded, single_of
from rovercheck.checker.drawn.parsed import StateNode, TransitionNode
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Var, any_of, const

MOST_VISITS = 1_000
"""Times that a path goes through one junction, where each is sure."""
TransitionPath = list[TransitionNode]


class PathWriter(WordWriter):
    """The paths of one chart."""

    _sure = False
    """Whether it is the same in every run that the transition looked at last is valid, or is not."""

    def _search(
        self, transitions: Sequence[TransitionNode], scope: TextScope,
        complete: Callable[[TransitionPath], None], in_function: bool = False,
    ) -> None:  # fmt: skip
        """Try paths in order; ``complete`` is what the first one does that leads to a state.

        ``in_function``: of a flow chart, where a path also ends in a junction and actions are done at once.
        """
        if not transitions:
            return
        with self.writer.until("searched") as done:
            self._try(transitions, [], scope, complete, done, in_function)

    def _try(
        self, transitions: Sequence[TransitionNode], path: TransitionPath, scope: TextScope,
        complete: Callable[[TransitionPath], None], done: Var, in_function: bool,
    ) -> None:  # fmt: skip
        for one in transitions:
            if self.writer.dead:
                return
            self.writer.choose(
                self._valid(one, scope),
                partial(self._follow, one, path, scope, complete, done, in_function),
                partial(self._note_tested, one, False),
            )

    def _note_tested(self, one: TransitionNode, valid: bool) -> None:
        if one.label.guard is not None:
            marker = self.view.tested_marker(one, valid)
            self.writer.assign(marker, TRUE)
            self.writer.known.pop(marker.name, None)

    def _follow(
        self, one: TransitionNode, path: TransitionPath, scope: TextScope,
        complete: Callable[[TransitionPath], None], done: Var, in_function: bool,
    ) -> None:  # fmt: skip
        self._note_tested(one, True)
        with self._told(one):
            self.run(one.label.condition_actions, scope)
            if in_function:
                self.run(one.label.transition_actions, scope)
        if self.writer.dead or one.target is None:
            return
        longer = [*path, one]
        if isinstance(one.target, StateNode) or one.target.history:
            complete(longer)  # which ends the search with all that is around it
            return
        if not one.target.outgoing:
            if in_function:
                complete(longer)
            self.writer.end(done)
            return
        visits = sum(1 for other in path if other.target is one.target)
        sure = one.label.guard is None or self._sure
        most = MOST_VISITS if sure else self.table.visits
        if visits >= most:
            self.table.met |= set() if sure else {"visits"}
            where = f"junction {one.target.ssid} of {one.holder.path}"
            self.writer.fault(f"a path may go through {where} more than {most:,} times")
            return
        self._try(one.target.outgoing, longer, scope, complete, done, in_function)

    def _valid(self, one: TransitionNode, scope: TextScope) -> Expr:
        with self._told(one):
            label = one.label
            events = (
                folded(any_of(*(self._occurs(event, scope) for event in label.events)))
                if label.events
                else TRUE
            )
            if label.guard is None or (isinstance(events, Const) and not events.value):
                self._sure = isinstance(events, Const)
                return events
            if isinstance(events, Const):
                made = self.condition(label.guard, scope)
            else:
                made = self.decided_by("&&", events, label.guard, scope)
            self._sure = isinstance(made, Const)
            return made

    @contextmanager
    def _told(self, one: TransitionNode) -> Iterator[None]:
        """What has no formula is told with its transition."""
        try:
            yield
        except NotLowered as error:
            text = str(error)
            raise NotLowered(text if "(SSID" in text else f"{one}: {text}") from error

    def _occurs(self, event: Expression, scope: TextScope) -> Expr:
        """Whether an event is the current one, or a temporal condition holds."""
        match event:
            case Name("tick" | "wakeup" as name) if not self._is_event(name, scope):
                return const(not self._is_nested)
            case Name(name) | Member(_, name):
                return const(bool(name) and scope.event == name)
        found = self.word(event, scope)
        if found is None:
            raise NotLowered("it is neither an event nor a time")
        return single_of(found).expr

    def _fired(self, path: TransitionPath, source: StateNode | None) -> None:
        marker = self.view.marker(path, source, self._event)
        self.writer.assign(marker, TRUE)
        self.writer.known.pop(marker.name, None)


__all__ = ["PathWriter", "TransitionPath"]
