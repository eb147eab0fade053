"""The inner loop of the explicit search as LLVM code: expand states, store their successors."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property
from typing import Any

from rovercheck.checker.encode.native.body import Body
from rovercheck.checker.encode.native.expressions import BIT, INT, Slot
from rovercheck.checker.encode.native.fingerprint import fingerprint
from rovercheck.checker.encode.native.layout import Field, Layout
from rovercheck.checker.encode.native.quiet import Shift, emit_moved_on
from rovercheck.checker.encode.native.table import (
    CONTEXT,
    NUMBER,
    NUMBERS,
    WORDS,
    StateTable,
    context,
    function,
)
from rovercheck.checker.encode.path_statements import Complete, PathProgram, assigned, choices, saved
from rovercheck.checker.encode.paths import path_program, staged_program
from rovercheck.checker.system.intervals import Interval
from rovercheck.checker.system.partition import Partition, partitions
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

BATCH = 2048
"""Successors kept before they are stored together."""

MOST_SUCCESSORS = 1 << 25
"""Successors of one state beyond which a search is given up: it could not be interrupted."""

MOST_IDLE = 1 << 16
"""Paths without a successor to keep after which a search looks whether it is to stop; a power of two."""

MANY_CHOICES = 3_000
"""Choices from which on they share code: such a module is ``LARGE`` in any case, and not optimised."""


class Status(IntEnum):
    """Why ``search`` came back."""

    PAUSED = 0
    NO_ROOM = 1
    OUTSIDE = 2
    TOO_MANY = 3
    DECIDED = 4
    STOPPED = 5


@dataclass(frozen=True)
class NativeTask:
    """What is compiled: the sliced system, its packed state and the goals.

    With ``shifts`` the result of a quiet tick is not stored (see ``add_search``).
    """

    system: TransitionSystem
    layout: Layout
    goals: tuple[Var, ...]
    shifts: tuple[Shift, ...] = ()

    @cached_property
    def cells(self) -> dict[str, Partition]:
        """The cells of each input, by name."""
        return partitions(self.system)

    @cached_property
    def paths(self) -> PathProgram:
        """The paths of a tick."""
        return path_program(self.system, self.cells)

    @cached_property
    def stages(self) -> PathProgram:
        """The paths of a tick, as few as can be until the state after it is complete."""
        stored = frozenset(f.var.name for f in self.layout.fields)
        return staged_program(self.system, self.cells, stored) or self.paths

    @cached_property
    def key(self) -> str:
        """What determines the code.  Raises ``OSError`` where that cannot be told."""
        return fingerprint(self.system, self.layout, self.goals, self.shifts)

    @property
    def live_at_end(self) -> frozenset[str]:
        return frozenset(v.name for v in (*(f.var for f in self.layout.fields), *self.goals))


def add_search(module: Any, task: NativeTask, table: StateTable, store: Any) -> None:
    """``search(context, words, parents, table, buffer, origins, hits)``: expand the states
    next..last-1 until the budget of transitions is spent.  Returns a ``Status``.

    For a task with shifts four arrays more, ``frontier, anchors, onward, carried``: expand the
    states of the frontier, found by quiet ticks from the stored ones that ``anchors`` numbers.
    Those with a quiet tick move on to ``onward`` with their anchor in ``carried``, ``lines`` of them.
    """
    _Search(module, task, table, store).emit()


class _Search:
    def __init__(self, module: Any, task: NativeTask, table: StateTable, store: Any) -> None:
        self.task, self.table, self.store = task, table, store
        arguments = {"context": WORDS, "words": WORDS, "parents": table.parents, "table": WORDS}
        arguments |= {"buffer": WORDS, "origins": NUMBERS, "hits": WORDS}
        if task.shifts:
            arguments |= {"frontier": WORDS, "anchors": NUMBERS, "onward": WORDS, "carried": NUMBERS}
        self.made, self.a, self.build = function(module, "search", INT, arguments)
        self.places = {name: context(self.build, self.a["context"], name) for name in CONTEXT}

    def emit(self) -> None:
        build = self.build
        self.drain()
        finished = build.append_basic_block("finished")
        program = self.task.stages
        stages = 1 if program is self.task.paths else 2
        most = max(1, stages * len(self.task.system.inputs))
        kept = saved(program, self.task.live_at_end)
        self.body = Body(build, kept, finished, most, self._nothing_kept, self._complete)
        self.parent, self.filled, self.tried, self.spent, self.idle = (
            self.body.local(INT, n) for n in ("parent", "filled", "tried", "spent", "idle")
        )
        build.store(self.get("next"), self.parent)
        build.store(INT(0), self.filled)
        build.store(INT(0), self.spent)
        build.store(INT(0), self.idle)
        head, expand = build.append_basic_block("next"), build.append_basic_block("expand")
        build.branch(head)
        self._head(head, expand)
        build.position_at_end(expand)
        build.store(INT(0), self.tried)
        frontier = self.a["frontier" if self.task.shifts else "words"]
        self.before = self.table.load(build, frontier, build.load(self.parent))
        self._expect(self.before)
        begin(self.body, self.task, program, self.before)
        self.body.run(program)
        self._end_of_path()
        self.body.go_back()
        self._finished(finished, head)

    def _expect(self, words: list[Any]) -> None:
        """Note where a quiet tick would lead; none has been found so far."""
        if self.task.shifts:
            self.expected = emit_moved_on(self.build, words, self.task.shifts)
            self.is_quiet = self.body.local(BIT, "quiet")
            self.build.store(BIT(0), self.is_quiet)

    def get(self, name: str) -> Any:
        return self.build.load(self.places[name])

    def put(self, name: str, value: Any) -> None:
        self.build.store(value, self.places[name])

    def leave(self, status: Status) -> None:
        """Return to Python; the current state will be expanded again from its start."""
        self.put("next", self.build.load(self.parent))
        self.put("filled", self.build.load(self.filled))
        self.build.ret(INT(int(status)))

    def drain(self) -> None:
        """Store what is in the buffer; back to Python if there is no room for it."""
        names = ("context", "words", "parents", "table", "buffer", "origins")
        full = self.build.call(self.store, [self.a[n] for n in names])
        with self.build.if_then(self.build.icmp_signed("!=", full, INT(0)), likely=False):
            self.build.ret(INT(int(Status.NO_ROOM)))

    def _head(self, head: Any, expand: Any) -> None:
        build = self.build
        build.position_at_end(head)
        more = build.icmp_signed("<", build.load(self.parent), self.get("last"))
        funded = build.icmp_signed("<", build.load(self.spent), self.get("budget"))
        stop = build.append_basic_block("stop")
        build.cbranch(build.and_(more, funded), expand, stop)
        build.position_at_end(stop)
        self.put("next", build.load(self.parent))
        self.put("filled", build.load(self.filled))
        self.drain()
        build.ret(INT(int(Status.PAUSED)))

    def _finished(self, finished: Any, head: Any) -> None:
        build = self.build
        build.position_at_end(finished)
        tried = build.load(self.tried)
        self.put("transitions", build.add(self.get("transitions"), tried))
        build.store(build.add(build.load(self.spent), build.add(tried, INT(1))), self.spent)
        if self.task.shifts:
            with build.if_then(build.load(self.is_quiet)):
                self._move_on()
        build.store(build.add(build.load(self.parent), INT(1)), self.parent)
        build.branch(head)

    def _move_on(self) -> None:
        build, at = self.build, self.get("lines")
        self.table.save(build, self.a["onward"], at, self.expected)
        build.store(build.trunc(self._anchor(), NUMBER), build.gep(self.a["carried"], [at]))
        self.put("lines", build.add(at, INT(1)))

    def _anchor(self) -> Any:
        """The number of the stored state that the current one is, or is found from by quiet ticks."""
        number = self.build.load(self.parent)
        if not self.task.shifts:
            return number
        return self.build.zext(self.build.load(self.build.gep(self.a["anchors"], [number])), INT)

    # --- the end of a path -----------------------------------------------------------------------

    def _end_of_path(self) -> None:
        build = self.build
        tried = build.add(build.load(self.tried), INT(1))
        build.store(tried, self.tried)
        self._goals()
        if not any(isinstance(s, Complete) for s in self.task.stages):
            self._complete()
            return
        many = build.icmp_unsigned("==", build.and_(tried, INT(MOST_IDLE - 1)), INT(0))
        with build.if_then(many, likely=False):
            self._give_up_if_too_many()
            self._stop_if_asked()

    def _complete(self) -> None:
        """A state that is complete: keep it unless it is quiet."""
        build = self.build
        with build.if_then(outside(self.body, self.task.layout), likely=False):
            self.leave(Status.OUTSIDE)
        after = packed(self.body, self.task, self.task.stages, self.before)
        if not self.task.shifts:
            self._keep(after)
            return
        same = BIT(1)
        for one, two in zip(after, self.expected, strict=True):
            same = build.and_(same, build.icmp_unsigned("==", one, two))
        with build.if_else(same) as (quiet, other):
            with quiet:
                build.store(BIT(1), self.is_quiet)
                self._nothing_kept()
            with other:
                self._keep(after)

    def _keep(self, after: list[Any]) -> None:
        """Put a successor into the buffer."""
        build = self.build
        at = build.load(self.filled)
        self.table.save(build, self.a["buffer"], at, after)
        build.store(build.trunc(self._anchor(), NUMBER), build.gep(self.a["origins"], [at]))
        following = build.add(at, INT(1))
        build.store(following, self.filled)
        with build.if_then(build.icmp_signed(">=", following, INT(BATCH)), likely=False):
            self._flush()

    def _flush(self) -> None:
        build = self.build
        self.put("next", build.load(self.parent))
        self.put("filled", INT(BATCH))
        self.drain()
        build.store(INT(0), self.filled)
        self._give_up_if_too_many()
        self._stop_if_asked()

    def _nothing_kept(self) -> None:
        """A path that leaves the buffer as it is: after many of them look whether to stop."""
        build = self.build
        idle = build.add(build.load(self.idle), INT(1))
        build.store(idle, self.idle)
        many = build.icmp_unsigned("==", build.and_(idle, INT(MOST_IDLE - 1)), INT(0))
        with build.if_then(many, likely=False):
            self._stop_if_asked()

    def _give_up_if_too_many(self) -> None:
        build = self.build
        many = build.icmp_signed(">", build.load(self.tried), INT(MOST_SUCCESSORS))
        with build.if_then(many, likely=False):
            self.leave(Status.TOO_MANY)

    def _stop_if_asked(self) -> None:
        """Back to Python if it says so; read anew each time, as another thread writes it."""
        build = self.build
        told = build.icmp_signed("!=", build.load_atomic(self.places["stop"], "monotonic", 8), INT(0))
        with build.if_then(told, likely=False):
            self.leave(Status.STOPPED)

    def _goals(self) -> None:
        build = self.build
        values = [build.load(self.body.slots[g.name].place) for g in self.task.goals]
        anything = BIT(0)
        for value in values:
            anything = build.or_(anything, value)
        with build.if_then(anything, likely=False):
            for number, value in enumerate(values):
                self._hit(number, value)
            with build.if_then(build.icmp_signed("<=", self.get("pending"), INT(0)), likely=False):
                self.leave(Status.DECIDED)

    def _hit(self, number: int, value: Any) -> None:
        """The first state from which a goal is reached: its number, or that of its anchor, + 1."""
        build = self.build
        place = build.gep(self.a["hits"], [INT(number)])
        first = build.and_(value, build.icmp_signed("==", build.load(place), INT(0)))
        with build.if_then(first, likely=False):
            build.store(build.add(self._anchor(), INT(1)), place)
            self.put("pending", build.sub(self.get("pending"), INT(1)))


# --- shared with the search for the inputs of a run ----------------------------------------------


def begin(body: Body, task: NativeTask, program: PathProgram, words: Sequence[Any]) -> None:
    """Emit the start of a tick: the variables of the state unpacked, everything else reset."""
    if choices(program) >= MANY_CHOICES:
        body.share()
    build = body.builder
    fields = {f.var.name for f in task.layout.fields}
    others = [v for v in _all_variables(task, program) if v.name not in fields]
    body.declare([f.var for f in task.layout.fields])
    body.declare(others)
    for f in task.layout.fields:
        bits = build.and_(build.lshr(words[f.word], INT(f.shift)), INT(f.mask))
        body.slots[f.var.name] = Slot(body.slots[f.var.name].place, Interval(f.low, f.top))
        place = body.slots[f.var.name].place
        if place.type.pointee == BIT:
            build.store(build.trunc(build.add(bits, INT(f.low)), BIT), place)
        else:
            build.store(build.add(build.mul(bits, INT(f.stride)), INT(f.low)), place)
    body.reset(others)
    body.start()


def _all_variables(task: NativeTask, program: PathProgram) -> list[Var]:
    found = {name: var for name, (var, _) in assigned(program).items()}
    system = task.system
    for var in (*system.inputs, *system.temps, *system.variables, *system.frozen, *task.goals):
        found.setdefault(var.name, var)
    return list(found.values())


def packed(body: Body, task: NativeTask, program: PathProgram, before: Sequence[Any]) -> list[Any]:
    """The words of the state after the tick.

    Fields written early in the tick are joined first: LLVM then moves that out of the inner choices.
    """
    build = body.builder
    written = assigned(program)
    result = []
    for number, word in enumerate(before):
        own = [f for f in task.layout.fields if f.word == number]
        constant = sum(f.mask << f.shift for f in own if f.var.name not in written)
        joined = build.and_(word, INT(constant))
        for f in sorted((f for f in own if f.var.name in written), key=lambda f: written[f.var.name][1]):
            joined = build.or_(joined, build.shl(_code(body, f), INT(f.shift)))
        result.append(joined)
    return result


def _code(body: Body, f: Field) -> Any:
    build = body.builder
    code = build.load(body.slots[f.var.name].place)
    code = build.zext(code, INT) if code.type == BIT else code
    offset = build.sub(code, INT(f.low))
    return offset if f.stride == 1 else build.udiv(offset, INT(f.stride), flags=["exact"])


def outside(body: Body, layout: Layout) -> Any:
    """Whether some variable has left its domain, or the values known of it; what intervals show to be
    inside is not tested."""
    build, result = body.builder, BIT(0)
    for f in layout.fields:
        slot, dense = body.slots[f.var.name], f.stride == 1 and f.var.domain.dense
        if dense and slot.within.within(Interval(f.low, f.top)):
            continue
        code = build.load(slot.place)
        code = build.zext(code, INT) if code.type == BIT else code
        result = build.or_(result, build.not_(_inside(build, f, code)))
    return result


def _inside(build: Any, f: Field, code: Any) -> Any:
    domain = f.var.domain
    own = () if domain.dense else [v for v in domain.values if f.low <= v <= f.top]
    if domain.dense or len(own) == f.most + 1:
        offset = build.sub(code, INT(f.low))
        inside = build.icmp_unsigned("<=", offset, INT(f.top - f.low))
        even = build.icmp_unsigned("==", build.urem(offset, INT(f.stride)), INT(0))
        return inside if f.stride == 1 else build.and_(inside, even)
    result = BIT(0)
    for value in own:
        result = build.or_(result, build.icmp_signed("==", code, INT(value)))
    return result
