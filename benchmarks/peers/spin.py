"""RoverLite in Promela, for SPIN: the inputs chosen one by one, then the step as one ``d_step``.

    python -m benchmarks.peers.spin COMP K > rover.pml
    spin -a rover.pml && gcc -O2 -DSAFETY -o pan pan.c && ./pan -m1000000

P1, P2 and P3 are assertions.  Inputs and what a step forgets are ``hidden``: no part of a state.
"""

import sys
from collections.abc import Iterator

LINKS = (("rx", 4), ("beat", 8))


def steps(n: int, k: int) -> int:
    return max(1, n // k)


def promela(comp: int, k: int) -> str:
    """The model of the parts in ``comp`` (see ``benchmarks/roverlite.py``), timers divided by ``k``."""
    step = "\n".join(f"    {line}" for line in _step(comp, k))
    return (
        "\n".join(_state(comp))
        + "\nactive proctype rover() {\n do :: atomic {\n"
        + "\n".join(f"   {line}" for line in _inputs(comp))
        + f"\n   d_step {{\n{step}\n   }}\n }} od\n}}\n"
    )


def _state(comp: int) -> Iterator[str]:
    names = {1: ["t", "t_count"], 2: ["b", "b_count"], 4: ["rx", "rx_age", "rx_good"]}
    names |= {8: ["beat", "beat_age", "beat_good"], 16: ["on", "hold"]}
    names |= {32: ["far1", "far2", "far3", "w12", "w21", "w23", "w32", "command"], 64: ["observed"]}
    for part, own in names.items():
        if comp & part:
            yield from (f"byte {name};" for name in own)
    yield "hidden byte in_t, in_b, in_rx, in_beat, sonar1, sonar2, sonar3, turned;"
    yield "hidden byte streak, lost, critical, moving, near, output, was_on;"
    yield "hidden byte now1, now2, now3, left1, left2, left3, clear;"


def _inputs(comp: int) -> Iterator[str]:
    sizes = {1: [("in_t", 5)], 2: [("in_b", 4)], 4: [("in_rx", 2)], 8: [("in_beat", 2)]}
    sizes[32] = [("sonar1", 4), ("sonar2", 4), ("sonar3", 4), ("turned", 2)]
    for part, own in sizes.items():
        if comp & part:
            for name, size in own:
                yield "if " + " ".join(f":: {name} = {value}" for value in range(size)) + " fi;"


def _step(comp: int, k: int) -> Iterator[str]:
    if comp & 16:
        yield "was_on = on;"
    if comp & 1:
        yield from _monitor("t", "in_t == 0 || in_t == 4", "in_t == 2", steps(200, k))
    if comp & 2:
        yield from _monitor("b", "in_b == 0 || in_b == 3", "in_b == 2", steps(250, k))
    for name, part in LINKS:
        if comp & part:
            yield from _link(name, steps(50, k))
    yield f"lost = ({_any(f'{name} == 2' for name, part in LINKS if comp & part)});"
    if comp & 16:
        yield from _relay(steps(150, k))
    yield "near = 0; output = 0;"
    if comp & 32:
        yield from _obstacles(steps(150, k))
    others = [f"{name} == 2" for name, part in (("t", 1), ("b", 2)) if comp & part]
    yield f"critical = ({_any(['lost', *others])});"
    yield "assert(!(near && output != 3));"
    yield "moving = (!critical && output != 3); assert(!(critical && moving));"
    if comp & 16:
        yield "assert(!(!on && lost));"
    if comp & 64:
        yield "observed = observed || (was_on && !on && t == 0);"


def _any(conditions: Iterator[str] | list[str]) -> str:
    return " || ".join(conditions) or "0"


def _monitor(name: str, critical: str, fine: str, limit: int) -> Iterator[str]:
    count = f"{name}_count"
    yield f"streak = ({critical} -> ({count} + 1 < {limit} -> {count} + 1 : {limit}) : 0);"
    yield f"if :: {name} == 2 -> {name} = ({fine} -> 0 : 2)"
    yield f":: else -> {name} = ({critical} -> (streak >= {limit} -> 2 : 1) : ({fine} -> 0 : 1)) fi;"
    yield f"{count} = ({name} == 2 -> 0 : streak);"


def _link(name: str, limit: int) -> Iterator[str]:
    age, good = f"{name}_age", f"{name}_good"
    yield f"{age} = (in_{name} -> 0 : ({age} < 7 -> {age} + 1 : 7));"
    yield f"{good} = ({age} <= 2 -> ({good} < {limit} -> {good} + 1 : {limit}) : 0);"
    yield f"if :: {age} > 6 -> {name} = 2"
    yield f":: else -> if :: {name} == 0 -> {name} = ({age} > 2 -> 1 : 0)"
    yield f":: {name} == 1 -> {name} = ({age} <= 2 && {good} >= {limit} -> 0 : 1)"
    yield f":: else -> {name} = ({good} >= {limit} -> 0 : 2) fi fi;"
    yield f"{good} = ({name} == 0 -> 0 : {good});"


def _relay(limit: int) -> Iterator[str]:
    yield "if :: lost -> on = 1; hold = 0 :: else -> if :: on ->"
    yield f"if :: hold + 1 >= {limit} -> on = 0; hold = 0 :: else -> hold = hold + 1 fi"
    yield ":: else -> skip fi fi;"


def _obstacles(limit: int) -> Iterator[str]:
    yield "now1 = (sonar1 == 2); now2 = (sonar2 == 2); now3 = (sonar3 == 2); clear = 1;"
    yield "left1 = (far1 && !now1); left2 = (far2 && !now2); left3 = (far3 && !now3);"
    yield "if :: command -> command = (turned -> 0 : command) :: else ->"
    seen = (("w12", "now2", 1), ("w21", "now1", 2), ("w23", "now3", 1), ("w32", "now2", 2))
    for window, now, command in seen:
        yield f"if :: {window} > 0 && {now} -> command = {command} :: else ->"
    yield "clear = 0 fi fi fi fi fi;"
    yield "if :: clear -> w12 = 0; w21 = 0; w23 = 0; w32 = 0 :: else ->"
    windows = (("w12", "left1"), ("w21", "left2"), ("w23", "left2"), ("w32", "left3"))
    yield "; ".join(f"{w} = ({left} -> {limit} : ({w} > 0 -> {w} - 1 : 0))" for w, left in windows) + " fi;"
    yield "far1 = now1; far2 = now2; far3 = now3;"
    yield "near = (sonar1 == 0 || sonar2 == 0 || sonar3 == 0); output = (near -> 3 : command);"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    print(promela(int(sys.argv[1]), int(sys.argv[2])), end="")
