"""Statements of charts and MATLAB functions as statements of a step, with loops unrolled."""

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import replace

from rovercheck.checker.drawn.grammar.actions import (
    ActionStatement,
    Assignment,
    BreakStatement,
    ContinueStatement,
    Evaluated,
    ForLoop,
    IfBranch,
    IfStatement,
    Increment,
    NameDeclaration,
    ReturnStatement,
    SwitchCase,
    SwitchStatement,
    WhileLoop,
)
from rovercheck.checker.drawn.grammar.functions import ScriptFunction
from rovercheck.checker.drawn.grammar.syntax import Applied, BinaryOperator, Expression, Indexed, Member, Name
from rovercheck.checker.drawn.lower.arithmetic import binary
from rovercheck.checker.drawn.lower.conversions import IntegerRules, as_number, each_converted
from rovercheck.checker.drawn.lower.expressions import ExpressionWriter
from rovercheck.checker.drawn.lower.kinds import is_structure
from rovercheck.checker.drawn.lower.names import TextScope, datum_in, refuse_other_globals
from rovercheck.checker.drawn.lower.operators import ONE, compound
from rovercheck.checker.drawn.lower.symbols import (
    MADE,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicArray,
    SymbolicScalar,
    SymbolicStructure,
    chosen,
    filled,
    flat,
    folded,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.records import DrawnData
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, any_of

MOST_TURNS = 1_000
"""Turns of a loop that are written one after the other, where each is sure to be made."""


class StatementWriter(ExpressionWriter):
    """Writes statements, and what they call."""

    @abstractmethod
    def sent(self, expression: Expression, scope: TextScope) -> bool:
        """Send the event that a statement is; whether it is one."""

    @abstractmethod
    def datum(self, one: DrawnData, value: Symbolic) -> Symbolic:
        """The cells of a datum that a value is written to: it may have no type before."""

    # --- functions -----------------------------------------------------------------------------------------

    def script(
        self, function: ScriptFunction, arguments: Sequence[Symbolic], scope: TextScope
    ) -> list[Symbolic]:
        """Call a MATLAB function."""
        signature = function.signature
        if len(arguments) > len(signature.inputs):
            raise NotLowered(
                f"{signature.name} takes {len(signature.inputs)} values, and {len(arguments)} are given"
            )
        if signature.name in scope.calls:
            raise NotLowered(f"{signature.name} calls itself: write a loop")
        key = ">".join((*scope.calls, signature.name))
        own = replace(
            scope, function=key, rules=IntegerRules(False, scope.rules.saturates), kept=set(),
            calls=(*scope.calls, signature.name), results=signature.outputs, broken=None, continued=None,
            left=None,
        )  # fmt: skip
        outer = self.writer.locals
        self.writer.locals = dict(outer)
        for name, value in zip(signature.inputs, arguments, strict=False):
            if name is not None:
                self._local(name, value, own)
        self._local("nargin", number("double", len(arguments)), own)
        with self.writer.until(f"{signature.name}_returned") as returned:
            self.run(function.body, replace(own, returned=returned))
        found = [
            self.writer.locals[f"{key}:{name}"]
            for name in signature.outputs
            if f"{key}:{name}" in self.writer.locals
        ]
        for name in [one for one in self.writer.locals if one.startswith(f"{key}:")]:
            del self.writer.locals[name]
        return found

    # --- statements ----------------------------------------------------------------------------------------

    def run(self, statements: Iterable[ActionStatement], scope: TextScope) -> None:
        """Write statements.  Raises ``NotLowered``."""
        for one in statements:
            if self.writer.dead:
                return
            self._statement(one, scope)

    def _statement(self, one: ActionStatement, scope: TextScope) -> None:
        match one:
            case Assignment(targets, value, sign):
                self._assign(targets, value, sign, scope)
            case Increment(target, by):
                self._assign([target], ONE, "+" if by > 0 else "-", scope)
            case Evaluated(expression):
                if not self.sent(expression, scope):
                    self.several(expression, scope)
            case IfStatement(branches, otherwise):
                self._if(branches, otherwise, scope)
            case SwitchStatement(subject, cases, otherwise):
                given = self.kept(self.value(subject, scope))
                self._switch(given, cases, otherwise, scope)
            case ForLoop():
                self._for(one, scope)
            case WhileLoop():
                with self.writer.until("loop_left") as broken:
                    self._turn(one, replace(scope, broken=broken), MOST_TURNS, self.table.turns)
            case BreakStatement():
                self._end(scope.broken, "break")
            case ContinueStatement():
                self._end(scope.continued, "continue")
            case ReturnStatement():
                self._end(scope.returned, "return")
            case NameDeclaration("persistent", names):
                scope.kept.update(names)
                for name in names:
                    self._recall(name, scope)
            case NameDeclaration("global", names):
                refuse_other_globals(names, scope.node)

    def _end(self, flag: Var | None, word: str) -> None:
        if flag is None:
            raise NotLowered(f"`{word}` stands in nothing that it could end")
        self.writer.end(flag)

    def _if(
        self, branches: Sequence[IfBranch], otherwise: Sequence[ActionStatement], scope: TextScope
    ) -> None:
        if not branches:
            self.run(otherwise, scope)
            return
        first, *others = branches
        self.writer.choose(
            self.condition(first.condition, scope),
            lambda: self.run(first.body, scope),
            lambda: self._if(others, otherwise, scope),
        )

    def _switch(
        self,
        given: Symbolic,
        cases: Sequence[SwitchCase],
        otherwise: Sequence[ActionStatement],
        scope: TextScope,
    ) -> None:
        if not cases:
            self.run(otherwise, scope)
            return
        first, *others = cases
        values = [one for value in first.values for one in flat(self.value(value, scope))]
        same = [single_of(binary("==", single_of(given), one, scope.rules)).expr for one in values]
        self.writer.choose(
            folded(any_of(*same)),
            lambda: self.run(first.body, scope),
            lambda: self._switch(given, others, otherwise, scope),
        )

    def _for(self, one: ForLoop, scope: TextScope) -> None:
        every = self.value(one.values, scope)
        rows, columns = size_of(every)
        found = flat(every)
        if isinstance(every, SymbolicArray) and columns > MOST_TURNS:
            raise NotLowered(f"a loop of {columns:,} turns")
        with self.writer.until("loop_left") as broken:
            for column in range(columns if rows else 0):
                if self.writer.dead:
                    return
                self._write(Name(one.variable), matrix(found[column::columns], rows, 1), scope)
                with self.writer.until("turn_left") as continued:
                    self.run(one.body, replace(scope, broken=broken, continued=continued))

    def _turn(self, one: WhileLoop, scope: TextScope, most: int, few: int) -> None:
        """A turn of a loop, and those after it."""
        condition = self.condition(one.condition, scope)
        if isinstance(condition, Const):
            few += 1
        if (isinstance(condition, Const) and not condition.value) or self.writer.dead:
            return
        if not most or not few:
            turns = MOST_TURNS if not most else self.table.turns
            self.table.met |= {"turns"} if most else set()
            self.writer.choose(
                condition, lambda: self.writer.fault(f"a loop may make more than {turns:,} turns")
            )
            return

        def turn() -> None:
            with self.writer.until("turn_left") as continued:
                self.run(one.body, replace(scope, continued=continued))
            self._turn(one, scope, most - 1, few - 1)

        self.writer.choose(condition, turn)

    # --- assignments ---------------------------------------------------------------------------------------

    def _assign(
        self,
        targets: Sequence[Expression | None],
        value: Expression,
        sign: BinaryOperator | None,
        scope: TextScope,
    ) -> None:
        if len(targets) == 1 and targets[0] is not None:
            new = self.value(value, scope)
            if sign is not None:
                value = compound(sign, targets[0], value)
                new = self.operated(value, self.value(targets[0], scope), new, scope)
            self._write(targets[0], new, self.assigning(scope, targets[0], value))
            return
        given = self.several(value, scope)
        if isinstance(value, Applied) and value.function == Name("size"):
            given = list(flat(given[0]))
        if len(given) < len(targets):
            raise NotLowered(f"{len(targets)} values are taken of a function that gives {len(given)}")
        for target, one in zip(targets, given, strict=False):
            if target is not None:
                self._write(target, one, self.assigning(scope, target))

    def _write(self, target: Expression, value: Symbolic, scope: TextScope) -> None:
        match target:
            case Name(name):
                self._set(name, value, scope)
            case Member(owner, name):
                whole = self._owner(owner, scope)
                if not isinstance(whole, SymbolicStructure) or name not in (
                    [name] if whole.kind == MADE else whole.elements
                ):
                    raise NotLowered(f"there is no element {name} to write to")
                old = whole.elements.get(name)
                made = value if old is None else self._like(old, value, scope)
                self._write(owner, SymbolicStructure(whole.kind, {**whole.elements, name: made}), scope)
            case Applied(of, indices):
                whole = self.value(of, scope)
                self._write(of, self._with(whole, indices, value, scope), scope)
            case Indexed(of, index):
                whole, at = self.value(of, scope), as_number(single_of(self.value(index, scope)))
                first = self.first_index(of, scope)
                self.check_index(at, first, len(flat(whole)))
                [new] = self._in_type_of(whole, single_of(value), scope)
                every = [_if_at(one, folded(at == first + n), new) for n, one in enumerate(flat(whole))]
                self._write(of, matrix(every, *size_of(whole)), scope)
            case _:
                raise NotLowered("what is assigned to is no datum")

    def _owner(self, owner: Expression, scope: TextScope) -> Symbolic:
        """What has an element that is written: in a script it is made by that."""
        match owner:
            case Name(name) if scope.function and f"{scope.function}:{name}" not in self.writer.locals:
                if name in scope.results or not self.is_datum(name, scope):
                    return SymbolicStructure(MADE, {})
            case Member(outer, name):
                whole = self._owner(outer, scope)
                if isinstance(whole, SymbolicStructure) and whole.kind == MADE:
                    return whole.elements.get(name, SymbolicStructure(MADE, {}))
        return self.value(owner, scope)

    def _like(self, old: Symbolic, value: Symbolic, scope: TextScope) -> Symbolic:
        """A value in the type and the size of what it takes the place of."""
        if isinstance(old, SymbolicStructure) or isinstance(value, SymbolicStructure):
            names = [[name for name, _ in leaves(one, "")] for one in (old, value)]
            if old.kind != value.kind or names[0] != names[1]:
                raise NotLowered(f"a value of {value.kind} takes the place of one of {old.kind}")
            return value
        made = each_converted(value, flat(old)[0].kind, scope.rules, self.table.kinds)
        if size_of(made) == (1, 1) != size_of(old):
            return matrix([single_of(made)] * len(flat(old)), *size_of(old))
        if size_of(made) != size_of(old):
            shown = " and ".join("x".join(map(str, size_of(one))) for one in (old, made))
            raise NotLowered(f"sizes of {shown}: a datum keeps its size")
        return made

    def _in_type_of(self, whole: Symbolic, value: Symbolic, scope: TextScope) -> Sequence[SymbolicScalar]:
        """The elements of a value in the type of those of a matrix."""
        kind = next((one.kind for one in flat(whole)), value.kind)
        return flat(each_converted(value, kind, scope.rules, self.table.kinds))

    def _with(
        self, whole: Symbolic, indices: Sequence[Expression], value: Symbolic, scope: TextScope
    ) -> Symbolic:
        """A matrix with other values in some places."""
        rows, columns = size_of(whole)
        found, given = list(flat(whole)), self._in_type_of(whole, value, scope)
        if len(indices) == 1:
            places = self.index(indices[0], rows * columns, scope)
            own = [
                number("double", (at % columns) * rows + at // columns + 1).expr for at in range(len(found))
            ]
            pairs: list[tuple[Expr, Expr | None]] = [(place, None) for place in places]
        else:
            down, across = (
                self.index(i, most, scope) for i, most in zip(indices, (rows, columns), strict=True)
            )
            pairs = [(r, c) for r in down for c in across]
            own = []
        if len(given) not in (1, len(pairs)):
            raise NotLowered(f"{len(given)} values are written to {len(pairs)} places")
        for turn, (one, other) in enumerate(pairs):
            new = given[turn if len(given) > 1 else 0]
            self.check_index(one, 1, rows * columns if other is None else rows)
            if other is not None:
                self.check_index(other, 1, columns)
            for at, old in enumerate(found):
                if other is None:
                    here = folded(one == own[at])
                else:
                    here = folded(folded(one == at // columns + 1) & folded(other == at % columns + 1))
                found[at] = _if_at(old, here, new)
        return matrix(found, rows, columns)

    def _set(self, name: str, value: Symbolic, scope: TextScope) -> None:
        if name in scope.kept:
            self._keep(name, value, scope)
        elif scope.function and (
            f"{scope.function}:{name}" in self.writer.locals
            or name in scope.results
            or datum_in(scope.node, name) is None
        ):
            self._local(name, value, scope)
        elif (one := datum_in(scope.node, name)) is not None:
            self.store(one, value, scope)
        else:
            raise NotLowered(f"there is no datum {name} to write to")

    def store(self, one: DrawnData, value: Symbolic, scope: TextScope) -> None:
        """Write a datum: first all that is written is computed, as it may read the datum."""
        self._all(self.datum(one, value), value, scope)

    def _all(self, cells: Symbolic, value: Symbolic, scope: TextScope) -> None:
        made = self._like(cells, value, scope)
        pairs = list(zip((c for _, c in leaves(cells, "")), (v for _, v in leaves(made, "")), strict=True))
        changed = [(cell, new) for cell, new in pairs if cell.expr is not new.expr]
        if len(changed) > 1:
            changed = [(cell, self.writer.kept("new", new)) for cell, new in changed]
        for cell, new in changed:
            self.table.write(self.writer, cell, new.expr)

    def _local(self, name: str, value: Symbolic, scope: TextScope) -> None:
        """A variable of a function: each assignment makes a new version of it."""
        key = f"{scope.function}:{name}"
        old = self.writer.locals.get(key)
        if (
            old is not None
            and not isinstance(old, SymbolicStructure)
            and (old.kind, size_of(old)) != (value.kind, size_of(value))
            and UNTYPED not in (old.kind, value.kind)
        ):
            raise NotLowered(f"{name} is of {old.kind} first, and of {value.kind} then: give each a name")
        made = [self.writer.kept(name, one) for _, one in leaves(value, "")]
        self.writer.locals[key] = filled(value, iter(made))

    def _recall(self, name: str, scope: TextScope) -> None:
        """The memory of a persistent variable, if its type is known already."""
        key = f"{scope.keeper}.{name}"
        known, first = self.table.kind_of(key), self.table.structures.get(key)
        if first is None and known is not None:
            first = self.table.kinds.first_value(*known)
        if key not in self.persistent and first is not None:
            self.persistent[key] = self.table.declared(key, first, hidden=True)
            unset = self.table.declared(f"{key}?", truth(TRUE), hidden=True)
            self.persistent[f"{key}?"] = unset

    def _keep(self, name: str, value: Symbolic, scope: TextScope) -> None:
        key = f"{scope.keeper}.{name}"
        if is_structure(value.kind):
            raise NotLowered(f"{name} is persistent and of a bus: keep each element")
        self.table.saw_value(key, value)
        self._recall(name, scope)
        self._all(self.persistent[key], value, scope)
        self.table.write(self.writer, single_of(self.persistent[f"{key}?"]), FALSE)


def _if_at(old: SymbolicScalar, here: Expr, new: SymbolicScalar) -> SymbolicScalar:
    return SymbolicScalar(old.kind, chosen(here, new.expr, old.expr))


__all__ = ["StatementWriter"]
