"""The paths of a tick as LLVM control flow: a depth-first walk of the choices, with backtracking.

Every choice is a loop whose body is the rest of the tick.  Where the enclosing choice is known while
the code is made, the loop nest is a plain one, and LLVM moves what an inner loop does not change
out of it; where it depends on the path, a switch on the innermost open choice goes back.
There what a choice must remember lies in memory: as registers of LLVM, joined at the switch, the
copies of many choices would take most of the time to compile.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from llvmlite import ir

from checker.encode.intervals import Interval
from checker.encode.native.expressions import INT, Expressions, Slot, kind
from checker.encode.paths import Branch, Choose, PathProgram, Require
from spec_model.lang.action import Assign
from spec_model.lang.expr import Var

_NUMBER = ir.IntType(32)
_BOTTOM = -1
Names = frozenset[str]


class Body:
    """Emits a path program into a function.

    ``finished`` is the block to go to when every path of the current valuation has been run.
    Call ``close`` at the end.
    """

    def __init__(self, builder: Any, saved: Mapping[int, tuple[Var, ...]], finished: Any) -> None:
        self.builder = builder
        self.saved = saved
        self.slots: dict[str, Slot] = {}
        self.emit = Expressions(builder, self.slots)
        self.top = self.local(_NUMBER, "top")
        self.tops: frozenset[int] = frozenset({_BOTTOM})
        self.back: dict[int, Any] = {_BOTTOM: finished}
        self.dispatch: Any = None
        self.dynamic: set[int] = set()
        self.memory = _scratch(builder.module, sum(len(v) + 2 for v in saved.values()))
        self.used = 0

    def local(self, type_: Any, name: str) -> Any:
        """A local variable of the function."""
        with self.builder.goto_entry_block():
            return self.builder.alloca(type_, name=name)

    def declare(self, variables: Iterable[Var]) -> None:
        """Give each variable a place."""
        for var in variables:
            if var.name not in self.slots:
                self.slots[var.name] = Slot(self.local(kind(var), var.name), Interval(var.init, var.init))

    def put(self, var: Var, code: Any, within: Interval) -> None:
        """Store a value of the variable's type."""
        place = self.slots[var.name].place
        self.builder.store(code, place)
        self.slots[var.name] = Slot(place, within)

    def reset(self, variables: Iterable[Var]) -> None:
        """Give each variable its initial value."""
        for var in variables:
            self.put(var, kind(var)(var.init), Interval(var.init, var.init))

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
                case Choose():
                    self._choose(statement)

    def go_back(self) -> None:
        """End the path: go on with the next value of the innermost open choice."""
        self._resume(self.tops)

    def close(self) -> None:
        """Emit the switch that goes back where the open choice depends on the path."""
        if self.dispatch is None:
            return
        self.builder.position_at_end(self.dispatch)
        switch = self.builder.switch(self.builder.load(self.top), self.back[_BOTTOM])
        for number in sorted(self.dynamic - {_BOTTOM}):
            switch.add_case(_NUMBER(number), self.back[number])

    # --- statements ------------------------------------------------------------------------------

    def _branch(self, condition: Any, then: PathProgram, otherwise: PathProgram) -> None:
        build = self.builder
        blocks = [build.append_basic_block(n) for n in ("then", "else", "join")]
        build.cbranch(condition, blocks[0], blocks[1])
        before, tops = dict(self.slots), self.tops
        build.position_at_end(blocks[0])
        self.run(then)
        build.branch(blocks[2])
        after_then, tops_then = dict(self.slots), self.tops
        self.slots.update(before)
        self.tops = tops
        build.position_at_end(blocks[1])
        self.run(otherwise)
        build.branch(blocks[2])
        build.position_at_end(blocks[2])
        self.tops |= tops_then
        for name, slot in after_then.items():
            self.slots[name] = Slot(slot.place, slot.within | self.slots[name].within)

    def _require(self, condition: Any) -> None:
        build = self.builder
        fails, holds = build.append_basic_block("fails"), build.append_basic_block("holds")
        build.cbranch(condition, holds, fails)
        build.position_at_end(fails)
        self.go_back()
        build.position_at_end(holds)

    def _choose(self, choose: Choose) -> None:
        values = choose.values or (choose.var.init,)
        within = Interval(min(values), max(values))
        if len(values) == 1:
            self.put(choose.var, kind(choose.var)(values[0]), within)
            return
        build = self.builder
        self.slots[choose.var.name] = Slot(self.slots[choose.var.name].place, within)
        position = self._copy(_NUMBER, len(self.tops) == 1)
        resume = build.append_basic_block(f"choice.{choose.number}")
        leave = self._enter(choose, position)
        build.branch(resume)
        self._advance(choose, len(values), position, resume, leave)
        build.position_at_end(resume)
        build.store(self._nth(choose.var, values, build.load(position)), self.slots[choose.var.name].place)

    def _enter(self, choose: Choose, position: Any) -> Callable[[], None]:
        """Open a choice; the result closes it and goes back to the one around it."""
        build, outer = self.builder, self.tops
        fixed = len(outer) == 1
        self.kept = [
            (self.slots[v.name].place, self._copy(kind(v), fixed)) for v in self.saved[choose.number]
        ]
        for place, copy in self.kept:
            build.store(build.load(place), copy)
        around = self._copy(_NUMBER, fixed)
        if not fixed:
            build.store(build.load(self.top), around)
        build.store(_NUMBER(choose.number), self.top)
        build.store(_NUMBER(0), position)
        self.tops = frozenset({choose.number})

        def leave() -> None:
            build.store(_NUMBER(min(outer)) if fixed else build.load(around), self.top)
            self._resume(outer)

        return leave

    def _copy(self, type_: Any, fixed: bool) -> Any:
        """A place for a copy that outlives the path."""
        if fixed:
            return self.local(type_, "copy")
        self.used += 1
        return self.memory.gep([INT(0), INT(self.used - 1)]).bitcast(type_.as_pointer())

    def _advance(
        self, choose: Choose, count: int, position: Any, resume: Any, leave: Callable[[], None]
    ) -> None:
        """What going back to a choice does: restore, take its next value, or close it."""
        build = self.builder
        back, more, over = (build.append_basic_block(f"{n}.{choose.number}") for n in ("back", "more", "over"))
        build.position_at_end(back)
        following = build.add(build.load(position), _NUMBER(1))
        build.cbranch(build.icmp_unsigned("<", following, _NUMBER(count)), more, over)
        build.position_at_end(more)
        build.store(following, position)
        for place, copy in self.kept:
            build.store(build.load(copy), place)
        build.branch(resume)
        build.position_at_end(over)
        leave()
        self.back[choose.number] = back

    def _resume(self, tops: frozenset[int]) -> None:
        build = self.builder
        if len(tops) == 1:
            build.branch(self.back[min(tops)])
            return
        if self.dispatch is None:
            self.dispatch = build.append_basic_block("dispatch")
        self.dynamic |= tops
        build.branch(self.dispatch)

    def _nth(self, var: Var, values: tuple[int, ...], position: Any) -> Any:
        build, type_ = self.builder, kind(var)
        if type_ != INT:
            return build.icmp_unsigned("!=", position, _NUMBER(0)) if values == (0, 1) else type_(values[0])
        index, step = build.zext(position, INT), values[1] - values[0]
        if all(b - a == step for a, b in zip(values, values[1:], strict=False)):
            return build.add(INT(values[0]), build.mul(index, INT(step)))
        return build.load(build.gep(self._table(var, values), [INT(0), index]))

    def _table(self, var: Var, values: tuple[int, ...]) -> Any:
        module, type_ = self.builder.module, ir.ArrayType(INT, len(values))
        table = ir.GlobalVariable(module, type_, module.get_unique_name(f"cells.{var.name}"))
        table.linkage, table.global_constant = "internal", True
        table.initializer = ir.Constant(type_, list(values))
        return table


def _scratch(module: Any, words: int) -> Any:
    """Memory of the module for copies; not thread-safe."""
    type_ = ir.ArrayType(INT, max(1, words))
    scratch = ir.GlobalVariable(module, type_, module.get_unique_name("scratch"))
    scratch.initializer = ir.Constant(type_, None)
    return scratch
