"""RoverLite in the language of step programs: a small stand-in for the rover, to time engines on.

The parts are chosen by the bits of ``comp`` (1 temperature, 2 battery, 4 reception, 8 heartbeat,
16 relay, 32 obstacles, 64 observer of P5); timers are divided by ``k``.  ``benchmarks/peers`` holds
the same model for other tools, ``tests/engines/test_roverlite.py`` as a plain reference.
"""

from collections.abc import Sequence

from rovercheck.properties.forms import Property, never
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import Domain, boolean, enumeration, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, any_of, const, flag, ite, member, var
from rovercheck.spec_model.lang.system import Program, Statement, System, TransitionSystem, in_order
from rovercheck.spec_model.lang.words import maximum, minimum

STATUS = enumeration("Status", ["OK", "DEGRADED", "CRITICAL"])
OK, DEGRADED, CRITICAL = (member(STATUS, name) for name in ("OK", "DEGRADED", "CRITICAL"))
TEMPERATURE = enumeration("Temperature", ["COLD_CRITICAL", "COLD", "FINE", "HOT", "HOT_CRITICAL"])
CHARGE = enumeration("Charge", ["CRITICAL_LOW", "LOW", "FINE", "OVER"])
SONAR = enumeration("Sonar", ["NEAR", "MID", "FAR", "NONE"])
COMMAND = enumeration("Command", ["NONE", "LEFT", "RIGHT"])
OUTPUT = enumeration("Output", ["NONE", "LEFT", "RIGHT", "STOP"])
FULL = 127
"""All parts."""


class Made:
    """The parts of one system while they are put together."""

    def __init__(self) -> None:
        self.inputs: list[Var] = []
        self.variables: list[Var] = []
        self.step: list[Statement] = []
        self.never: list[Expr] = []

    def input(self, name: str, domain: Domain) -> Var:
        self.inputs.append(var(name, domain))
        return self.inputs[-1]

    def variable(self, name: str, domain: Domain, init: int = 0) -> Var:
        self.variables.append(Var(name, domain, init))
        return self.variables[-1]


def ticks(n: int, k: int) -> int:
    """``n`` ticks at full timing, divided by ``k``."""
    return max(1, n // k)


def monitor(made: Made, name: str, critical: Expr, fine: Expr, limit: int) -> Var:
    """OK, DEGRADED, and CRITICAL after ``limit`` consecutive critical ticks."""
    status = made.variable(f"{name}_status", STATUS)
    count = made.variable(f"{name}_count", integer(0, limit))
    healthy = ite(fine, OK, DEGRADED)
    made.step += [
        Assign(count, ite(critical, minimum(count + 1, limit), 0)),
        If(
            status == CRITICAL,
            (If(fine, (Assign(status, OK),)),),
            (Assign(status, ite(critical, ite(count >= limit, CRITICAL, DEGRADED), healthy)),),
        ),
        If(status == CRITICAL, (Assign(count, const(0)),)),
    ]
    made.never.append((status == CRITICAL) & (count > 0))
    return status


def stale(made: Made, name: str, limit: int) -> Var:
    """OK while messages are fresh; back to OK after ``limit`` good ticks."""
    new = made.input(f"{name}_new", boolean)
    status = made.variable(f"{name}_status", STATUS)
    age = made.variable(f"{name}_age", integer(0, 7))
    good = made.variable(f"{name}_good", integer(0, limit))
    made.step += [
        Assign(age, ite(new, 0, minimum(age + 1, 7))),
        Assign(good, ite(age <= 2, minimum(good + 1, limit), 0)),
        If(
            age > 6,
            (Assign(status, CRITICAL),),
            (
                If(
                    status == OK,
                    (Assign(status, ite(age > 2, DEGRADED, OK)),),
                    (
                        If(
                            status == DEGRADED,
                            (Assign(status, ite((age <= 2) & (good >= limit), OK, DEGRADED)),),
                            (Assign(status, ite(good >= limit, OK, CRITICAL)),),
                        ),
                    ),
                ),
            ),
        ),
        If(status == OK, (Assign(good, const(0)),)),
    ]
    made.never.append((status == OK) & (good > 0))
    return status


def relay(made: Made, critical: Expr, limit: int) -> Var:
    """On while a link is critical, off ``limit`` ticks after."""
    on = made.variable("relay_on", boolean)
    hold = made.variable("relay_hold", integer(0, limit - 1))
    off = (Assign(on, FALSE), Assign(hold, const(0)))
    made.step.append(
        If(
            critical,
            (Assign(on, TRUE), Assign(hold, const(0))),
            (If(on, (If(hold + 1 >= limit, off, (Assign(hold, minimum(hold + 1, limit - 1)),)),)),),
        )
    )
    made.never.append(~on & (hold > 0))
    return on


def history(made: Made, critical: Expr, limit: int) -> Var:
    """The ticks since the last critical one, counted up to ``limit``; ``limit`` before the first tick."""
    since = made.variable("since_critical", integer(0, limit), limit)
    made.step.append(Assign(since, ite(critical, 0, minimum(since + 1, limit))))
    return since


def obstacles(made: Made, limit: int) -> tuple[Var, Expr]:
    """A falling edge of far opens a window; far on the neighbour inside it commands a deviation.

    Gives whether a sonar sees something near, and whether the output is to stop, both registered.
    """
    sonar = [made.input(f"sonar{i}", SONAR) for i in (1, 2, 3)]
    far = [s == member(SONAR, "FAR") for s in sonar]
    command = deviation(made, far, limit)
    near = made.variable("near", boolean)
    output = made.variable("output", OUTPUT)
    made.step.append(Assign(near, any_of(*(s == member(SONAR, "NEAR") for s in sonar))))
    shown: Expr = member(OUTPUT, "NONE")
    for name in ("LEFT", "RIGHT"):
        shown = ite(command == member(COMMAND, name), member(OUTPUT, name), shown)
    made.step.append(Assign(output, ite(near, member(OUTPUT, "STOP"), shown)))
    return near, output == member(OUTPUT, "STOP")


def deviation(made: Made, far: Sequence[Expr], limit: int) -> Var:
    """The command, which is held until the input ``turned``."""
    turned = made.input("turned", boolean)
    was = [made.variable(f"was_far{i}", boolean) for i in (1, 2, 3)]
    command = made.variable("command", COMMAND)
    window = {p: made.variable(f"window{p}", integer(0, limit)) for p in ("12", "21", "23", "32")}
    left = {p: was[int(p[0]) - 1] & ~far[int(p[0]) - 1] for p in window}
    falling = {p: made.variable(f"falling{p}", boolean) for p in window}
    clear = tuple(Assign(w, const(0)) for w in window.values())
    run: Program = tuple(Assign(w, ite(falling[p], limit, maximum(w - 1, 0))) for p, w in window.items())
    for p, direction in (("32", "RIGHT"), ("23", "LEFT"), ("21", "RIGHT"), ("12", "LEFT")):
        seen = (window[p] > 0) & far[int(p[1]) - 1]
        run = (If(seen, (Assign(command, member(COMMAND, direction)), *clear), run),)
    none = member(COMMAND, "NONE")
    made.step += [Assign(falling[p], left[p]) for p in window]
    made.step.append(If(command != none, (If(turned, (Assign(command, none),)), *clear), run))
    made.step += [Assign(w, f) for w, f in zip(was, far, strict=True)]
    made.never.append((command != none) & (window["12"] > 0))
    return command


def temperature_part(made: Made, k: int) -> Expr:
    """The status of the temperature, read as one of five classes."""
    t = made.input("temperature", TEMPERATURE)
    critical = any_of(*(t == member(TEMPERATURE, n) for n in ("COLD_CRITICAL", "HOT_CRITICAL")))
    return monitor(made, "temperature", critical, t == member(TEMPERATURE, "FINE"), ticks(200, k))


def battery_part(made: Made, k: int) -> Expr:
    """The status of the battery, read as one of four classes."""
    b = made.input("charge", CHARGE)
    critical = any_of(*(b == member(CHARGE, n) for n in ("CRITICAL_LOW", "OVER")))
    return monitor(made, "battery", critical, b == member(CHARGE, "FINE"), ticks(250, k))


def roverlite(comp: int, k: int = 1) -> tuple[TransitionSystem, tuple[Var, ...]]:
    """The system and its goals, as far as its parts allow; a goal is true when the property is broken.

    P1   a near obstacle stops the rover in the same tick
    P2   nothing is critical while it may move
    P3   the relay is off only while no link is critical
    P3h  the relay is off only 150/k ticks or more after the last tick with a critical link
    P4   (false) the temperature is never critical
    P5   (false) the temperature is never critical after the relay was released with it OK

    The last goal, ``broken``, is a condition about every part that is never true, so that every part
    belongs to its slice.  Raises ``ValueError`` for an observer of parts that are not there.
    """
    made = Made()
    has = [bool(comp >> i & 1) for i in range(7)]
    if has[6] and not (has[0] and has[4]):
        raise ValueError(f"parts {comp}: the observer, 64, watches temperature and relay; add 1 and 16.")
    goals: dict[str, Expr] = {}
    temperature = temperature_part(made, k) if has[0] else OK
    battery = battery_part(made, k) if has[1] else OK
    links = [stale(made, n, ticks(50, k)) for n, on in (("rx", has[2]), ("beat", has[3])) if on]
    lost = any_of(*(s == CRITICAL for s in links))
    if has[4]:
        was_on = made.variable("relay_was_on", boolean)
        made.step.append(Assign(was_on, var("relay_on", boolean)))
        on = relay(made, lost, ticks(150, k))
        goals["P3"] = ~on & lost
        goals["P3h"] = ~on & (history(made, lost, ticks(150, k)) < ticks(150, k))
    near, stop = obstacles(made, ticks(150, k)) if has[5] else (FALSE, FALSE)
    moving = made.variable("moving", boolean, init=1)
    critical = any_of(lost, temperature == CRITICAL, battery == CRITICAL)
    made.step.append(Assign(moving, ~critical & ~stop))
    goals |= {"P1": near & ~stop, "P2": critical & moving}
    if has[0]:
        goals["P4"] = temperature == CRITICAL
    if has[6]:
        observed = made.variable("observed", boolean)
        made.step.append(Assign(observed, observed | (was_on & ~on & (temperature == OK))))
        goals["P5"] = observed & (temperature == CRITICAL)
    goals = dict(sorted(goals.items())) | {"broken": any_of(*made.never)}
    made.step += [Assign(flag(name), broken) for name, broken in goals.items()]
    names = tuple(map(flag, goals))
    system = TransitionSystem(
        f"roverlite-{comp}-{k}", tuple(made.inputs), (), (*made.variables, *names), (), tuple(made.step)
    )
    return system, names


def question(comp: int, k: int = 1) -> tuple[System, list[Property]]:
    """RoverLite as a system of one block and P1..P5 as properties of it, as charts are put to ``decide``."""
    lowered, goals = roverlite(comp, k)
    system = in_order(lowered.name, Block("RoverLite", lowered.step))
    texts = (g for g in goals if g.name != "broken")
    return system, [
        never(f"RL-{g.name}", f"{g.name} is not broken.", that=g, covers=["-"], on=system.name) for g in texts
    ]
