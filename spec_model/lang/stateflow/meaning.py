"""Formulas of labels: what a tree means with the names of a chart; sorts are checked, with their place.

A number without a unit takes the unit of what it is compared with, added to or assigned to, as in a formula
in Python.  A factor without a unit takes the one that is missing: ``left = 60 * minutes``.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction

from rovercheck.spec_model.lang.domain import Bool, Enum, Num, Sort, Unit
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean, with_article
from rovercheck.spec_model.lang.expr import (
    FALSE,
    TRUE,
    Const,
    Expr,
    Temporal,
    When,
    all_of,
    any_of,
    as_boolean,
    as_number,
    const,
    ite,
    linear,
)
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.stateflow.message import Extent, LabelError
from rovercheck.spec_model.lang.stateflow.names import LabelNames
from rovercheck.spec_model.lang.stateflow.quantities import (
    SCALES,
    TIMES,
    arguments,
    factors,
    folded,
    inverse,
    is_literal,
    number_in,
    read_number,
    split_quantity,
    subtree,
    subtrees,
    unit_of_time,
)
from rovercheck.spec_model.lang.stateflow.sorts import Sorts, Unclear
from rovercheck.spec_model.lang.stateflow.syntax import REFUSED, Node, parsed, span
from rovercheck.spec_model.lang.time import Span
from rovercheck.spec_model.lang.words import (
    absolute,
    bit,
    held,
    maximum,
    minimum,
    modulo,
    once,
    previous,
    quotient,
    rising,
    sign,
    wrap,
)

_CALLS = {
    "abs": (1, absolute), "sign": (1, sign), "wrap": (1, wrap), "rising": (1, rising),
    "previous": (1, previous), "once": (1, once),
}  # fmt: skip
_PAIRS = {"min": minimum, "max": maximum}
WORDS = (
    *_CALLS,
    *_PAIRS,
    "after",
    "duration",
    "held",
    "mod",
    "rem",
    "bit",
    "in",
    "quotient",
    "modulo",
    "xor",
)
"""Functions that every label may call."""


class Formulas(Sorts):
    """Formulas of one text.  ``strange`` says which name stands where, of those that are no words."""

    def __init__(self, names: LabelNames, strange: dict[int, str]) -> None:
        super().__init__()
        self.names, self.strange = names, strange

    # --- formulas ------------------------------------------------------------------------------------

    def condition(self, node: Node) -> Expr:
        """A formula that must be a condition."""
        with located(node):
            return as_boolean(self.formula(node, Bool()), "[...]")

    def formula(self, node: Node, like: Sort | None = None) -> Expr:
        """The formula of a tree; ``like`` is the sort that is needed of it, where that is known."""
        make: Callable[[Node, Sort | None], Expr] = getattr(self, f"_{node.data}")
        with located(node):
            return make(node, like)

    def _formula(self, node: Node, like: Sort | None) -> Expr:
        return self.formula(subtree(node, 0), like)

    def _either(self, node: Node, like: Sort | None) -> Expr:
        return any_of(*self._conditions(node))

    def _both(self, node: Node, like: Sort | None) -> Expr:
        return all_of(*self._conditions(node))

    def _conditions(self, node: Node) -> Iterator[Expr]:
        sign = "||" if node.data == "either" else "&&"
        for part in subtrees(node):
            with located(part):
                yield as_boolean(self.formula(part, Bool()), sign)

    def _negated(self, node: Node, like: Sort | None) -> Expr:
        return ~as_boolean(self.formula(subtree(node, 1), Bool()), "!")

    def _comparison(self, node: Node, like: Sort | None) -> Expr:
        sign = str(node.children[1]).replace("~", "!")
        length = self._length(subtree(node, 0), sign, subtree(node, 2))
        if length is not None:
            return length
        one, two = self._alike([subtree(node, 0), subtree(node, 2)], None)
        return {
            "==": Expr.__eq__, "!=": Expr.__ne__, "<": Expr.__lt__,
            "<=": Expr.__le__, ">": Expr.__gt__, ">=": Expr.__ge__,
        }[sign](one, two)  # fmt: skip

    def _length(self, left: Node, sign: str, right: Node) -> Expr | None:
        """``duration(c) > 3 s``, which compares a time."""
        if left.data != "call" or str(left.children[0]) != "duration" or "duration" in self.names.functions:
            return None
        given = arguments(left)
        if len(given) not in (1, 2):
            raise LabelError("duration() takes a condition; write `duration(c) > 3 s`.", span(left))
        unit = unit_of_time(given[1]) if len(given) == 2 else None
        condition = self.condition(given[0])
        length = self.time(right, unit or TIMES["s"], bare=True)
        strict = sign in (">", "<=")
        if sign not in (">", ">=", "<", "<="):
            raise LabelError("a duration is compared by >, >=, < or <= only.", span(left))
        longer = Temporal(When.DURATION, condition, length, strict)
        return longer if sign in (">", ">=") else ~longer

    def _alike(self, nodes: Sequence[Node], like: Sort | None) -> list[Expr]:
        """Formulas that must be of one sort: what says none of itself takes that of the others."""
        anchor = self._first(nodes) or like
        made: list[Expr | None] = [None] * len(nodes)
        plain = [n for n in range(len(nodes)) if not is_literal(nodes[n])]
        for at in [*plain, *(n for n in range(len(nodes)) if n not in plain)]:
            made[at] = one = self.formula(nodes[at], anchor)
            if anchor is None and at in plain:
                anchor = one.sort
        return [one for one in made if one is not None]

    def _ite(self, node: Node, like: Sort | None) -> Expr:
        test, then, otherwise = subtrees(node)
        condition = self.condition(test)
        return ite(condition, *self._alike([then, otherwise], like))

    def _computed(self, node: Node, like: Sort | None) -> Expr:
        left, right, operator = subtree(node, 0), subtree(node, 2), str(node.children[1])
        match operator:
            case "+" | "-":
                one, two = self._alike([left, right], like)
                return linear(Op.ADD if operator == "+" else Op.SUB, one, two)
            case "*" | "/":
                return self._product(node, like)
            case "div":
                return quotient(self.formula(left, like), self._whole(right))
        return modulo(self.formula(left, like), self._number_of(right, "the divisor of a remainder"))

    def _product(self, node: Node, like: Sort | None) -> Expr:
        """A product or a quotient; the first factor that is a bare number takes the unit that is missing."""
        leaves = list(factors(node, False))
        bare = next((leaf for leaf, _ in leaves if leaf.data == "number"), None)
        made = {id(leaf): self.formula(leaf) for leaf, _ in leaves if leaf is not bare}
        if bare is not None:
            unit = Unit()
            for leaf, below in leaves:
                if leaf is not bare:
                    sort = as_number(made[id(leaf)], "*").sort
                    assert isinstance(sort, Num)
                    unit *= inverse(sort.unit) if below else sort.unit
            wanted = like.unit if isinstance(like, Num) else unit
            missing = wanted * inverse(unit)
            below = next(b for leaf, b in leaves if leaf is bare)
            made[id(bare)] = const(number_in(bare), inverse(missing) if below else missing)
        return self._multiplied(node, made)

    def _multiplied(self, node: Node, made: dict[int, Expr]) -> Expr:
        if id(node) in made:
            return made[id(node)]
        one, two = self._multiplied(subtree(node, 0), made), self._multiplied(subtree(node, 2), made)
        if str(node.children[1]) == "*":
            return one * two
        if not isinstance(two, Const) or not isinstance(two.sort, Num):
            raise LabelError(
                f"`{two}` is no constant; divide by a number, or compare products.", span(subtree(node, 2))
            )
        if two.value == 0:
            raise LabelError("a division by 0 has no meaning.", span(subtree(node, 2)))
        once_per = const(1 / (two.value * two.sort.resolution), inverse(two.sort.unit))
        return folded(one, once_per) if is_literal(subtree(node, 0)) else one * once_per

    def _signed(self, node: Node, like: Sort | None) -> Expr:
        sign = str(node.children[0])
        part = as_number(self.formula(subtree(node, 1), like), sign)
        if sign == "+":
            return part
        return Const(-part.value, part.sort) if isinstance(part, Const) and part.value > 0 else -part

    def _signed_twice(self, node: Node, like: Sort | None) -> Expr:
        part = as_number(self.formula(subtree(node, 1), like), "-")
        once_ = Const(-part.value, part.sort) if isinstance(part, Const) and part.value > 0 else -part
        return part if str(node.children[0]) == "++" else -once_

    def _number(self, node: Node, like: Sort | None) -> Expr:
        value = number_in(node)
        if isinstance(like, Bool) and value in (0, 1) and value.denominator == 1:
            raise LabelError(f"`{value}` is a number; write `{'true' if value else 'false'}`.", span(node))
        return const(value, like.unit if isinstance(like, Num) else "")

    def _quantity(self, node: Node, like: Sort | None) -> Expr:
        number, unit = split_quantity(str(node.children[0]))
        fits = isinstance(like, Num) and Unit.of(unit) == like.unit
        if unit in self.names.values and not fits:
            raise LabelError(f"an operator is missing; write `{number} * {unit}`.", span(node))
        if isinstance(like, Num) and not fits:
            for table in SCALES:
                if unit in table and str(like.unit) in table:
                    return const(read_number(number) * table[unit] / table[str(like.unit)], like.unit)
        return const(read_number(number), unit)

    def _name(self, node: Node, like: Sort | None) -> Expr:
        return self._named(str(node.children[0]), span(node), like)

    def _strange(self, node: Node, like: Sort | None) -> Expr:
        return self._named(self.strange[span(node).start], span(node), like)

    def _named(self, name: str, at: Extent, like: Sort | None) -> Expr:
        if name in ("true", "false") and name not in self.names.values:
            return TRUE if name == "true" else FALSE
        found = self.names.value(name, at)
        if isinstance(found, Expr):
            return found
        fitting = [one for one in found if one.sort == like]
        if len(found) == 1 or fitting:
            return (fitting or found)[0]
        if isinstance(like, Enum):
            raise LabelError(f"`{name}` is no member of {like}. {did_you_mean(name, dict(like.members))}", at)
        raise Unclear(
            f"`{name}` is a member of {' and of '.join(str(one.sort) for one in found)}; write "
            f"`{found[0].sort}.{name}`.",
            at,
        )

    def _element(self, node: Node, like: Sort | None) -> Expr:
        name = str(node.children[0])
        if name not in self.names.arrays:
            if name in self.names.values:
                raise LabelError(f"`{name}` is no array; write `{name}` alone.", span(node))
            raise LabelError(f"`{name}` is no array. {did_you_mean(name, self.names.arrays)}", span(node))
        array = self.names.arrays[name]
        return array[self.index(array.keys, subtree(node, 1))]

    def index(self, keys: Sequence[object], node: Node) -> Expr | str:
        """The index of an element: a name among its keys, or a formula."""
        inner = node
        while inner.data == "formula":
            inner = subtree(inner, 0)
        name = str(inner.children[0]) if inner.data == "name" else ""
        return name if name in keys and name not in self.names.values else self.formula(node)

    def _call(self, node: Node, like: Sort | None) -> Expr:
        name, given = str(node.children[0]), arguments(node)
        if name in self.names.functions:
            return self.names.functions[name].formula(*(self.formula(one) for one in given))
        if name in _PAIRS:
            self._counted(node, name, given, 2)
            return _PAIRS[name](*self._alike(given, like))
        if name in _CALLS:
            count, make = _CALLS[name]
            self._counted(node, name, given, count)
            return make(self.formula(given[0]))
        match name:
            case "after":
                return Temporal(When.AFTER, None, self.span_of(node, given))
            case "held":
                self._counted(node, name, given, 2)
                return held(self.condition(given[0]), self.time(given[1], TIMES["s"]))
            case "duration":
                raise LabelError("a duration is compared with a time; write `duration(c) > 3 s`.", span(node))
            case "bit":
                self._counted(node, name, given, 2)
                return bit(self.formula(given[0]), self._whole(given[1]))
            case "mod" | "modulo":
                self._counted(node, name, given, 2)
                return modulo(self.formula(given[0], like), self._number_of(given[1], "a divisor"))
            case "quotient":
                self._counted(node, name, given, 2)
                return quotient(self.formula(given[0], like), self._whole(given[1]))
            case "xor":
                self._counted(node, name, given, 2)
                return self.condition(given[0]) != self.condition(given[1])
            case "in":
                self._counted(node, name, given, 1)
                return self._active(given[0])
        if name in REFUSED:
            raise LabelError(f"`{name}()` is no word of charts here; {REFUSED[name]}.", span(node))
        if name in self.names.values:
            raise LabelError(
                f"`{name}` is {with_article(self.names.values[name].sort)}, no function.", span(node)
            )
        near = did_you_mean(name, [*self.names.functions, *WORDS])
        raise LabelError(f"there is no function `{name}`. {near}", span(node))

    def _counted(self, node: Node, name: str, given: Sequence[Node], count: int) -> None:
        if len(given) != count:
            shown = f"{count} argument{'' if count == 1 else 's'}"
            raise LabelError(f"{name}() takes {shown}, not {len(given)}.", span(node))

    def _active(self, node: Node) -> Expr:
        name = str(node.children[0]) if node.data == "name" else ""
        chart, _, state = name.partition(".")
        if chart in self.names.charts:
            return (
                self.names.charts[chart].active(state) if state else self.names.charts[chart].active_path(())
            )
        if not name or self.names.own is None:
            raise LabelError("in() takes the name of a state.", span(node))
        return self.names.own.active(name)

    # --- numbers and lengths of time ---------------------------------------------------------------------

    def _number_of(self, node: Node, what: str) -> Fraction:
        made = self.formula(node)
        if not isinstance(made, Const) or not isinstance(made.sort, Num):
            raise LabelError(f"{what} is a constant; `{made}` is none.", span(node))
        return made.value * made.sort.resolution

    def _whole(self, node: Node) -> int:
        number = self._number_of(node, "a whole number")
        if number.denominator != 1:
            raise LabelError(f"`{number}` is no whole number; write one.", span(node))
        return int(number)

    def span_of(self, node: Node, given: Sequence[Node]) -> Span:
        """The time of ``after(3 s)`` and of ``after(3, sec)``."""
        if len(given) == 2:
            return self.time(given[0], unit_of_time(given[1]), bare=True)
        if len(given) != 1:
            raise LabelError("after() takes a time; write `after(3 s)` or `after(3, sec)`.", span(node))
        return self.time(given[0], None)

    def time(self, node: Node, unit: Span | None, bare: bool = False) -> Span:
        """A length of time; ``unit`` is that of a number without one."""
        while node.data == "formula":
            node = subtree(node, 0)
        if node.data == "quantity":
            number, name = split_quantity(str(node.children[0]))
            if name not in TIMES:
                known = "`ms`, `s`, `min` or `ticks`"
                raise LabelError(f"`{name}` is no unit of time; write {known}.", span(node))
            return TIMES[name] * read_number(number)
        number_ = self._number_of(node, "a length of time")
        if unit is None or (not bare and number_ != 0):
            raise LabelError(f"`{number_}` has no unit; write `{number_} s` or `{number_} ms`.", span(node))
        return unit * number_


@contextmanager
def located(node: Node) -> Iterator[None]:
    """What the language refuses is wrong with this part of the text."""
    try:
        yield
    except LabelError:
        raise
    except ModelError as error:
        raise LabelError(str(error).partition(" Python reads ")[0], span(node)) from None


def formula_of(text: str, names: LabelNames, like: Sort | None = None) -> Expr:
    """The formula of a text, as between the brackets of a label.  Raises ``LabelError``."""
    masked, strange = names.mask(text)
    return Formulas(names, strange).formula(parsed(text, "formula", masked), like)
