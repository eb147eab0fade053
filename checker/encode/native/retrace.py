"""Which inputs lead from one stored state to the next: the same paths, run until one fits."""

from typing import Any

from rovercheck.checker.encode.native.body import Body
from rovercheck.checker.encode.native.expressions import BIT, INT
from rovercheck.checker.encode.native.search import NativeTask, begin, outside, packed
from rovercheck.checker.encode.native.table import WORDS, StateTable, function
from rovercheck.checker.encode.path_statements import saved
from rovercheck.checker.encode.paths import read_flag

UNREAD = -(1 << 63)
"""Stands for the value of an input that the path does not read."""

REACH_TARGET, LEAVE_DOMAIN = -1, -2
"""What to look for instead of the number of a goal."""


def add_retrace(module: Any, task: NativeTask) -> None:
    """``retrace(before, target, wanted, chosen)``: 1 and the chosen inputs of a path that ends in the
    target state, with the wanted goal true, or outside a domain; 0 if there is none."""
    arguments = {"before": WORDS, "target": WORDS, "wanted": INT, "chosen": WORDS}
    _, a, build = function(module, "retrace", INT, arguments)
    inputs = task.system.inputs
    flags = [read_flag(v) for v in inputs]
    live = task.live_at_end | {v.name for v in (*inputs, *flags)}
    finished = build.append_basic_block("finished")
    body = Body(build, saved(task.paths, live), finished, max(1, len(inputs)))
    table = StateTable(module, task.layout.words)
    words = table.load(build, a["before"], INT(0))
    body.declare(flags)
    begin(body, task, task.paths, words)
    body.reset(flags)
    body.run(task.paths)
    with build.if_then(_fits(body, task, a, words, table.load(build, a["target"], INT(0)))):
        for number, (var, flag) in enumerate(zip(inputs, flags, strict=True)):
            value = build.load(body.slots[var.name].place)
            value = build.zext(value, INT) if value.type == BIT else value
            known = build.load(body.slots[flag.name].place)
            build.store(build.select(known, value, INT(UNREAD)), build.gep(a["chosen"], [INT(number)]))
        build.ret(INT(1))
    body.go_back()
    build.position_at_end(finished)
    build.ret(INT(0))


def _fits(body: Body, task: NativeTask, a: dict[str, Any], before: list[Any], target: list[Any]) -> Any:
    build = body.builder
    equal = build.icmp_signed("==", a["wanted"], INT(REACH_TARGET))
    for one, two in zip(packed(body, task, task.paths, before), target, strict=True):
        equal = build.and_(equal, build.icmp_unsigned("==", one, two))
    broken = outside(body, task.layout)
    result = build.and_(build.icmp_signed("==", a["wanted"], INT(LEAVE_DOMAIN)), broken)
    result = build.or_(result, build.and_(equal, build.not_(broken)))
    for number, goal in enumerate(task.goals):
        value = build.load(body.slots[goal.name].place)
        wanted = build.icmp_signed("==", a["wanted"], INT(number))
        result = build.or_(result, build.and_(wanted, value))
    return result
