"""RoverLite in the language of step programs: a small stand-in for the rover, to time engines on.

The parts are chosen by the bits of ``comp`` (1 temperature, 2 battery, 4 reception, 8 heartbeat,
16 relay, 32 obstacles, 64 observer of P5); timers are divided by ``k``.  ``benchmarks/c`` is the
same model written by hand in C.
"""

from spec_model.lang.action import Assign, If
from spec_model.lang.domain import Domain, boolean, enumeration, integer
from spec_model.lang.expr import FALSE, TRUE, Expr, Var, any_of, const, flag, ite, member, var
from spec_model.lang.system import Program, Statement, TransitionSystem
from spec_model.lang.words import minimum

STATUS = enumeration("Status", ["OK", "DEGRADED", "CRITICAL"])
OK, DEGRADED, CRITICAL = (member(STATUS, name) for name in ("OK", "DEGRADED", "CRITICAL"))
TEMPERATURE = enumeration("Temperature", ["COLD_CRITICAL", "COLD", "FINE", "HOT", "HOT_CRITICAL"])
CHARGE = enumeration("Charge", ["CRITICAL_LOW", "LOW", "FINE", "OVER"])
SONAR = enumeration("Sonar", ["NEAR", "MID", "FAR", "NONE"])
COMMAND = enumeration("Command", ["NONE", "LEFT", "RIGHT"])


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

    def variable(self, name: str, domain: Domain) -> Var:
        self.variables.append(var(name, domain))
        return self.variables[-1]


def ticks(n: int, k: int) -> int:
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
    on = made.variable("relay_on", boolean)
    hold = made.variable("relay_hold", integer(0, limit - 1))
    off = (Assign(on, FALSE), Assign(hold, const(0)))
    made.step.append(
        If(
            critical,
            (Assign(on, TRUE), Assign(hold, const(0))),
            (If(on, (If(hold + 1 >= limit, off, (Assign(hold, hold + 1),)),)),),
        )
    )
    made.never.append(~on & (hold > 0))
    return on


def obstacles(made: Made, limit: int) -> Expr:
    """A falling edge of far opens a window; far on the neighbour inside it commands a deviation."""
    sonar = [made.input(f"sonar{i}", SONAR) for i in (1, 2, 3)]
    turned = made.input("turned", boolean)
    was = [made.variable(f"was_far{i}", boolean) for i in (1, 2, 3)]
    command = made.variable("command", COMMAND)
    window = {p: made.variable(f"window{p}", integer(0, limit)) for p in ("12", "21", "23", "32")}
    far = [s == member(SONAR, "FAR") for s in sonar]
    left = {p: was[int(p[0]) - 1] & ~far[int(p[0]) - 1] for p in window}
    falling = {p: made.variable(f"falling{p}", boolean) for p in window}
    clear = tuple(Assign(w, const(0)) for w in window.values())
    run: Program = tuple(Assign(w, ite(falling[p], limit, ite(w > 0, w - 1, 0))) for p, w in window.items())
    for p, direction in (("32", "RIGHT"), ("23", "LEFT"), ("21", "RIGHT"), ("12", "LEFT")):
        seen = (window[p] > 0) & far[int(p[1]) - 1]
        run = (If(seen, (Assign(command, member(COMMAND, direction)), *clear), run),)
    none = member(COMMAND, "NONE")
    made.step += [Assign(falling[p], left[p]) for p in window]
    made.step.append(If(command != none, (If(turned, (Assign(command, none),)), *clear), run))
    made.step += [Assign(w, f) for w, f in zip(was, far, strict=True)]
    made.never.append((command != none) & (window["12"] > 0))
    near = any_of(*(s == member(SONAR, "NEAR") for s in sonar))
    stop = made.variable("stop", boolean)
    made.step.append(Assign(stop, near))
    return near & ~stop


def roverlite(comp: int, k: int = 1) -> tuple[TransitionSystem, tuple[Var, ...]]:
    """The system and its goals P1, P3, P4, P5 as far as its parts allow, and ``broken``: a
    condition about every part that is never true, so that every part belongs to its slice."""
    made = Made()
    has = [bool(comp >> i & 1) for i in range(7)]
    goals: list[tuple[Var, Expr]] = []
    temperature: Expr = OK
    if has[0]:
        t = made.input("temperature", TEMPERATURE)
        critical = any_of(*(t == member(TEMPERATURE, n) for n in ("COLD_CRITICAL", "HOT_CRITICAL")))
        fine = t == member(TEMPERATURE, "FINE")
        temperature = monitor(made, "temperature", critical, fine, ticks(200, k))
        goals.append((flag("P4"), temperature == CRITICAL))
    if has[1]:
        b = made.input("charge", CHARGE)
        critical = any_of(*(b == member(CHARGE, n) for n in ("CRITICAL_LOW", "OVER")))
        monitor(made, "battery", critical, b == member(CHARGE, "FINE"), ticks(250, k))
    lost = [stale(made, n, ticks(50, k)) == CRITICAL for n, on in (("rx", has[2]), ("beat", has[3])) if on]
    was_on = made.variable("relay_was_on", boolean)
    if has[4]:
        on = var("relay_on", boolean)
        made.step.append(Assign(was_on, on))
        on = relay(made, any_of(*lost), ticks(150, k))
        goals.append((flag("P3"), ~on & any_of(*lost)))
    if has[5]:
        goals.append((flag("P1"), obstacles(made, ticks(150, k))))
    if has[6]:
        observed = made.variable("observed", boolean)
        made.step.append(Assign(observed, observed | (was_on & ~on & (temperature == OK))))
        goals.append((flag("P5"), observed & (temperature == CRITICAL)))
    goals.append((flag("broken"), any_of(*made.never)))
    made.step += [Assign(g, e) for g, e in goals]
    names = tuple(g for g, _ in goals)
    system = TransitionSystem(
        f"roverlite-{comp}-{k}", tuple(made.inputs), (), (*made.variables, *names), (), tuple(made.step)
    )
    return system, names
