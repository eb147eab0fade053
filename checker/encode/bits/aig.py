"""And-inverter graphs: every Boolean function as conjunctions of two possibly negated nodes.

A *literal* is twice the number of a node, plus one if negated, as in the AIGER format (Biere, 2007);
node 0 is false.  Equal conjunctions are one node (structural hashing), and constants are folded.
"""

from collections.abc import Iterable, Iterator, Sequence

FALSE, TRUE = 0, 1

Literal = int


class Aig:
    """A growing graph.

    ``fanins[n]`` are the two literals that node ``n`` conjoins; (0, 0) for inputs, which are in ``inputs``.
    Fanins have smaller numbers than the node, so that ascending order is topological.
    """

    def __init__(self) -> None:
        self.fanins: list[tuple[Literal, Literal]] = [(0, 0)]
        self.inputs: list[Literal] = []
        self._made: dict[tuple[Literal, Literal], Literal] = {}

    def __len__(self) -> int:
        """The number of nodes, that of false included."""
        return len(self.fanins)

    def is_input(self, node: int) -> bool:
        """Whether a node (not a literal) is an input."""
        return node > 0 and self.fanins[node] == (0, 0)

    def input(self) -> Literal:
        """A new free input."""
        self.fanins.append((0, 0))
        self.inputs.append(2 * len(self.fanins) - 2)
        return self.inputs[-1]

    def both(self, a: Literal, b: Literal) -> Literal:
        """The conjunction."""
        if a > b:
            a, b = b, a
        if a == FALSE or a == b ^ 1:
            return FALSE
        if a in (TRUE, b):
            return b
        key = a, b
        found = self._made.get(key)
        if found is None:
            self.fanins.append(key)
            found = self._made[key] = 2 * len(self.fanins) - 2
        return found

    def either(self, a: Literal, b: Literal) -> Literal:
        """The disjunction."""
        return self.both(a ^ 1, b ^ 1) ^ 1

    def differ(self, a: Literal, b: Literal) -> Literal:
        """Whether the two have different values."""
        if a < 2:
            return b ^ a
        if b < 2:
            return a ^ b
        return self.both(self.both(a, b) ^ 1, self.both(a ^ 1, b ^ 1) ^ 1)

    def mux(self, test: Literal, then: Literal, other: Literal) -> Literal:
        """``then`` where the test is true, ``other`` elsewhere."""
        if then == other:
            return then
        if test < 2:
            return then if test else other
        if then == other ^ 1:
            return self.differ(test, other)
        return self.both(self.both(test, then) ^ 1, self.both(test ^ 1, other) ^ 1) ^ 1

    def all(self, literals: Iterable[Literal]) -> Literal:
        """The conjunction of many, as a balanced tree."""
        level = sorted(set(literals))
        while len(level) > 1:
            pairs = [self.both(a, b) for a, b in zip(level[::2], level[1::2], strict=False)]
            level = pairs + level[len(level) & ~1 :]
        return level[0] if level else TRUE

    def any(self, literals: Iterable[Literal]) -> Literal:
        """The disjunction of many."""
        return self.all(a ^ 1 for a in literals) ^ 1

    def cone(self, roots: Iterable[Literal]) -> list[int]:
        """The nodes under some literals, inputs and roots included, in topological order."""
        seen: set[int] = set()
        todo = [root >> 1 for root in roots]
        while todo:
            node = todo.pop()
            if node not in seen:
                seen.add(node)
                a, b = self.fanins[node]
                todo += (a >> 1, b >> 1)
        seen.discard(0)
        return sorted(seen)

    def gates(self, roots: Iterable[Literal]) -> Iterator[tuple[int, Literal, Literal]]:
        """The conjunctions under some literals, each with the two that it conjoins, in topological order."""
        return ((node, *self.fanins[node]) for node in self.cone(roots) if not self.is_input(node))

    def evaluate(self, roots: Sequence[Literal], values: dict[int, int]) -> list[int]:
        """The roots as bit-parallel words: ``values`` has a word for each input node needed; words may
        be of any length, one bit for each of so many assignments, and negation is by -1."""
        word = dict(values)
        word[0] = 0
        for node in self.cone(roots):
            if node not in word:
                a, b = self.fanins[node]
                word[node] = (word[a >> 1] ^ -(a & 1)) & (word[b >> 1] ^ -(b & 1))
        return [word[r >> 1] ^ -(r & 1) for r in roots]


def bits_of(value: int, count: int) -> Iterator[int]:
    """The low bits of a number, least significant first."""
    return (value >> i & 1 for i in range(count))
