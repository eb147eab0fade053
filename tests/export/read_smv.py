"""A reader of the part of SMV that we write: a parser by recursive descent, and an evaluator."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field

from tests.export.reading import Values

TOKEN = re.compile(r"\s*(\d+|[A-Za-z_][A-Za-z0-9_]*|<->|<=|>=|!=|:=|\.\.|[-+*/&|=<>!?:;(){},])")
Formula = Callable[[dict[str, int]], int]
LEVELS = (
    ("?",),
    ("<->",),
    ("|",),
    ("&",),
    ("=", "!=", "<", "<=", ">", ">="),
    ("mod",),
    ("+", "-"),
    ("*", "/"),
)
"""Binary operators from the loosest to the tightest, as in the manual of nuXmv."""


@dataclass
class Module:
    """Declarations and formulas of ``main``."""

    domains: dict[str, set[int]] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    defined: dict[str, Formula] = field(default_factory=dict)
    init: dict[str, int] = field(default_factory=dict)
    invariants: list[Formula] = field(default_factory=list)
    next: dict[str, Formula] = field(default_factory=dict)
    specs: dict[str, Formula] = field(default_factory=dict)
    comment: list[str] = field(default_factory=list)
    state: dict[str, int] = field(default_factory=dict)

    @property
    def bad(self) -> tuple[str, ...]:
        return tuple(self.specs)

    def start(self, frozen: Values) -> None:
        own = {name: frozen[name] for name, kind in self.kinds.items() if kind == "FROZENVAR"}
        self.state = {**own, **self.init}

    def tick(self, inputs: Values) -> tuple[bool, dict[str, bool]]:
        free = {n: inputs[n] for n in self.domains if n not in self.state}
        assert self.next.keys() | {n for n, k in self.kinds.items() if k == "FROZENVAR"} == self.state.keys()
        at = {**self.state, **free}
        assert all(at[n] in domain for n, domain in self.domains.items() if n in self.state)
        if not all(at[n] in domain for n, domain in self.domains.items()):
            return False, {}
        bad = {name: not spec(dict(at)) for name, spec in self.specs.items()}
        allowed = all(invariant(dict(at)) for invariant in self.invariants)
        if allowed:
            self.state |= {name: formula(dict(at)) for name, formula in self.next.items()}
        return allowed, bad


class _Parser:
    def __init__(self, text: str, defined: dict[str, Formula]) -> None:
        self.tokens = TOKEN.findall(text)
        assert "".join(self.tokens) == re.sub(r"\s", "", text), text
        self.defined = defined

    def take(self, *expected: str) -> str:
        token = str(self.tokens.pop(0))
        assert not expected or token in expected, (token, expected)
        return token

    def formula(self, level: int = 0) -> Formula:
        if level == len(LEVELS):
            return self.unary()
        left = self.formula(level + 1)
        while self.tokens and self.tokens[0] in LEVELS[level]:
            op = self.take()
            if op == "?":
                then = self.formula()
                self.take(":")
                return _choice(left, then, self.formula())
            left = _binary(op, left, self.formula(level + 1))
        return left

    def unary(self) -> Formula:
        token = self.take()
        if token == "!":
            inner = self.unary()
            return lambda at: int(not inner(at))
        if token == "-":
            inner = self.unary()
            return lambda at: -inner(at)
        if token == "(":
            inner = self.formula()
            self.take(")")
            return inner
        if token in ("TRUE", "FALSE") or token.isdigit():
            value = int(token) if token.isdigit() else int(token == "TRUE")
            return lambda at: value
        return lambda at: self.lookup(token, at)

    def lookup(self, name: str, at: dict[str, int]) -> int:
        if name not in at:
            at[name] = self.defined[name](at)
        return at[name]


def _choice(test: Formula, then: Formula, other: Formula) -> Formula:
    return lambda at: then(at) if test(at) else other(at)


def _binary(op: str, left: Formula, right: Formula) -> Formula:
    def value(at: dict[str, int]) -> int:
        a, b = left(at), right(at)
        if op in ("/", "mod"):
            assert a >= 0 < b, "tools differ in how they round"
        meanings: dict[str, Callable[[], int]] = {
            "<->": lambda: a == b, "|": lambda: a | b, "&": lambda: a & b, "=": lambda: a == b,
            "!=": lambda: a != b, "<": lambda: a < b, "<=": lambda: a <= b, ">": lambda: a > b,
            ">=": lambda: a >= b, "mod": lambda: a % b, "+": lambda: a + b, "-": lambda: a - b,
            "*": lambda: a * b, "/": lambda: a // b,
        }  # fmt: skip
        return int(meanings[op]())

    return value


def read(data: bytes) -> Module:
    """The module of a file."""
    made, section = Module(), ""
    for line in data.decode().splitlines():
        text, _, said = line.partition("--")
        word = text.split(" ", 1)[0].strip()
        if not text.strip():
            made.comment.append(said.strip())
        elif word in ("MODULE", "VAR", "FROZENVAR", "DEFINE"):
            section = word
        elif word in ("INIT", "INVAR", "TRANS", "INVARSPEC"):
            _condition(made, word, text.strip().removeprefix(word).removesuffix(";").strip())
        elif section == "DEFINE":
            name, _, formula = text.strip().removesuffix(";").partition(" := ")
            assert name not in made.defined.keys() | made.domains.keys()
            made.defined[name] = _parsed(formula, made)
        else:
            name, _, kind = text.strip().removesuffix(";").partition(" : ")
            assert name not in made.domains
            made.domains[name], made.kinds[name] = _domain(kind), section
    return made


def _parsed(text: str, made: Module) -> Formula:
    parser = _Parser(text, made.defined)
    formula = parser.formula()
    assert not parser.tokens, text
    return formula


def _condition(made: Module, word: str, text: str) -> None:
    if word == "INIT":
        name, _, value = text.partition(" = ")
        made.init[name.removeprefix("!")] = int(value) if value else int(not name.startswith("!"))
    elif word == "TRANS":
        found = re.fullmatch(r"next\((\w+)\) (?:=|<->) (.*)", text)
        assert found, text
        made.next[found[1]] = _parsed(found[2], made)
    elif word == "INVAR":
        made.invariants.append(_parsed(text, made))
    else:
        made.specs[text.removeprefix("!")] = _parsed(text, made)


def _domain(kind: str) -> set[int]:
    if kind == "boolean":
        return {0, 1}
    if kind.startswith("{"):
        return {int(value) for value in kind.strip("{}").split(",")}
    low, high = kind.split("..")
    return set(range(int(low), int(high) + 1))
