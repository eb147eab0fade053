"""Formulas as circuits: every expression becomes a literal (truth values) or a word (numbers)."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.encode.bits.aig import FALSE, TRUE, Aig, Literal, bits_of
from rovercheck.checker.system.intervals import Interval, interval, postorder
from rovercheck.spec_model.lang.domain import Bool, Domain
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

# --- numbers as lists of literals, least significant first, the last one being the sign (two's complement)

Word = list[Literal]


class BitWords:
    """Arithmetic on words of one graph; results are as wide as exactness needs."""

    def __init__(self, aig: Aig) -> None:
        self.aig = aig

    @staticmethod
    def const(value: int) -> Word:
        """The narrowest word for a number."""
        return [TRUE if b else FALSE for b in bits_of(value, Interval(value, value).width)]

    @staticmethod
    def fitted(a: Word, bits: int) -> Word:
        """The word in another width that holds its value."""
        return a[:bits] if len(a) >= bits else a + [a[-1]] * (bits - len(a))

    def aligned(self, a: Word, b: Word) -> tuple[Word, Word]:
        bits = max(len(a), len(b))
        return self.fitted(a, bits), self.fitted(b, bits)

    # --- choices and comparisons -----------------------------------------------------------------

    def choose(self, test: Literal, a: Word, b: Word) -> Word:
        """``a`` where the test is true, ``b`` elsewhere."""
        return [self.aig.mux(test, x, y) for x, y in zip(*self.aligned(a, b), strict=True)]

    def equal(self, a: Word, b: Word) -> Literal:
        return self.aig.all(self.aig.differ(x, y) ^ 1 for x, y in zip(*self.aligned(a, b), strict=True))

    def at_most(self, a: Word, b: Word) -> Literal:
        """``a <= b``: bit by bit from below, the sign last with its weight reversed."""
        a, b = self.aligned(a, b)
        result = TRUE
        for x, y in zip([*a[:-1], b[-1]], [*b[:-1], a[-1]], strict=True):
            result = self.aig.mux(self.aig.differ(x, y), y, result)
        return result

    def bit(self, a: Word, index: Word) -> Word:
        """The bit of that number, which is constant, as a word of its own."""
        number = value_of(index)
        return [self.fitted(a, number + 1)[number]]

    # --- sums ------------------------------------------------------------------------------------

    def _sum(self, a: Word, b: Word, carry: Literal) -> Word:
        aig, result = self.aig, []
        for x, y in zip(a, b, strict=True):
            odd = aig.differ(x, y)
            result.append(aig.differ(odd, carry))
            carry = aig.mux(odd, carry, x)
        return result

    def add(self, a: Word, b: Word) -> Word:
        bits = max(len(a), len(b)) + 1
        return self._sum(self.fitted(a, bits), self.fitted(b, bits), FALSE)

    def subtract(self, a: Word, b: Word) -> Word:
        bits = max(len(a), len(b)) + 1
        return self._sum(self.fitted(a, bits), self.flipped(self.fitted(b, bits)), TRUE)

    @staticmethod
    def flipped(a: Word) -> Word:
        """Every bit negated: ``-a - 1``."""
        return [x ^ 1 for x in a]

    def negative(self, a: Word) -> Word:
        return self.subtract([FALSE], a)

    def absolute(self, a: Word) -> Word:
        return self.choose(a[-1], self.negative(a), a)

    def least(self, a: Word, b: Word) -> Word:
        return self.choose(self.at_most(a, b), a, b)

    def greatest(self, a: Word, b: Word) -> Word:
        return self.choose(self.at_most(a, b), b, a)

    # --- products and quotients ------------------------------------------------------------------

    def multiply(self, a: Word, b: Word) -> Word:
        """Shifted sums; the sign bit of ``b`` counts negatively."""
        bits = len(a) + len(b)
        total: Word = [FALSE] * bits
        wide = self.fitted(a, bits)
        for i, y in enumerate(b):
            shifted = [self.aig.both(x, y) for x in [FALSE] * i + wide[: bits - i]]
            last = i == len(b) - 1
            total = self._sum(total, self.flipped(shifted) if last else shifted, TRUE if last else FALSE)
        return total

    def _divided(self, a: Word, b: Word) -> tuple[Word, Word]:
        """Quotient and remainder of a number that is not negative by a positive one."""
        bits = max(len(a), len(b)) + 1
        divisor, rest = self.fitted(b, bits), [FALSE] * bits
        quotient: Word = [FALSE] * len(a)
        for i in reversed(range(len(a))):
            rest = [a[i], *rest[:-1]]
            fits = self.at_most(divisor, rest)
            reduced = self._sum(rest, self.flipped(divisor), TRUE)
            rest = self.choose(fits, reduced, rest)
            quotient[i] = fits
        return [*quotient, FALSE], rest

    def divide(self, a: Word, b: Word) -> Word:
        """Rounded down; the divisor is positive: for a negative ``a``, ``~(~a / b)``."""
        sign = a[-1]
        quotient, _ = self._divided([self.aig.differ(x, sign) for x in a], b)
        return [self.aig.differ(x, sign) for x in quotient]

    def modulo(self, a: Word, b: Word) -> Word:
        """With the sign of the divisor, which is positive."""
        sign = a[-1]
        _, rest = self._divided([self.aig.differ(x, sign) for x in a], b)
        return self.choose(sign, self.subtract(self.subtract(b, rest), [TRUE, FALSE]), rest)


def value_of(bits: Sequence[int]) -> int:
    """The number that a word's values stand for."""
    return sum(b << i for i, b in enumerate(bits[:-1])) - (bits[-1] << len(bits) - 1)


Value = Word
"""A word; a truth value is a word of one literal."""


def bits_needed(var: Var) -> int:
    """The bits that stand for a variable, one at least: no sign where its domain has no negative value."""
    if isinstance(var.sort, Bool):
        return 1
    low, high = var.domain.low, var.domain.high
    return max(Interval(low, high).width - (low >= 0), 1)


def as_word(var: Var, bits: Sequence[Literal]) -> Value:
    """The bits of a variable as a value."""
    signless = not isinstance(var.sort, Bool) and var.domain.low >= 0
    return [*bits, FALSE] if signless else list(bits)


class Blaster:
    """Translates formulas into one graph; equal nodes are translated once.

    ``values`` has the value of every variable that occurs, by name.
    """

    def __init__(self, aig: Aig, values: Mapping[str, Value]) -> None:
        self._values = values
        self._words = BitWords(aig)
        self._range: dict[int, Interval] = {}
        self._done: dict[int, Value] = {}
        self._alive: list[Expr] = []

    def __call__(self, expr: Expr) -> Value:
        """The value of a formula."""
        for node in postorder(expr):
            if id(node) not in self._done:
                self._range[id(node)] = interval(node, self._range)
                self._done[id(node)] = self._node(node)
                self._alive.append(node)
        return self._done[id(expr)]

    def truth(self, expr: Expr) -> Literal:
        """The literal of a truth value."""
        return self(expr)[0]

    def inside(self, value: Value, domain: Domain) -> Literal:
        """Whether a value lies in a domain."""
        aig, words = self._words.aig, self._words
        if isinstance(domain.sort, Bool):
            return aig.any(value[0] ^ (v == 0) for v in domain.values)
        if not domain.dense:
            return aig.any(words.equal(value, words.const(v)) for v in domain.values)
        low, high = words.const(domain.low), words.const(domain.high)
        return aig.both(words.at_most(low, value), words.at_most(value, high))

    def _node(self, node: Expr) -> Value:
        match node:
            case Const(value, sort):
                return [TRUE if value else FALSE] if isinstance(sort, Bool) else self._words.const(value)
            case Var(name):
                return self._values[name]
            case Named(_, body):
                return self._done[id(body)]
            case Apply(op, args, sort):
                result = OPERATIONS[op](self._words, *(self._done[id(a)] for a in args))
                bits = self._range[id(node)].width
                return result if isinstance(sort, Bool) else self._words.fitted(result, bits)
        raise AssertionError(f"{node} speaks of the past")


OPERATIONS: Mapping[Op, Callable[..., Value]] = {
    Op.NOT: lambda words, a: BitWords.flipped(a),
    Op.AND: lambda words, *args: [words.aig.all(a[0] for a in args)],
    Op.OR: lambda words, *args: [words.aig.any(a[0] for a in args)],
    Op.ITE: lambda words, test, a, b: words.choose(test[0], a, b),
    Op.EQ: lambda words, a, b: [words.equal(a, b)],
    Op.NE: lambda words, a, b: [words.equal(a, b) ^ 1],
    Op.LE: lambda words, a, b: [words.at_most(a, b)],
    Op.GE: lambda words, a, b: [words.at_most(b, a)],
    Op.LT: lambda words, a, b: [words.at_most(b, a) ^ 1],
    Op.GT: lambda words, a, b: [words.at_most(a, b) ^ 1],
    Op.ADD: BitWords.add,
    Op.SUB: BitWords.subtract,
    Op.NEG: BitWords.negative,
    Op.MUL: BitWords.multiply,
    Op.SCALE: BitWords.multiply,
    Op.DIV: BitWords.divide,
    Op.MOD: BitWords.modulo,
    Op.ABS: BitWords.absolute,
    Op.MIN: BitWords.least,
    Op.MAX: BitWords.greatest,
    Op.BIT: BitWords.bit,
}
"""Every operator on the words of one graph."""
