"""Numbers as lists of literals, least significant first, the last one being the sign (two's complement)."""

from collections.abc import Sequence

from checker.encode.bits.aig import FALSE, TRUE, Aig, Literal, bits_of
from checker.system.intervals import Interval

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
