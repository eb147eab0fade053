"""Monitors for engines, form by form, each with its counter: what those in past-time logic must say."""

from rovercheck.properties.forms import (
    Always,
    EntersOnlyIf,
    Form,
    HoldsAfter,
    HoldsFor,
    LeavesOnlyIf,
    Never,
    Precedes,
    Property,
    Reachable,
    Responds,
    Until,
)
from rovercheck.properties.reduce import _counting, _Monitors, _one, _unit, _zero
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import Const, Expr, all_of, ite
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.words import maximum, minimum


class MonitorsByForm(_Monitors):
    """The monitors, with the forms as they were defined before there was one definition for all readers."""

    def _form(self, form: Form) -> tuple[Expr, Expr | None]:
        return self._of(Property(self._owner, "", form, ("R",), ""), self.armed)

    def _of(self, prop: Property, armed: Expr) -> tuple[Expr, Expr | None]:
        """The goal formula, and the formula whose falsity it reports (None: reaching is wanted)."""
        f = self
        match prop.form:
            case Always(that):
                return all_of(armed, ~f(that)), that
            case Never(that):
                return all_of(armed, f(that)), ~that
            case Reachable(that):
                return all_of(armed, f(that)), None
            case Responds(trigger, response, within):
                return self._responds(all_of(armed, f(trigger)), f(response), within), response
            case HoldsAfter(premise, for_, then):
                self._ticks("for_", for_)
                held = self.held(all_of(armed, f(premise)), for_)
                return held & ~f(then), then
            case HoldsFor(start, that, for_):
                return self._holds_for(f(start), armed, f(that), for_), that
            case LeavesOnlyIf(leaving, only_if):
                left = self.previous(f(leaving), 0) & ~f(leaving)
                return all_of(armed, left, ~f(only_if)), only_if
            case EntersOnlyIf(entering, only_if):
                entered = ~self.previous(f(entering), 0) & f(entering)
                return all_of(armed, entered, ~f(only_if)), only_if
            case Precedes(first, then):
                return all_of(armed, f(then), ~self.once(f(first))), first
            case Until(start, holds, release):
                return self._until(all_of(armed, f(start)), f(holds), f(release)), holds
        raise AssertionError(prop.form)

    def _responds(self, trigger: Expr, response: Expr, within: Span) -> Expr:
        length, passed = self._ticks("within", within), self._passed(within)
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

    def _holds_for(self, start: Expr, armed: Expr, that: Expr, for_: Span) -> Expr:
        length, passed = self._ticks("for_", for_), self._passed(for_)
        doc = f"{_unit(passed)} for which it must still hold, this one included"
        left = self._own("left", _counting(length + 1, passed), doc)
        begins = all_of(armed, start & ~self.previous(start, 0))
        less = maximum(left - (1 if passed is None else passed), 0)
        self.before.append(Assign(left, ite(begins, Const(length + 1, left.sort), less)))
        return (left > 0) & ~that

    def _until(self, start: Expr, holds: Expr, release: Expr) -> Expr:
        open_ = self._own("open", boolean, "started and not released")
        self.before.append(Assign(open_, (open_ | start) & ~release))
        return open_ & ~holds
