"""The texts of a drawn chart as formulas and actions of the language."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial

from rovercheck.checker.drawn.charts.substitution import actions_after, condition_after
from rovercheck.checker.drawn.charts.tidy import tidied, tidied_actions
from rovercheck.checker.drawn.charts.words import EDGES, SpanWords, changed
from rovercheck.checker.drawn.grammar.actions import ActionStatement
from rovercheck.checker.drawn.grammar.syntax import Applied, BinaryOperation, Expression, Member, Name
from rovercheck.checker.drawn.grammar.text import text_of
from rovercheck.checker.drawn.lower.conversions import as_number
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.machine import ChartWriter
from rovercheck.checker.drawn.lower.names import TextScope, datum_in, function_in, state_in, words
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    NotLowered,
    Symbolic,
    SymbolicScalar,
    constant_of,
    folded,
    single_of,
    truth,
)
from rovercheck.checker.drawn.lower.times import LIMITS
from rovercheck.checker.drawn.lower.view import ChartView
from rovercheck.checker.drawn.parsed import FunctionNode, ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.spec_model.lang.action import Action, Assign, If, Send, expressions
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Named, Temporal, Var, When
from rovercheck.spec_model.lang.system import Statement
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import nodes, plain, structure

_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}


class ChartTexts(ChartWriter):
    """The texts of one chart, each by itself: what a guard or a list of actions says, whatever was before.

    ``event`` is the input event in which the chart executes, if it has one.
    """

    keeps_names = True
    """Whether constants and parameters are shown by their names."""

    def __init__(
        self, chart: ParsedChart, view: ChartView, table: DataTable, writer: ProgramWriter, step: str,
        named: Mapping[str, str], data_names: Callable[[DrawnData, StateNode], str],
    ) -> None:  # fmt: skip
        super().__init__(chart, view, table, writer, step, named, data_names)
        length: Fraction | None = None
        with suppress(ValueError, ZeroDivisionError):  # as ``auto``
            length = Fraction(step.strip())
        self._spans = SpanWords(length)
        self._plain = states_only(chart, view)
        self._sent: dict[str, Send] = {}
        self._calls: dict[str, object] = {}
        self._own = dict(writer.temporaries)
        self.kept_variables: dict[str, Var] = {}
        self.event = ""

    # --- a text --------------------------------------------------------------------------------------------

    def guard(self, expression: Expression, node: StateNode) -> Expr:
        """A condition that is tested on a way from a state.  Raises ``NotLowered``."""
        self._begin()
        made = self.condition(expression, self._here(node))
        return self._named_once(
            tidied(condition_after(self.writer.written(made), made, self.writer.temporaries))
        )

    def word_of(self, expression: Expression, node: StateNode) -> Expr:
        """A time that stands where an event may.  Raises ``NotLowered``."""
        self._begin()
        found = self.word(expression, self._here(node))
        if found is None:
            raise NotLowered("it is neither an event nor a time")
        return tidied(single_of(found).expr)

    def actions(self, statements: Sequence[ActionStatement], node: StateNode) -> tuple[Action, ...]:
        """A list of actions.  Raises ``NotLowered``."""
        return self.written(partial(self.run, statements, self._here(node)))

    def written(self, write: Callable[[], None]) -> tuple[Action, ...]:
        """What is written as actions.  Raises ``NotLowered``."""
        self._begin()
        write()
        rows = self.writer.written()
        made = actions_after(rows, self.writer.temporaries, self._sent)
        self.refuse_times(*expressions(made))
        self.kept_variables |= {
            name: var for name, var in self.writer.temporaries.items() if name in _named(made)
        }
        return tuple(map(self._calls_once, tidied_actions(tuple(self._with_sends(made)))))

    def flow(self, node: StateNode) -> tuple[Action, ...]:
        """The flow chart in a state, whose transitions only act.  Raises ``NotLowered``."""
        return self.written(lambda: self._search(node.inner, self._here(node), lambda path: None))

    def flow_chart(self) -> tuple[Action, ...]:
        """A chart without states, which does the same in every step.  Raises ``NotLowered``."""
        return self.written(self._flow)

    def activity(self, one: DrawnData) -> Expr:
        """What an output tells of the active states."""
        return self._activity(one)

    def reset(self, one: DrawnData, node: StateNode) -> None:
        """Give a datum its first value."""
        self._reset(one, self._name_of(one, node))

    def _fired(self, path: object, source: object) -> None:
        """Nothing is noted: a chart of the language tells by itself what fires."""

    def _note_tested(self, one: object, valid: bool) -> None:
        """The same of what is tested."""

    def note_overflow(self, what: str, condition: Expr) -> None:
        """Nor what does not fit its type."""

    @staticmethod
    def refuse_times(*formulas: Expr) -> None:
        """Raises ``NotLowered`` for a time of a state where the language has none."""
        for node in nodes(*formulas):
            if isinstance(node, Temporal) and node.when in (When.AFTER, When.DURATION):
                raise NotLowered(
                    f"`{node}` stands where no state is left: ask for it on a transition that leaves one"
                )

    def _declared(self, one: DrawnData, node: StateNode, function: FunctionNode | None = None) -> Symbolic:
        """A constant or a parameter keeps its name."""
        made = super()._declared(one, node, function)
        if one.scope not in ("constant", "parameter") or not self.keeps_names:
            return made
        if not isinstance(made, SymbolicScalar) or not isinstance(made.expr, Const):
            return made
        return SymbolicScalar(made.kind, Named(self._name_of(one, node), made.expr))

    def _calls_once(self, action: Action) -> Action:
        match action:
            case Assign(var, value):
                return Assign(var, self._named_once(value))
            case If(condition, then, otherwise):
                some = (tuple(map(self._calls_once, part)) for part in (then, otherwise))
                return If(self._named_once(condition), *some)
        return action

    def _named_once(self, expr: Expr) -> Expr:
        """The formula without names that stand for another formula elsewhere in the chart."""
        match expr:
            case Named(name, body):
                inner = self._named_once(body)
                if self._calls.setdefault(name, structure(inner)) != structure(inner):
                    return inner
                return expr if inner is body else Named(name, inner)
            case Temporal(when, arg, span, strict) if arg is not None:
                return Temporal(when, self._named_once(arg), span, strict)
            case Apply(op, args, sort):
                made = tuple(map(self._named_once, args))
                same = all(one is other for one, other in zip(made, args, strict=True))
                return expr if same else Apply(op, made, sort)
        return expr

    def _begin(self) -> None:
        """A new text: of data nothing is known at its start."""
        self.writer = self.writer.fresh(self._own)
        self._stack = [(0, self.event)]

    def _here(self, node: StateNode) -> TextScope:
        return TextScope(node, self.rules, self.event, keeper=self.writer.name)

    def _with_sends(self, rows: Sequence[object]) -> Iterator[Action]:
        for row in rows:
            match row:
                case Assign(var) if var.name in self._sent:
                    yield self._sent[var.name]
                case Assign():
                    yield row
                case If(condition, then, otherwise):
                    yield If(condition, tuple(self._with_sends(then)), tuple(self._with_sends(otherwise)))

    # --- what the language says otherwise ------------------------------------------------------------------

    def active(self, node: StateNode) -> Expr:
        """Whether a state is active, in the words of the language."""
        return TRUE if node.parent is None else self._plain.active_path(self.view.paths[node.ssid])

    def value(self, expression: Expression, scope: TextScope) -> Symbolic:
        """The value of an expression; a time that is compared with a constant is one of the words."""
        if isinstance(expression, BinaryOperation) and expression.operator in _MIRRORED:
            for one, other, sign in (
                (expression.left, expression.right, expression.operator),
                (expression.right, expression.left, _MIRRORED[expression.operator]),
            ):
                found = self._counted(one, other, sign, scope)
                if found is not None:
                    return truth(found)
        return super().value(expression, scope)

    def several(self, expression: Expression, scope: TextScope) -> list[Symbolic]:
        """All values of a call; what a function of the chart gives has the call as its name."""
        found = super().several(expression, scope)
        match expression:
            case Applied(Name(name)) if len(found) == 1 and self._is_called(name, scope):
                [value] = found
                if isinstance(value, SymbolicScalar) and not isinstance(value.expr, Const):
                    shown = text_of(expression, self.chart.language)
                    return [SymbolicScalar(value.kind, Named(shown, value.expr))]
        return found

    def _is_called(self, name: str, scope: TextScope) -> bool:
        """Whether a name is that of a function of the chart, called outside of functions."""
        return (
            not scope.function
            and not self.is_datum(name, scope)
            and function_in(scope.node, name) is not None
        )

    def _counted(self, count: Expression, limit: Expression, sign: str, scope: TextScope) -> Expr | None:
        match count:
            case Applied(Name("temporalCount" | "elapsed" as name), arguments):
                unit = words(arguments[0])[0] if arguments else "sec"

                def at_least(span: Span) -> Expr:
                    return Temporal(When.AFTER, None, span)

            case Applied(Name("duration" | "count" as name), (condition, *rest)):
                unit = "tick" if name == "count" else words(rest[0])[0] if rest else "sec"
                holds = self.condition(condition, scope)

                def at_least(span: Span) -> Expr:
                    return Temporal(When.DURATION, holds, span)

            case _:
                return None
        if self.is_datum(name, scope):
            return None
        return self._spans.counted(sign, self._constant(limit, name, scope), unit, at_least)

    def _constant(self, expression: Expression, word: str, scope: TextScope) -> Fraction:
        found = constant_of(plain(as_number(single_of(self.value(expression, scope)))))
        if found is None:
            raise NotLowered(f"{word} with a time that is no constant")
        return found

    def word(self, expression: Expression, scope: TextScope) -> Symbolic | None:
        """Times, changes, and whether a state is active."""
        match expression:
            case Applied(Name("in"), (state,)):
                return truth(self.active(state_in(scope.node, words(state))))
            case Applied(Name(name), (limit, Name(unit))) if name in LIMITS:
                time = self._constant(limit, name, scope)
                after = self._spans.after(time, unit)
                if name == "at":
                    return truth(self._at_once(time, unit, after))
                return truth(after if name == "after" else folded(~after))
            case Applied(Name("hasChanged" | "hasChangedTo" | "hasChangedFrom" as name), (of, *values)):
                wanted = self._beside(of, values[0], scope) if values else None
                return truth(changed(name, self._watched(of, scope).expr, wanted))
            case Applied(Name(name), (of,)) if name in EDGES:
                return truth(EDGES[name](as_number(self._watched(of, scope))))
            case Applied(Name("every" | "temporalCount" | "elapsed" | "duration" | "count" as name)):
                raise NotLowered(f"{name} in other words than a comparison with a constant time")
        return None

    def _at_once(self, time: Fraction, unit: str, after: Expr) -> Expr:
        steps = self._spans.steps(time, unit)
        if steps.denominator != 1:
            raise NotLowered("`at` a time that is no whole number of steps")
        return folded(after & folded(~self._spans.after(steps + 1, "tick")))

    def _watched(self, of: Expression, scope: TextScope) -> SymbolicScalar:
        if not isinstance(of, Name) or datum_in(scope.node, of.name) is None:
            raise NotLowered("changes are seen of a datum: name one")
        return single_of(self.value(of, scope))

    def _beside(self, of: Expression, value: Expression, scope: TextScope) -> Expr:
        now, wanted = self._watched(of, scope), single_of(self.value(value, scope))
        return wanted.expr if wanted.expr.sort == now.expr.sort else as_number(wanted)

    def sent(self, expression: Expression, scope: TextScope) -> bool:
        """A directed send; others have no word in the language."""
        owner: Expression | None = None
        match expression:
            case Applied(Name("send"), (event, *to)) if len(to) < 2:
                name = words(event)[-1]
                owner = to[0] if to else event.owner if isinstance(event, Member) else None
            case Name(name) if self._is_event(name, scope):
                pass
            case Member(owner, name) if self._is_event(name, scope):
                pass
            case _:
                return False
        if name in self.given:
            raise NotLowered(f"{name} is an event to other blocks: write to a datum")
        if owner is None:
            raise NotLowered(f"{name} is sent to the whole chart: send it to a state, send({name}, STATE)")
        receiver = state_in(scope.node, words(owner))
        path = ".".join(self.view.paths[receiver.ssid])
        marker = f"send {name} {path}"
        self._sent[marker] = Send(name, path)
        self.writer.assign(Var(marker, boolean, 0, hidden=True), TRUE)
        self.writer.known.clear()
        return True


class UnnamedTexts(ChartTexts):
    """The same with the values of constants in place of their names, where something depends on them."""

    keeps_names = False


def states_only(chart: ParsedChart, view: ChartView) -> Chart:
    """A chart of the states that are drawn, in which formulas ask what is active."""

    def made(node: StateNode) -> State:
        return State(view.name(node), states=[made(one) for one in node.children], parallel=node.parallel)

    root = chart.root
    return Chart(view.name_of_chart, [made(one) for one in root.children], parallel=root.parallel)


def _named(rows: Sequence[Statement | Action]) -> set[str]:
    """The variables that some statements read or write."""
    return {name for row in rows if isinstance(row, Assign | If) for name in row.written | row.read_inside}


__all__ = ["ChartTexts", "UnnamedTexts", "states_only"]
