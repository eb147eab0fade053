"""The paths of a tick as LLVM control flow: a depth-first walk of the choices.

The choices of the path that is run lie on a stack.  At its end the last choice that has values left
takes its next one, and the path is run again from the innermost fork before that choice.  Every fork
is a loop around the rest of the tick, so that LLVM moves what an inner loop does not change out of it.
A round is over when no choice made inside it has values left: the stack is then as deep as when the fork
was reached.  The choice of an ``Each`` is counted beside the stack and takes its next value only then.
"""

from collections.abc import Callable, Iterable, Mapping
from itertools import pairwise
from typing import Any

from llvmlite import ir

from rovercheck.checker.encode.native.expressions import INT, Expressions, Slot, kind
from rovercheck.checker.encode.path_statements import (
    Branch,
    Choose,
    Complete,
    Each,
    Fork,
    PathProgram,
    Require,
    Span,
)
from rovercheck.checker.system.intervals import Interval
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.expr import Var

_NUMBER = ir.IntType(32)
SHOWN = 100
"""Signs of the name of a local variable: LLVM cuts longer ones, and two may then be alike."""


class Body:
    """Emits a path program into a function.

    ``saved`` says what each fork restores; ``finished`` is the block to go to when every path of the
    current state has been run; ``most`` choices are on a path.  ``forbidden`` emits what is done
    where the assumption fails, ``complete`` what is done with a state that is complete.
    """

    def __init__(
        self,
        builder: Any,
        saved: Mapping[int, tuple[Var, ...]],
        finished: Any,
        most: int,
        forbidden: Callable[[], None] = lambda: None,
        complete: Callable[[], None] = lambda: None,
    ) -> None:
        self.builder = builder
        self.forbidden, self.complete = forbidden, complete
        self.saved = saved
        self.slots: dict[str, Slot] = {}
        self.emit = Expressions(builder, self.slots)
        self.depth, self.next = self.local(_NUMBER, "depth"), self.local(_NUMBER, "next")
        self.position, self.count = (self.local(ir.ArrayType(_NUMBER, most), n) for n in ("at", "of"))
        self.back = finished
        self.chosen: Any = None
        self.before: dict[str, Slot] = {}
        """What the slots were that have been written since the start of the innermost branch."""

    def local(self, type_: Any, name: str) -> Any:
        """A local variable of the function."""
        with self.builder.goto_entry_block():
            return self.builder.alloca(type_, name=name[:SHOWN])

    def declare(self, variables: Iterable[Var]) -> None:
        """Give each variable a place."""
        for var in variables:
            if var.name not in self.slots:
                self.slots[var.name] = Slot(self.local(kind(var), var.name), Interval(var.init, var.init))

    def put(self, var: Var, code: Any, within: Interval) -> None:
        """Store a value of the variable's type."""
        old = self.slots[var.name]
        self.before.setdefault(var.name, old)
        self.builder.store(code, old.place)
        self.slots[var.name] = Slot(old.place, within)

    def reset(self, variables: Iterable[Var]) -> None:
        """Give each variable its initial value."""
        for var in variables:
            self.put(var, kind(var)(var.init), Interval(var.init, var.init))

    def share(self) -> None:
        """Have every choice call one function: where there are thousands, little else is in the module."""
        build, array = self.builder, self.position.type
        pointer = _NUMBER.as_pointer()
        module, type_ = (
            build.module,
            ir.FunctionType(_NUMBER, [pointer, pointer, array, array, _NUMBER, _NUMBER]),
        )
        self.chosen = ir.Function(module, type_, module.get_unique_name("choose"))
        self.chosen.linkage = "internal"
        next_, depth, at, of, first, end = self.chosen.args
        inside = ir.IRBuilder(self.chosen.append_basic_block())
        inside.ret(inside.load(_taken(inside, next_, depth, at, of, lambda: (first, end))))

    def start(self) -> None:
        """Begin with the first path."""
        for place in (self.depth, self.next):
            self.builder.store(_NUMBER(0), place)

    def run(self, program: PathProgram) -> None:
        """Emit the statements, from the start of a tick."""
        for statement in program:
            match statement:
                case Assign(var, expr):
                    value = self.emit.value(expr)
                    code = self.emit.as_bit(value) if kind(var) != INT else self.emit.as_int(value)
                    self.put(var, code, value.within)
                case Branch(condition, then, otherwise):
                    self._branch(self.emit.condition(condition), then, otherwise)
                case Require(condition):
                    self._require(self.emit.condition(condition))
                case Choose(var, values, span):
                    self._choose(var, values or (var.init,), span)
                case Fork(number):
                    self._fork(number)
                case Each():
                    self._each(statement)
                case Complete():
                    self._complete()

    def go_back(self) -> None:
        """End the path: go on with the next one."""
        self.builder.branch(self.back)

    # --- statements ------------------------------------------------------------------------------

    def _branch(self, condition: Any, then: PathProgram, otherwise: PathProgram) -> None:
        join = self.builder.append_basic_block("join")
        starts = [self.builder.append_basic_block("side") if p else join for p in (then, otherwise)]
        self.builder.cbranch(condition, *starts)
        then_ends = self._alternative(then, starts[0], join)
        else_ends = self._alternative(otherwise, starts[1], join)
        self.builder.position_at_end(join)
        for name in then_ends | else_ends:
            slot = self.slots[name]
            one, other = then_ends.get(name, slot), else_ends.get(name, slot)
            self.before.setdefault(name, slot)
            self.slots[name] = Slot(slot.place, one.within | other.within)

    def _alternative(self, program: PathProgram, start: Any, join: Any) -> dict[str, Slot]:
        """Emit one side of a branch; the slots it has written, which are then as before it."""
        if start is join:
            return {}
        outer, self.before = self.before, {}
        self.builder.position_at_end(start)
        self.run(program)
        self.builder.branch(join)
        written = {name: self.slots[name] for name in self.before}
        self.slots.update(self.before)
        self.before = outer
        return written

    def _require(self, condition: Any) -> None:
        holds, fails = (self.builder.append_basic_block(n) for n in ("holds", "fails"))
        self.builder.cbranch(condition, holds, fails)
        self.builder.position_at_end(fails)
        self.forbidden()
        self.go_back()
        self.builder.position_at_end(holds)

    def _complete(self) -> None:
        """What is done with the state comes when all paths from here have been run."""
        build = self.builder
        rest, over = (build.append_basic_block(n) for n in ("rest", "over"))
        build.branch(rest)
        build.position_at_end(over)
        self.complete()
        self.go_back()
        self.back = over
        build.position_at_end(rest)

    def _choose(self, var: Var, values: tuple[int, ...], span: Span | None) -> None:
        within = Interval(min(values), max(values))
        if len(values) == 1:
            self.put(var, kind(var)(values[0]), within)
            return
        build = self.builder
        places = (self.next, self.depth, self.position, self.count)
        if self.chosen is None:
            taken = build.load(_taken(build, *places, lambda: self._ends(values, span)))
        else:
            taken = build.call(self.chosen, [*places, *self._ends(values, span)])
        self.put(var, self._nth(var, values, taken), within)

    def _ends(self, values: tuple[int, ...], span: Span | None) -> tuple[Any, Any]:
        """Places of the first value to take and behind the last."""
        if span is None:
            return _NUMBER(0), _NUMBER(len(values))
        first, end = (self.builder.trunc(self.emit.as_int(self.emit.value(e)), _NUMBER) for e in span)
        return first, end

    def _at(self, array: Any, index: Any) -> Any:
        return self.builder.gep(array, [_NUMBER(0), index])

    def _fork(self, number: int) -> None:
        """Start a loop around the rest of the tick: one round for each combination of later choices."""
        build = self.builder
        kept = self._kept(number)
        resume, back = (build.append_basic_block(f"{n}.{number}") for n in ("fork", "back"))
        build.branch(resume)
        build.position_at_end(back)
        self._advance(back, kept, resume, self.back)
        self.back = back
        build.position_at_end(resume)

    def _each(self, each: Each) -> None:
        """A fork whose own choice is counted in the loop."""
        build, var, values = self.builder, each.var, each.values
        kept, at = self._kept(each.number), self.local(_NUMBER, "each")
        first, end = self._ends(values, each.span)
        build.store(first, at)
        resume, turn, again = (
            build.append_basic_block(f"{n}.{each.number}") for n in ("fork", "turn", "again")
        )
        back = turn if each.alone else build.append_basic_block(f"back.{each.number}")
        build.branch(resume)
        if not each.alone:
            build.position_at_end(back)
            self._advance(back, kept, resume, turn)
        build.position_at_end(turn)
        following = build.add(build.load(at), _NUMBER(1))
        build.cbranch(build.icmp_signed("<", following, end), again, self.back)
        build.position_at_end(again)
        build.store(following, at)
        self._restore(kept)
        build.branch(resume)
        self.back = back
        build.position_at_end(resume)
        self.put(var, self._nth(var, values, build.load(at)), Interval(min(values), max(values)))

    def _kept(self, number: int) -> list[tuple[Any, Any]]:
        """Copies of what later rounds from a fork start with, last how many choices there were."""
        build = self.builder
        places = [*(self.slots[v.name].place for v in self.saved[number]), self.next]
        kept = [(place, self.local(place.type.pointee, "kept")) for place in places]
        for place, copy in kept:
            build.store(build.load(place), copy)
        return kept

    def _restore(self, kept: list[tuple[Any, Any]]) -> None:
        for place, copy in kept:
            self.builder.store(self.builder.load(copy), place)

    def _advance(self, back: Any, kept: list[tuple[Any, Any]], resume: Any, over: Any) -> None:
        """Going back to a fork: the next value of the last choice after it that has one left, or ``over``."""
        build = self.builder
        own, more, drop = (build.append_basic_block(n) for n in ("own", "more", "drop"))
        depth = build.load(self.depth)
        build.cbranch(build.icmp_signed(">", depth, build.load(kept[-1][1])), own, over)
        build.position_at_end(own)
        last = build.sub(depth, _NUMBER(1))
        position = self._at(self.position, last)
        following = build.add(build.load(position), _NUMBER(1))
        left = build.icmp_signed("<", following, build.load(self._at(self.count, last)))
        build.cbranch(left, more, drop)
        build.position_at_end(drop)
        build.store(last, self.depth)
        build.branch(back)
        build.position_at_end(more)
        build.store(following, position)
        self._restore(kept)
        build.branch(resume)

    def _nth(self, var: Var, values: tuple[int, ...], position: Any) -> Any:
        build, type_ = self.builder, kind(var)
        if type_ != INT:
            return build.icmp_unsigned("!=", position, _NUMBER(0)) if values == (0, 1) else type_(values[0])
        index, step = build.zext(position, INT), values[1] - values[0]
        if all(b - a == step for a, b in pairwise(values)):
            return build.add(INT(values[0]), build.mul(index, INT(step)))
        return build.load(build.gep(self._table(var, values), [INT(0), index]))

    def _table(self, var: Var, values: tuple[int, ...]) -> Any:
        module, type_ = self.builder.module, ir.ArrayType(INT, len(values))
        table = ir.GlobalVariable(module, type_, module.get_unique_name(f"cells.{var.name}"))
        table.linkage, table.global_constant = "internal", True
        table.initializer = ir.Constant(type_, list(values))
        return table


def _taken(build: Any, next_: Any, depth: Any, at: Any, of: Any, ends: Callable[[], tuple[Any, Any]]) -> Any:
    """Where the place of the value taken lies: a choice not on the stack yet begins with its first."""
    index = build.load(next_)
    position, following = build.gep(at, [_NUMBER(0), index]), build.add(index, _NUMBER(1))
    with build.if_then(build.icmp_signed(">=", index, build.load(depth))):
        first, end = ends()
        build.store(first, position)
        build.store(end, build.gep(of, [_NUMBER(0), index]))
        build.store(following, depth)
    build.store(following, next_)
    return position
