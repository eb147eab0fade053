"""Paths of transitions through junctions: which is taken, and what is done on the way."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.checker.drawn.grammar.syntax import Expression, Member, Name
from rovercheck.checker.drawn.lower.chart_words import WordWriter
from rovercheck.checker.drawn.lower.exclusive import exclude
from rovercheck.checker.drawn.lower.joints import joints_of
from rovercheck.checker.drawn.lower.names import TextScope
from rovercheck.checker.drawn.lower.symbols import NotLowered, folded, single_of
from rovercheck.checker.drawn.parsed import JunctionNode, StateNode, TransitionNode
from rovercheck.spec_model.lang.expr import TRUE, Const, Expr, Var, any_of, const

MOST_VISITS = 1_000
"""Times that a path goes through one junction, where each is sure."""
TransitionPath = list[TransitionNode]


@dataclass(frozen=True)
class _PathSearch:
    """A search for paths: ``done`` is raised where one is found, ``complete`` says what it does then.

    In a flow chart of a function a path also ends in a junction, and actions are done at once.  ``joint`` is
    where all paths from a junction come together, which raises ``done``, too.
    """

    scope: TextScope
    complete: Callable[[TransitionPath], None]
    done: Var
    in_function: bool
    joints: Mapping[JunctionNode, JunctionNode]
    joint: JunctionNode | None = None


class PathWriter(WordWriter):
    """The paths of one chart."""

    _sure = False
    """Whether it is the same in every run that the transition looked at last is valid, or is not."""

    def _search(
        self, transitions: Sequence[TransitionNode], scope: TextScope,
        complete: Callable[[TransitionPath], None], function: StateNode | None = None,
    ) -> None:  # fmt: skip
        """Try paths in order; ``complete`` is what the first one does that leads to a state.

        ``function`` is the flow chart of a function, if they are in one.
        """
        if not transitions:
            return
        joints = {} if function is None else joints_of(function)
        with self.writer.until("searched") as done:
            self._try(transitions, [], _PathSearch(scope, complete, done, function is not None, joints))

    def _try(self, transitions: Sequence[TransitionNode], path: TransitionPath, search: _PathSearch) -> None:
        for number, one in enumerate(transitions, 1):
            if self.writer.dead:
                return
            valid = self._valid(one, search.scope)
            later = () if search.in_function or isinstance(valid, Const) else transitions[number:]
            self.writer.choose(
                valid,
                partial(self._follow, one, path, search, (valid, later)),
                partial(self._note_tested, one, False),
            )

    def _note_tested(self, one: TransitionNode, valid: bool) -> None:
        if one.label.guard is not None:
            marker = self.view.tested_marker(one, valid)
            self.writer.assign(marker, TRUE)
            self.writer.known.pop(marker.name, None)

    def _note_rivals(
        self, one: TransitionNode, holds: Expr, later: Sequence[TransitionNode], scope: TextScope
    ) -> None:
        """Note where a transition that is tested later is valid as well, and does something else.

        One whose condition may do something, as a call of a function, is not tested for that; one without a
        condition is what else happens.
        """
        for other in later:
            one_label, label = one.label, other.label
            alike = one.target is other.target and (
                (one_label.condition_actions, one_label.transition_actions)
                == (label.condition_actions, label.transition_actions)
            )
            if alike or (label.guard is not None and self._is_felt(label.guard, scope)):
                continue
            with suppress(NotLowered):  # which is told where it is tested
                valid = self._valid(other, scope)
                if not isinstance(valid, Const) and not exclude(holds, valid):
                    self.writer.mark(self.view.rivals_marker(one, other), valid)

    def _follow(
        self, one: TransitionNode, path: TransitionPath, search: _PathSearch,
        rivals: tuple[Expr, Sequence[TransitionNode]],
    ) -> None:  # fmt: skip
        self._note_tested(one, True)
        sure = one.label.guard is None or self._sure
        self._note_rivals(one, *rivals, search.scope)
        with self._told(one):
            self.run(one.label.condition_actions, search.scope)
            if search.in_function:
                self.run(one.label.transition_actions, search.scope)
        if self.writer.dead or one.target is None:
            return
        longer = [*path, one]
        if isinstance(one.target, StateNode) or one.target.history:
            search.complete(longer)  # which ends the search with all that is around it
            return
        self._go_on(one.target, longer, search, sure)

    def _go_on(self, at: JunctionNode, path: TransitionPath, search: _PathSearch, sure: bool) -> None:
        """From a junction on, to which a path has led."""
        if at is search.joint:
            self.writer.end(search.done)
            return
        if not at.outgoing:
            if search.in_function:
                search.complete(path)
            self.writer.end(search.done)
            return
        visits = sum(1 for other in path[:-1] if other.target is at)
        most = MOST_VISITS if sure else self.table.visits
        if visits >= most:
            self.table.met |= set() if sure else {"visits"}
            where = f"junction {at.ssid} of {path[-1].holder.path}"
            self.writer.fault(f"a path may go through {where} more than {most:,} times")
            return
        joint = search.joints.get(at) if len(at.outgoing) > 1 else None
        if joint is None or joint is search.joint:
            self._try(at.outgoing, path, search)
            return
        with self.writer.until("joined") as joined:
            self._try(at.outgoing, path, replace(search, joint=joint, done=joined))
        if not self.writer.dead:
            last = next(one for one in self.chart.transitions if one.target is joint)
            self._go_on(joint, [*path, last], search, sure=True)

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
