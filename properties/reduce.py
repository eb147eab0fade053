"""From a property to a goal that engines decide: monitor statements appended to the step, and the way home.

A monitor reads the state at the end of a tick, with the inputs of the tick.  Memories that two
properties share (the same ``previous(x)``, the same tick counter) are made once.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

from rovercheck.properties.forms import Form, LeadsTo, Property, Recoverable, Settles
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import MOST, Domain, boolean, integer
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import TRUE, Apply, Const, Expr, Named, Temporal, Var, When, ite
from rovercheck.spec_model.lang.lower.ranges import possible
from rovercheck.spec_model.lang.system import Statement, System, TransitionSystem
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.walk import outermost, plain, structure, variables
from rovercheck.spec_model.lang.wellformed.data import twin_faults
from rovercheck.spec_model.lang.words import maximum, minimum


@dataclass(frozen=True)
class Goal:
    """What an engine decides: is ``var`` ever 1 after a tick?

    ``reach`` tells that reaching it is what the property wants.  ``parts`` pairs each conjunct of
    the property, as written, with its formula over the monitored system's variables.
    ``memory`` names the monitor variables that outlive a tick.

    No single tick breaks a ``LeadsTo`` or a ``Settles``, but a loop: ``var`` is true in every tick of
    it, and each of ``recurs`` in some (see ``checker.verify.liveness.loops``).  For a ``Recoverable``,
    ``var`` is true in the ticks to come back to.
    """

    property: Property
    var: Var
    reach: bool
    parts: tuple[tuple[Expr, Expr], ...]
    memory: frozenset[str]
    recurs: tuple[Var, ...] = ()


@dataclass(frozen=True)
class Question:
    """A monitored system and its goals."""

    system: TransitionSystem
    goals: tuple[Goal, ...]


def without_step(system: System) -> TransitionSystem:
    """What properties of a system may speak of, without the step: enough to see which memories they need."""
    places = [v for c in system.charts for v in (*c.locations, c.entered)]
    own = [v for v in system.written.values() if v.name not in {f.name for f in system.frozen}]
    inputs = tuple(system.inputs.values())
    return TransitionSystem(
        system.name, inputs, system.frozen, (*places, *own), (), (), tick_ms=system.tick_ms,
        elapsed=system.elapsed,
    )  # fmt: skip


def reduce(system: TransitionSystem, properties: Sequence[Property]) -> Question:
    """Monitor the properties on the system.

    Raises ``ModelError`` for a property that reads a variable the system does not have, or uses a
    temporal word that belongs to charts.
    """
    made = _Monitors(system)
    goals = tuple(made.goal(p) for p in properties)
    statements = (*system.step, *made.before, *made.goals, *made.after)
    monitored = replace(
        system,
        variables=(*system.variables, *made.variables.values()),
        step=statements,
    )
    return Question(monitored, goals)


class _Monitors:
    """Monitor variables and statements under construction."""

    def __init__(self, system: TransitionSystem) -> None:
        self.system = system
        self.known = {v.name: v for v in (*system.variables, *system.inputs, *system.frozen)}
        self.taken = {*self.known, *(v.name for v in system.temps)}
        self.variables: dict[str, Var] = {}
        self.before: list[Statement] = []
        self.goals: list[Statement] = []
        self.after: list[Statement] = []
        self._shared: dict[tuple[object, ...], Expr] = {}
        self._owner = ""
        self.armed: Expr = TRUE
        self._used: set[str] = set()

    def goal(self, prop: Property) -> Goal:
        """Append the monitor of one property."""
        self._owner, self._used = prop.id, set()
        self.armed = self._armed(prop.from_tick)
        bad, wanted = self._form(prop.form)
        doc = f"{prop.id} is {'reached' if wanted is None else 'broken'}"
        var = self._at_end(prop.id, bad, doc)
        recurs = tuple(
            self._at_end(f"{prop.id}.recurs{i}", self(c), f"{c} in this tick")
            for i, c in enumerate(_recurring(prop))
        )
        parts = [(p, self(p)) for p in (outermost(wanted) if wanted is not None else ())]
        passing = {prop.id, *(v.name for v in recurs)}
        return Goal(prop, var, wanted is None, tuple(parts), frozenset(self._used - passing), recurs)

    def _at_end(self, name: str, value: Expr, doc: str) -> Var:
        """A variable that tells at the end of a tick whether something is so in it."""
        var = self._variable(name, boolean, 0, doc)
        self.goals.append(Assign(var, value))
        return var

    def _form(self, form: Form) -> tuple[Expr, Expr | None]:
        """The goal formula, and the formula whose falsity it reports (None: reaching is wanted)."""
        match form:
            case LeadsTo(trigger, response):
                pending = Var(self._owner, boolean)
                return (pending | (self.armed & self(trigger))) & ~self(response), response
            case Settles(premise, then):
                return self(premise), then
            case Recoverable(to):
                return self(to), to
            case bounded:
                for argument in fields(bounded):
                    if isinstance(span := getattr(bounded, argument.name), Span):
                        self._ticks(argument.name, span)
                return bounded.monitor(self)[1], bounded.wanted

    # --- formulas about the past ---

    def __call__(self, expr: Expr, /) -> Expr:
        """The formula with temporal words replaced by monitor variables."""
        match expr:
            case Temporal(_, arg, _, _):
                if arg is None or expr.when in (When.AFTER, When.DURATION):
                    raise ModelError(
                        f"{self._owner}: `{expr}` belongs to a transition of a chart; in a property write "
                        "held(condition, for_=...) or previous(...)."
                    )
                return self._temporal(expr, self(arg))
            case Named(name, body):
                return Named(name, self(body))
            case Apply(op, args, sort):
                return Apply(op, tuple(self(a) for a in args), sort)
            case Var():
                return self._known(expr)
            case _:
                return expr

    def _known(self, var: Var) -> Var:
        """The variable of the system.  Raises ``ModelError`` where raw values mean something else."""
        own = self.known.get(var.name)
        if own is None:
            raise ModelError(
                f"{self._owner} reads {var.name}, which system {self.system.name} does not have. "
                f"{did_you_mean(var.name, self.known)}"
            )
        if own.sort != var.sort:
            faults = " ".join(twin_faults(own, var))
            raise ModelError(f"{self._owner} and system {self.system.name}: {faults}")
        return own

    def _temporal(self, word: Temporal, arg: Expr) -> Expr:
        match word.when:
            case When.PREVIOUS:
                return self.previous(arg, self._initial(arg))
            case When.RISING:
                return arg & ~self.previous(arg, 1)
            case When.HELD:
                assert word.span is not None
                self._ticks_of(word, word.span)
                return self.held(arg, word.span)
            case _:
                return self.once(arg)

    def previous(self, arg: Expr, init: int = 0, /) -> Expr:
        """The formula in the tick before, and a raw value in the first."""

        def make(name: str) -> Var:
            memory = self._variable(name, _domain_of(arg), init, f"{arg} at the end of the tick before")
            # In front: a memory of a memory reads the inner one before that is renewed.
            self.after.insert(0, Assign(memory, arg))
            return memory

        return self._memory(("previous", structure(arg), init), f"previous({arg})", make)

    def held(self, arg: Expr, span: Span, /) -> Expr:
        length, passed = self._length(span), self._passed(span)
        if length == 0:
            return arg

        def make(name: str) -> Expr:
            doc = f"{'ticks in a row' if passed is None else 'ms'} with {arg}"
            counter = self._variable(name, _counting(length + 1, passed), 0, doc)
            self.before.append(_count(counter, arg, passed))
            return counter >= length + 1

        key = ("held", structure(arg), length, passed is None)
        return self._memory(key, f"held({arg}, {length if passed is None else span})", make)

    def once(self, arg: Expr, /) -> Expr:
        def make(name: str) -> Var:
            seen = self._variable(name, boolean, 0, f"{arg} so far")
            self.before.append(Assign(seen, seen | arg))
            return seen

        return self._memory(("once", structure(arg)), f"once({arg})", make)

    def _armed(self, from_tick: int) -> Expr:
        if from_tick <= 1:
            return TRUE
        if from_tick > MOST:
            raise ModelError(
                f"{self._owner}: from_tick={from_tick} is later than any board counts in 64 bits; write less."
            )

        def make(name: str) -> Expr:
            past = self._variable(name, integer(0, from_tick - 1), 0, "ticks so far, saturating")
            self.after.append(Assign(past, minimum(past + 1, from_tick - 1)))
            return past >= from_tick - 1

        return self._memory(("ticks", from_tick), f"ticks past {from_tick - 1}", make)

    # --- words with a memory of their own ---

    def overdue(self, trigger: Expr, response: Expr, within: Span, /) -> Expr:
        length, passed = self._length(within), self._passed(within)
        if length == 0:
            return trigger & ~response
        # A response later than the last ms that is allowed comes too late; of ticks none is left out.
        most = length + (1 if passed is None else 2)
        doc = f"{_unit(passed)} a trigger has waited, this one included"
        waiting = self._own("waiting", _counting(most, passed), doc)
        first = ite(trigger, _one(waiting), _zero(waiting))
        later = ite(waiting > 0, minimum(waiting + (1 if passed is None else passed), most), first)
        in_time = response if passed is None else response & (later <= length + 1)
        self.before.append(Assign(waiting, ite(in_time, _zero(waiting), later)))
        return waiting >= length + 1

    def within(self, that: Expr, for_: Span, /) -> Expr:
        length, passed = self._length(for_), self._passed(for_)
        doc = f"{_unit(passed)} for which it must still hold, this one included"
        left = self._own("left", _counting(length + 1, passed), doc)
        less = maximum(left - (1 if passed is None else passed), 0)
        self.before.append(Assign(left, ite(that, Const(length + 1, left.sort), less)))
        return left > 0

    def since(self, start: Expr, release: Expr, /) -> Expr:
        open_ = self._own("open", boolean, "started and not released")
        self.before.append(Assign(open_, (open_ | start) & ~release))
        return open_

    # --- making variables ---

    def _memory(self, key: tuple[object, ...], name: str, make: Callable[[str], Expr]) -> Expr:
        if key not in self._shared:
            self._shared[key] = make(self._unique(name))
        self._used |= set(variables(self._shared[key]))
        return self._shared[key]

    def _unique(self, name: str) -> str:
        unique, number = name, len(self.variables)
        while unique in self.variables or unique in self.taken:
            unique, number = f"{name} #{number}", number + 1
        return unique

    def _own(self, name: str, domain: Domain, doc: str) -> Var:
        return self._variable(f"{self._owner}.{name}", domain, 0, doc)

    def _variable(self, name: str, domain: Domain, init: int, doc: str) -> Var:
        if name in self.taken or name in self.variables:
            whose = f"a variable of system {self.system.name}" if name in self.taken else "another property"
            said = f"its monitor has the name {name}, as {whose} has"
            raise ModelError(f"{self._owner}: {said}; give the property another id.")
        made = Var(name, domain, init, doc, hidden=True)
        self.variables[name] = made
        self._used.add(name)
        return made

    def _ticks(self, argument: str, span: Span) -> int:
        """The ticks of an argument.  Raises ``ModelError`` that names it."""
        try:
            return self._length(span)
        except ModelError as error:
            raise ModelError(f"{self._owner}: {argument}={error}") from None

    def _ticks_of(self, word: Temporal, span: Span) -> int:
        """The ticks of a temporal word.  Raises ``ModelError`` that shows it."""
        try:
            return self._length(span)
        except ModelError as error:
            raise ModelError(f"{self._owner}: `{word}`: {error}") from None

    def _length(self, span: Span) -> int:
        """The span in what its counter counts: ticks, or ms where ticks last unlike times."""
        return span.ticks(self.system.tick_ms if self._passed(span) is None else 1)

    def _passed(self, span: Span) -> Var | None:
        """By what its counter grows in a tick: by what has elapsed if it counts ms, else by 1 (None)."""
        return self.system.elapsed if span.measured(self.system.elapsed) else None

    def _initial(self, arg: Expr) -> int:
        """The value of a formula before the first tick; inputs have their initial values then."""
        return evaluate(arg, {name: v.init for name, v in variables(arg).items()})


def _domain_of(expr: Expr) -> Domain:
    inner = plain(expr)
    if isinstance(inner, Var):
        return inner.domain
    values = possible(expr)
    return Domain(expr.sort, range(min(values), max(values) + 1))


def _recurring(prop: Property) -> tuple[Expr, ...]:
    """What is true again and again in a run that breaks a property about infinite runs."""
    match prop.form:
        case LeadsTo(fair=fair):
            return fair
        case Settles(then=then, fair=fair):
            return (~then, *fair)
        case _:
            return ()


def _zero(counter: Var) -> Const:
    return Const(0, counter.sort)


def _one(counter: Var) -> Const:
    return Const(1, counter.sort)


def _unit(passed: Var | None) -> str:
    return "ticks" if passed is None else "ms"


def _counting(most: int, passed: Var | None) -> Domain:
    return integer(0, most, "" if passed is None else "ms")


def _count(counter: Var, condition: Expr, passed: Var | None) -> Assign:
    more = minimum(counter + (1 if passed is None else passed), counter.domain.high)
    if passed is not None:
        more = ite(counter > 0, more, _one(counter))
    return Assign(counter, ite(condition, more, _zero(counter)))


__all__ = ["Goal", "Question", "reduce", "without_step"]
