"""What states and transitions do as labels: in the engineer's own words where they say the same here."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from rovercheck.checker.export.source.layout import WIDTH
from rovercheck.spec_model.lang.action import Action, Assign, If, Send
from rovercheck.spec_model.lang.chart import Chart, State, Transition
from rovercheck.spec_model.lang.domain import Domain, Enum
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.stateflow.message import LabelError
from rovercheck.spec_model.lang.stateflow.names import LabelNames
from rovercheck.spec_model.lang.stateflow.statements import state_of, transition_of
from rovercheck.spec_model.lang.walk import structure, variables

LONGEST = 66
"""Letters of a label in one line."""


@dataclass(frozen=True)
class WrittenLabel:
    """A label in lines; ``comment`` are those of what the engineer has written, where that is another text.

    No lines: it says nothing.  ``None`` in place of one: no label says what is meant.
    """

    lines: tuple[str, ...] = ()
    comment: tuple[str, ...] = ()


class LabelWriter:
    """Writes the labels of one chart, with the names that it knows."""

    def __init__(self, chart: Chart, names: LabelNames) -> None:
        self._chart, self._names = chart, names
        self._states = {
            chart.location(path).name: path
            for path, state in chart.states.items()
            if state.states and not state.parallel
        }

    def state(self, state: State, drawn: str) -> WrittenLabel | None:
        """The label of what a state does, which is ``drawn`` as the engineer has written it."""
        wanted = (state.entry, state.during, state.exit)

        def says(label: str) -> bool:
            found = state_of(label, self._names)
            return self._alike((found.entry, found.during, found.exit), wanted)

        if not any(wanted):
            return WrittenLabel((), _comment(drawn))
        own = [line.rstrip().removesuffix(";") for line in drawn.strip().splitlines()]
        lines = tuple(self._sections(wanted))
        return self._chosen(tuple(filter(None, own)), lines, says)

    def transition(self, one: Transition, drawn: str) -> WrittenLabel | None:
        """The same of a transition."""

        def says(label: str) -> bool:
            found = transition_of(label, self._names)
            return (
                found.event == one.event
                and _same(found.guard, one.guard)
                and self._alike((found.do, found.then), (one.do, one.then))
            )

        if is_silent(one):
            return WrittenLabel((), _comment(drawn))
        own = tuple(filter(None, (line.strip() for line in drawn.strip().splitlines())))
        return self._chosen(own, tuple(self._label(one)), says)

    def _chosen(
        self, own: tuple[str, ...], lines: tuple[str, ...], says: Callable[[str], bool]
    ) -> WrittenLabel | None:
        """The engineer's text if it says the same, else the one of this tool, if that does."""
        if own and len(own) == 1 and self._is(own, says):
            return WrittenLabel(own)
        if own and self._is(own, says) and all(len(line) < WIDTH for line in own):
            return WrittenLabel(own)
        joined = (" ".join(lines),) if sum(map(len, lines)) <= LONGEST else lines
        for some in (joined, lines):
            if self._is(some, says):
                same = _bare("\n".join(own)) == _bare("\n".join(some))
                return WrittenLabel(some, () if same else _in_one_line(own))
        return None

    @staticmethod
    def _is(lines: Sequence[str], says: Callable[[str], bool]) -> bool:
        label = "\n".join(lines)
        plain = all(line.isprintable() for line in lines) and "\\" not in label
        if not plain or '"""' in label or label.endswith('"'):
            return False
        try:
            return says(label)
        except (LabelError, RecursionError):
            return False

    # --- labels of this tool -------------------------------------------------------------------------------

    def _sections(self, wanted: Sequence[tuple[Action, ...]]) -> Iterator[str]:
        every = [*zip(("entry", "during", "exit"), wanted, strict=True)]
        short = "; ".join(
            f"{name}: {'; '.join(map(self._action, actions))}" for name, actions in every if actions
        )
        if len(short) <= LONGEST:
            yield short
            return
        for name, actions in every:
            for number, action in enumerate(actions):
                before = f"{name}: " if number == 0 else " " * (len(name) + 2)
                yield f"{before}{self._action(action)}"

    def _label(self, one: Transition) -> Iterator[str]:
        head = one.event or ""
        if one.guard is not None:
            guard = f"[{self._formula(one.guard)}]"
            head = f"{head} {guard}".strip()
        do, then = ("; ".join(map(self._action, actions)) for actions in (one.do, one.then))
        parts = [head, f"{{{do}}}" if do else "", f"/ {then}" if then else ""]
        for part in filter(None, parts):
            yield from _broken(part)

    def _action(self, action: Action) -> str:
        match action:
            case Assign(var, value):
                return f"{var.name} = {self._formula(value)}"
            case If(condition, then, otherwise):
                shown = f"if {self._formula(condition)} {{{'; '.join(map(self._action, then))}}}"
                more = f" else {{{'; '.join(map(self._action, otherwise))}}}" if otherwise else ""
                return shown + more
            case Send(event, receiver):
                return f"send({event}, {self._short(tuple(receiver.split('.')))})"

    def _formula(self, expr: Expr) -> str:
        return text(self._with_places(expr))

    def _with_places(self, expr: Expr) -> Expr:
        """A formula in which an active state of the chart itself is shown as ``in(STATE)``."""
        match expr:
            case Apply(Op.EQ, (Var(name), Const(1))) if name == self._chart.entered.name:
                region = self._chart.root.states[0].name
                return Named(f"in({self._short((region,))})", expr)
            case Apply(Op.EQ | Op.NE as op, (Var(name, Domain(Enum() as kind)), Const(value)), sort) if (
                name in self._states
            ):
                path = (*self._states[name], kind.member(value))
                if path in self._chart.states:
                    shown = Named(f"in({self._short(path)})", Apply(Op.EQ, expr.args, sort))
                    return shown if op is Op.EQ else Apply(Op.NOT, (shown,), sort)
                return expr
            case Apply(op, args, sort):
                return Apply(op, tuple(map(self._with_places, args)), sort)
            case Temporal(when, arg, span, strict) if arg is not None:
                return Temporal(when, self._with_places(arg), span, strict)
        return expr

    def _short(self, path: tuple[str, ...]) -> str:
        """A state by as few names as will do."""
        for start in range(len(path) - 1, -1, -1):
            ends = [one for one in self._chart.states if one[-(len(path) - start) :] == path[start:]]
            if len(ends) == 1:
                return ".".join(path[start:])
        return ".".join(path)

    def _alike(self, some: Sequence[Sequence[Action]], others: Sequence[Sequence[Action]]) -> bool:
        return all(
            len(one) == len(other) and all(map(self._alike_actions, one, other))
            for one, other in zip(some, others, strict=True)
        )

    def _alike_actions(self, one: Action, other: Action) -> bool:
        match one, other:
            case Assign(var, value), Assign(same, new):
                return var.name == same.name and _same(value, new)
            case If(condition, then, otherwise), If(also, do, instead):
                return _same(condition, also) and self._alike((then, otherwise), (do, instead))
            case Send(event, receiver), Send(sent, to):
                return event == sent and self._chart.path(receiver) == self._chart.path(to)
        return False

    def asks_for_states(self, *formulas: Expr) -> bool:
        """Whether some formulas ask for an active state of the chart itself."""
        return bool(variables(*formulas).keys() & {*self._states, self._chart.entered.name})


def is_silent(one: Transition) -> bool:
    """Whether a transition is taken without a condition, and does nothing."""
    return one.event is None and one.guard is None and not one.do and not one.then


def _broken(part: str) -> Iterator[str]:
    """A long part of a label in lines."""
    rest = part
    while len(rest) > WIDTH:
        cuts = [rest.rfind(sign, 20, WIDTH - 20) for sign in (" && ", " || ", "; ")]
        cut = max(cuts)
        if cut < 0:
            break
        end = cut + 1 if rest[cut] == ";" else cut
        yield rest[:end]
        rest = f" {rest[end:].strip()}"
    yield rest


_CONVERTED = re.compile(r"\b(?:u?int(?:8|16|32|64)|double|single|boolean|logical)\((\w+(?:\.\w+)?)\)")
_SECTION = re.compile(r"\s*[a-z]+(?:\s*,\s*[a-z]+)*\s*:")
_REMEMBERED = re.compile(r"ex:[\w.]+\.last=\w+$")
"""What is done for a history, at the end of the text of a state."""


def _bare(label: str) -> str:
    """A label without what does not change its meaning, nor what a reader takes it for."""
    made = _CONVERTED.sub(r"\1", re.sub(r"[ \t\n]+|;", "", label))
    made = made.replace("~=", "!=").replace("~", "!")
    made = made.replace("entry:", "en:").replace("during:", "du:").replace("exit:", "ex:")
    return _REMEMBERED.sub("", made).removeprefix("en:")


def _comment(drawn: str) -> tuple[str, ...]:
    return _in_one_line([line.strip() for line in drawn.strip().splitlines() if line.strip()])


def _in_one_line(lines: Sequence[str]) -> tuple[str, ...]:
    """Lines of a label as one, where that is short and no comment ends in it."""
    joined = " ".join(line.strip() for line in lines)
    ended = any(sign in line for line in lines[:-1] for sign in ("%", "//"))
    sections = any(_SECTION.match(line) for line in lines[1:])
    return tuple(lines) if ended or sections or len(joined) > LONGEST or not joined else (joined,)


def _same(one: Expr | None, other: Expr | None) -> bool:
    if one is None or other is None:
        return one is other
    return structure(one) == structure(other)


__all__ = ["LabelWriter", "WrittenLabel", "is_silent"]
