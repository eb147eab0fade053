"""A reader of BTOR2 for what we write: it checks sorts and widths, and evaluates node by node."""

from dataclasses import dataclass, field

from tests.export.reading import Values, wrapped

ARITHMETIC = {"add", "sub", "mul", "sdiv", "smod", "and", "or"}
COMPARE = {"eq", "neq", "slt", "slte", "sgt", "sgte"}


@dataclass
class Model:
    """Lines by number, split into words; all values are signed words."""

    lines: dict[int, list[str]]
    comment: list[str]
    state: dict[int, int] = field(default_factory=dict)

    def _all(self, kind: str) -> list[tuple[int, list[str]]]:
        return [(n, words) for n, words in self.lines.items() if words[0] == kind]

    @property
    def bad(self) -> tuple[str, ...]:
        return tuple(words[2] for _, words in self._all("bad"))

    def bits(self, node: int) -> int:
        """The width of a node."""
        sort = self.lines[int(self.lines[node][1])]
        assert sort[:2] == ["sort", "bitvec"]
        return int(sort[2])

    def start(self, frozen: Values) -> None:
        self.state = {n: self._in(n, frozen[w[2]]) for n, w in self._all("state") if w[2] in frozen}
        for n, (_, sort, state, value) in self._all("init"):
            assert self.lines[int(state)][1] == sort and int(value) < int(state) < n
            self.state[int(state)] = self.value(int(value), {})
        assert self.state.keys() == dict(self._all("state")).keys()

    def _in(self, node: int, value: int) -> int:
        """A value that the node can hold; the truth value 1 is the signed word -1 of one bit."""
        held = wrapped(value, self.bits(node))
        assert held == value or (self.bits(node) == 1 and value == 1)
        return held

    def tick(self, inputs: Values) -> tuple[bool, dict[str, bool]]:
        at = dict(self.state)
        at |= {n: self._in(n, inputs[words[2]]) for n, words in self._all("input")}
        allowed = all([self.value(int(words[1]), at) for _, words in self._all("constraint")])
        bad = {words[2]: bool(self.value(int(words[1]), at)) for _, words in self._all("bad")}
        if allowed:
            self.state = {int(words[2]): self.value(int(words[3]), at) for _, words in self._all("next")}
        return allowed, bad

    def value(self, node: int, at: dict[int, int]) -> int:
        """The value of a node; nodes only refer to those before them."""
        if node not in at:
            op, _, *rest = self.lines[node]
            at[node] = wrapped(self._operate(node, op, [int(word) for word in rest], at), self.bits(node))
        return at[node]

    def _operate(self, node: int, op: str, args: list[int], at: dict[int, int]) -> int:
        if op == "constd":
            return self._in(node, args[0])
        assert args[0] < node
        a = self.value(args[0], at)
        match op:
            case "sext":
                assert self.bits(args[0]) + args[1] == self.bits(node)
                return a
            case "slice":
                assert self.bits(args[0]) > args[1] >= args[2] == args[1] - self.bits(node) + 1
                return a >> args[2]
            case "not":
                return ~a
            case "neg":
                return -a
            case "ite":
                assert self.bits(args[0]) == 1 and self.bits(args[1]) == self.bits(args[2]) == self.bits(node)
                return self.value(args[1], at) if a else self.value(args[2], at)
        b = self.value(args[1], at)
        assert (
            self.bits(args[0])
            == self.bits(args[1])
            == (self.bits(node) if op in ARITHMETIC else self.bits(args[0]))
        )
        return _binary(op, a, b)


def _binary(op: str, a: int, b: int) -> int:
    assert op in ARITHMETIC | COMPARE, op
    if op in COMPARE:
        tests = {"eq": a == b, "neq": a != b, "slt": a < b, "slte": a <= b, "sgt": a > b, "sgte": a >= b}
        return int(tests[op])
    if op in ("sdiv", "smod"):
        assert b > 0
        towards_zero = abs(a) // b * (-1 if a < 0 else 1)
        return towards_zero if op == "sdiv" else a % b
    return {"add": a + b, "sub": a - b, "mul": a * b, "and": a & b, "or": a | b}[op]


def read(data: bytes) -> Model:
    """The model of a file."""
    lines: dict[int, list[str]] = {}
    comment: list[str] = []
    for line in data.decode().splitlines():
        text, semicolon, said = line.partition(";")
        if text.strip():
            number, *words = text.split()
            assert int(number) == len(lines) + 1
            lines[int(number)] = words
        elif semicolon:
            comment.append(said.strip())
    return Model(lines, comment)
