"""The full RoverLite in Z3's bit vectors, unrolled by hand: what a Python user of Z3 would write.

    python -m benchmarks.peers.unrolling unroll PROPERTY K    the shortest run that breaks it
    python -m benchmarks.peers.unrolling induct PROPERTY K    1-induction

Unrolling keeps one incremental solver, an assumption literal for each depth, and only the variables
in the cone of influence of the property.
"""

import sys
from collections.abc import Callable, Mapping

import z3

Values = dict[str, z3.ExprRef]
OK, DEGRADED, CRITICAL = range(3)
STATE = {
    **dict.fromkeys(("t", "b", "rx", "beat", "command", "output"), 2),
    **dict.fromkeys(("rx_age", "beat_age"), 3),
    **dict.fromkeys(("rx_good", "beat_good"), 6),
    **dict.fromkeys(("t_count", "b_count", "hold", "since", "w12", "w21", "w23", "w32"), 8),
    **dict.fromkeys(("on", "far1", "far2", "far3", "near", "moving", "observed"), 0),
}
"""Bits of each variable; 0 for a boolean."""
INPUTS = {"in_t": 3, "in_b": 2, "sonar1": 2, "sonar2": 2, "sonar3": 2, "in_rx": 0, "in_beat": 0, "turned": 0}


def symbols(widths: Mapping[str, int], suffix: str) -> Values:
    return {n: z3.BitVec(n + suffix, w) if w else z3.Bool(n + suffix) for n, w in widths.items()}


def value(name: str, number: int) -> z3.ExprRef:
    width = STATE[name]
    return z3.BitVecVal(number, width) if width else z3.BoolVal(bool(number))


def initial(k: int) -> Values:
    return {n: value(n, {"since": steps(150, k), "moving": 1}.get(n, 0)) for n in STATE}


def steps(n: int, k: int) -> int:
    return max(1, n // k)


def up_to(number: z3.ExprRef, limit: int) -> z3.ExprRef:
    """One more, saturating."""
    return z3.If(z3.ULT(number, limit), number + 1, z3.BitVecVal(limit, number.size()))


def monitor(
    status: z3.ExprRef, count: z3.ExprRef, critical: z3.ExprRef, fine: z3.ExprRef, limit: int
) -> tuple[z3.ExprRef, z3.ExprRef]:
    streak = z3.If(critical, up_to(count, limit), 0)
    calm = z3.If(fine, z3.BitVecVal(OK, 2), DEGRADED)
    new = z3.If(
        status == CRITICAL,
        z3.If(fine, z3.BitVecVal(OK, 2), CRITICAL),
        z3.If(critical, z3.If(z3.UGE(streak, limit), z3.BitVecVal(CRITICAL, 2), DEGRADED), calm),
    )
    return new, z3.If(new == CRITICAL, 0, streak)


def link(
    status: z3.ExprRef, age: z3.ExprRef, good: z3.ExprRef, new: z3.ExprRef, limit: int
) -> tuple[z3.ExprRef, z3.ExprRef, z3.ExprRef]:
    age = z3.If(new, 0, up_to(age, 7))
    good = z3.If(z3.ULE(age, 2), up_to(good, limit), 0)
    back = z3.UGE(good, limit)
    after = z3.If(
        z3.UGT(age, 6),
        z3.BitVecVal(CRITICAL, 2),
        z3.If(
            status == OK,
            z3.If(z3.UGT(age, 2), z3.BitVecVal(DEGRADED, 2), OK),
            z3.If(back, z3.BitVecVal(OK, 2), status),
        ),
    )
    return after, age, z3.If(after == OK, 0, good)


def deviation(s: Values, i: Values, limit: int) -> Values:
    far = {n: i[f"sonar{n}"] == 2 for n in "123"}
    seen = {p: z3.And(s[f"w{p}"] != 0, far[p[1]]) for p in ("12", "21", "23", "32")}
    found: z3.ExprRef = z3.BitVecVal(0, 2)
    for pair, command in (("32", 2), ("23", 1), ("21", 2), ("12", 1)):
        found = z3.If(seen[pair], command, found)
    held = s["command"] != 0
    clear = z3.Or(held, found != 0)
    after: Values = {"command": z3.If(held, z3.If(i["turned"], 0, s["command"]), found)}
    for pair in seen:
        left, window = z3.And(s[f"far{pair[0]}"], z3.Not(far[pair[0]])), s[f"w{pair}"]
        after[f"w{pair}"] = z3.If(
            clear, 0, z3.If(left, z3.BitVecVal(limit, 8), z3.If(window != 0, window - 1, 0))
        )
    return after | {f"far{n}": f for n, f in far.items()}


def transition(s: Values, i: Values, k: int) -> Values:
    """The state after a step; timers divided by ``k``."""
    hot, low = z3.Or(i["in_t"] == 0, i["in_t"] == 4), z3.Or(i["in_b"] == 0, i["in_b"] == 3)
    n = deviation(s, i, steps(150, k))
    n["t"], n["t_count"] = monitor(s["t"], s["t_count"], hot, i["in_t"] == 2, steps(200, k))
    n["b"], n["b_count"] = monitor(s["b"], s["b_count"], low, i["in_b"] == 2, steps(250, k))
    for name in ("rx", "beat"):
        own = (s[name], s[f"{name}_age"], s[f"{name}_good"], i[f"in_{name}"])
        n[name], n[f"{name}_age"], n[f"{name}_good"] = link(*own, steps(50, k))
    lost = z3.Or(n["rx"] == CRITICAL, n["beat"] == CRITICAL)
    holds = z3.And(s["on"], z3.ULT(s["hold"], steps(150, k) - 1))
    n["on"], n["hold"] = z3.Or(lost, holds), z3.If(z3.And(holds, z3.Not(lost)), s["hold"] + 1, 0)
    n["since"] = z3.If(lost, 0, up_to(s["since"], steps(150, k)))
    n["near"] = z3.Or(*(i[f"sonar{j}"] == 0 for j in "123"))
    n["output"] = z3.If(n["near"], 3, n["command"])
    critical = z3.Or(lost, n["t"] == CRITICAL, n["b"] == CRITICAL)
    n["moving"] = z3.And(z3.Not(critical), n["output"] != 3)
    n["observed"] = z3.Or(s["observed"], z3.And(s["on"], z3.Not(n["on"]), n["t"] == OK))
    return n


BROKEN: dict[str, Callable[[Values, int], z3.ExprRef]] = {
    "P1": lambda s, k: z3.And(s["near"], s["output"] != 3),
    "P2": lambda s, k: z3.And(z3.Or(*(s[n] == CRITICAL for n in ("t", "b", "rx", "beat"))), s["moving"]),
    "P3": lambda s, k: z3.And(z3.Not(s["on"]), z3.Or(s["rx"] == CRITICAL, s["beat"] == CRITICAL)),
    "P3h": lambda s, k: z3.And(z3.Not(s["on"]), z3.ULT(s["since"], steps(150, k))),
    "P4": lambda s, k: s["t"] == CRITICAL,
    "P5": lambda s, k: z3.And(s["observed"], s["t"] == CRITICAL),
}
"""The states in which a property is broken."""


def read(expr: z3.ExprRef) -> set[str]:
    """The symbols that occur in a formula."""
    found, open_, seen = set(), [expr], set()
    while open_:
        node = open_.pop()
        if node.get_id() not in seen:
            seen.add(node.get_id())
            open_ += node.children()
            if z3.is_const(node) and node.decl().kind() == z3.Z3_OP_UNINTERPRETED:
                found.add(node.decl().name())
    return found


def cone(name: str, k: int) -> list[str]:
    """The variables that a property depends on."""
    s, i = symbols(STATE, ""), symbols(INPUTS, "")
    after = transition(s, i, k)
    needed, before = read(BROKEN[name](s, k)) & set(STATE), set[str]()
    while needed != before:
        before = set(needed)
        needed |= {n for v in before for n in read(after[v])} & set(STATE)
    return [n for n in STATE if n in needed]


def unroll(name: str, k: int, most: int = 1000) -> int | None:
    """The least number of steps that breaks the property, None if there is none up to ``most``."""
    kept = cone(name, k)
    solver, s = z3.SolverFor("QF_BV"), symbols(STATE, "@0")
    start = initial(k)
    solver.add(*(s[n] == start[n] for n in kept))
    for depth in range(most + 1):
        literal = z3.Bool(f"broken@{depth}")
        solver.add(z3.Implies(literal, BROKEN[name](s, k)))
        if solver.check(literal) == z3.sat:
            return depth
        solver.add(z3.Not(literal))
        i, following = symbols(INPUTS, f"@{depth}"), symbols(STATE, f"@{depth + 1}")
        after = transition(s, i, k)
        solver.add(z3.ULT(i["in_t"], 5), *(following[n] == after[n] for n in kept))
        s = following
    return None


def induct(name: str, k: int) -> bool:
    """Whether the property is inductive by itself: true at first, and kept by every step."""
    s, i, start = symbols(STATE, ""), symbols(INPUTS, ""), initial(k)
    solver = z3.SolverFor("QF_BV")
    solver.add(z3.ULT(i["in_t"], 5), z3.Not(BROKEN[name](s, k)), BROKEN[name](transition(s, i, k), k))
    return bool(z3.is_false(z3.simplify(BROKEN[name](start, k))) and solver.check() == z3.unsat)


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("unroll", "induct") or sys.argv[2] not in BROKEN:
        raise SystemExit(__doc__)
    mode, name, k = sys.argv[1], sys.argv[2], int(sys.argv[3])
    if mode == "induct":
        print("proved" if induct(name, k) else "open")
    else:
        reached = unroll(name, k)
        print("open" if reached is None else f"reached {reached}")
