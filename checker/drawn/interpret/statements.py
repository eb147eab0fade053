"""Statements of charts and MATLAB functions, executed one after the other."""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import replace

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.actions import (
    ActionStatement,
    Assignment,
    BreakStatement,
    ContinueStatement,
    Evaluated,
    ForLoop,
    IfStatement,
    Increment,
    NameDeclaration,
    ReturnStatement,
    SwitchStatement,
    WhileLoop,
)
from rovercheck.checker.drawn.grammar.functions import ScriptFunction
from rovercheck.checker.drawn.grammar.syntax import Applied, Expression, Indexed, Member, Name
from rovercheck.checker.drawn.interpret.evaluate import MADE, MOST_TURNS, CallFrame, Dropped, Evaluator
from rovercheck.checker.drawn.interpret.memory import datum_of
from rovercheck.checker.drawn.interpret.operations import binary
from rovercheck.checker.drawn.interpret.values import (
    LITERAL,
    ArrayOf,
    MatlabValue,
    NumberRules,
    Scalar,
    Structure,
    array,
    double,
    each_converted,
    scalar,
    scalars,
    shape,
)
from rovercheck.checker.drawn.stores import NO_GLOBAL


class _Break(Exception): ...


class _Continue(Exception): ...


class _Return(Exception): ...


class StatementRunner(Evaluator):
    """Executes statements, and what they call."""

    def script(
        self, function: ScriptFunction, values: Sequence[MatlabValue], caller: CallFrame
    ) -> list[MatlabValue]:
        """Call a MATLAB function with these values."""
        signature = function.signature
        if len(values) > len(signature.inputs):
            raise DrawnFault(
                f"{signature.name} takes {len(signature.inputs)} values, and {len(values)} are given"
            )
        pairs = zip(signature.inputs, values, strict=False)
        local = {name: value for name, value in pairs if name is not None}
        local["nargin"] = double(len(values))
        results = frozenset(signature.outputs)
        frame = replace(caller, local=local, kept=frozenset(), results=results, calls=caller.calls + 1)
        frame.rules = NumberRules(False, caller.rules.saturates)
        self.body(function, frame)
        return [local[name] for name in signature.outputs if name in local]

    def body(self, function: ScriptFunction, frame: CallFrame) -> None:
        """Execute a function in its frame, in which the variables stay."""
        with suppress(_Return):
            self.run(function.body, frame)

    # --- statements ----------------------------------------------------------------------------------------

    def run(self, statements: Iterable[ActionStatement], frame: CallFrame) -> None:
        """Execute statements.  Raises ``DrawnFault``, and ``Dropped`` where the state was left."""
        for one in statements:
            self._statement(one, frame)

    def _statement(self, one: ActionStatement, frame: CallFrame) -> None:
        match one:
            case Assignment(targets, value, sign):
                self._assign(targets, value, sign, frame)
            case Increment(target, by):
                step = Scalar(LITERAL if frame.rules.c else "double", by)
                self._write(target, binary("+", self.value(target, frame), step, frame.rules), frame)
            case Evaluated(expression):
                if self._words.sent(expression, frame):
                    if not frame.alive():
                        raise Dropped
                else:
                    self._several(expression, frame)
            case IfStatement(branches, otherwise):
                taken = next((b.body for b in branches if self.truth(b.condition, frame)), otherwise)
                self.run(taken, frame)
            case SwitchStatement(subject, cases, otherwise):
                given = self.value(subject, frame)
                same = (c.body for c in cases if any(self._same(given, v, frame) for v in c.values))
                self.run(next(same, otherwise), frame)
            case ForLoop(variable, values):
                every = self.value(values, frame)
                rows, columns = shape(every)
                found = scalars(every)
                turns = [array(found[c::columns], rows, 1) for c in range(columns)] if rows else []
                self._loop(one, turns, variable, frame)
            case WhileLoop():
                self._loop(one, None, "", frame)
            case BreakStatement():
                raise _Break
            case ContinueStatement():
                raise _Continue
            case ReturnStatement():
                raise _Return
            case NameDeclaration("global", names):
                for name in names:
                    datum = datum_of(frame.node, name)
                    if datum is None or datum.ssid not in self.memory.shared:
                        raise DrawnFault(f"`global` {name}: {NO_GLOBAL}")
            case NameDeclaration(_, names):
                frame.kept = frame.kept | set(names)
                for name in names:
                    frame.persistent.setdefault(name, ArrayOf("double", 0, 0, ()))

    def _same(self, value: MatlabValue, case: Expression, frame: CallFrame) -> bool:
        return any(one.value == scalar(value).value for one in scalars(self.value(case, frame)))

    def _loop(
        self, one: ForLoop | WhileLoop, turns: Sequence[MatlabValue] | None, name: str, frame: CallFrame
    ) -> None:
        for number in range(MOST_TURNS if turns is None else len(turns)):
            if turns is not None:
                self._write(Name(name), turns[number], frame)
            elif isinstance(one, WhileLoop) and not self.truth(one.condition, frame):
                return
            try:
                self.run(one.body, frame)
            except _Break:
                return
            except _Continue:
                continue
        if turns is None:
            raise DrawnFault(f"a loop of more than {MOST_TURNS:,} turns")

    def _assign(
        self, targets: Sequence[Expression | None], value: Expression, sign: str | None, frame: CallFrame
    ) -> None:
        if len(targets) == 1 and targets[0] is not None:
            new = self.value(value, frame)
            if sign is not None:
                new = binary(sign, self.value(targets[0], frame), new, frame.rules)
            self._write(targets[0], new, frame)
            return
        given = self._several(value, frame)
        if isinstance(value, Applied) and value.function == Name("size"):
            given = list(scalars(given[0]))
        if len(given) < len(targets):
            raise DrawnFault(f"{len(targets)} values are taken of a function that gives {len(given)}")
        for target, one in zip(targets, given, strict=False):
            if target is not None:
                self._write(target, one, frame)

    def _write(self, target: Expression, value: MatlabValue, frame: CallFrame) -> None:
        match target:
            case Name(name):
                self._set(name, value, frame)
            case Member(owner, name):
                whole = self._held(owner, frame)
                if isinstance(whole, Structure) and whole.kind == MADE and name not in whole.elements:
                    self._write(owner, Structure(MADE, {**whole.elements, name: value}), frame)
                    return
                if not isinstance(whole, Structure) or name not in whole.elements:
                    raise DrawnFault(f"there is no element {name} to write to")
                old = whole.elements[name]
                kind = scalars(old)[0].kind if not isinstance(old, Structure) else old.kind
                made = value if isinstance(value, Structure) else each_converted(value, kind, frame.rules)
                self._write(owner, Structure(whole.kind, {**whole.elements, name: made}), frame)
            case Applied(of, indices):
                whole = self.value(of, frame)
                self._write(
                    of, self._with(whole, self._places(whole, indices, frame)[0], value, frame), frame
                )
            case Indexed(of, index):
                whole = self.value(of, frame)
                at = int(scalar(self.value(index, frame)).value) - self._first(of, frame)
                if not 0 <= at < len(scalars(whole)):
                    raise DrawnFault(f"the index {at} of {len(scalars(whole))} values")
                self._write(of, self._with(whole, [at], value, frame), frame)
            case _:
                raise DrawnFault("what is assigned to is no datum")

    def _held(self, owner: Expression, frame: CallFrame) -> MatlabValue:
        """What has an element that is written: in a script it is made by that."""
        match owner:
            case Name(name) if frame.local is not None and name not in frame.local:
                if self._is_no_datum(name, frame) or name in frame.results:
                    return Structure(MADE)
            case Member(outer, name):
                whole = self._held(outer, frame)
                if isinstance(whole, Structure) and whole.kind == MADE and name not in whole.elements:
                    return Structure(MADE)
        return self.value(owner, frame)

    def _with(
        self, whole: MatlabValue, places: Sequence[int], value: MatlabValue, frame: CallFrame
    ) -> MatlabValue:
        found, given = list(scalars(whole)), scalars(value)
        if len(given) not in (1, len(places)):
            raise DrawnFault(f"{len(given)} values are written to {len(places)} places")
        for number, at in enumerate(places):
            new = given[number if len(given) > 1 else 0]
            [found[at]] = scalars(each_converted(new, found[at].kind, frame.rules))
        return array(found, *shape(whole))

    def _set(self, name: str, value: MatlabValue, frame: CallFrame) -> None:
        if name in frame.kept:
            frame.persistent[name] = value
        elif frame.local is not None and (
            name in frame.local or name in frame.results or datum_of(frame.node, name) is None
        ):
            frame.local[name] = value
        elif (datum := datum_of(frame.node, name)) is not None:
            self.memory.write(datum.ssid, value)
        else:
            raise DrawnFault(f"there is no datum {name} to write to")


__all__ = ["StatementRunner"]
