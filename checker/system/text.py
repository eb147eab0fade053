"""What determines a transition system, as lines of text and as one short key."""

from collections.abc import Iterable
from hashlib import sha256

from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Domain, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.system import TransitionSystem


class SystemText:
    """Lines that determine what is added to it; formulas and domains are numbered and written once.

    Equal ones have one number, be they one object or several: how a system was made does not show.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.known: dict[int, tuple[int, object]] = {}
        """Number by ``id``; what is numbered is held, so that ids stay unique."""
        self._numbers: dict[tuple[object, ...], int] = {}
        """By what is written of it."""

    @property
    def digest(self) -> str:
        """SHA-256 of the lines, in hexadecimal."""
        return sha256("\n".join(self.lines).encode()).hexdigest()

    def system(self, system: TransitionSystem) -> None:
        """Add all that engines read of a system."""
        for name, variables in (("in", system.inputs), ("own", system.variables), ("frozen", system.frozen)):
            self.add(name, *map(self.expr, variables))
        self.add("temps", *map(self.expr, system.temps))
        self.add("assume", self.expr(system.assume))
        self.program(system.step)

    def add(self, *words: object) -> None:
        self.lines.append(" ".join(map(str, words)))

    def program(self, program: Iterable[object]) -> None:
        for statement in program:
            if isinstance(statement, Assign):
                self.add("assign", self.expr(statement.var), self.expr(statement.value))
            elif isinstance(statement, If):
                self.add("if", self.expr(statement.condition))
                self.program(statement.then)
                self.add("else")
                self.program(statement.otherwise)
                self.add("end")
            else:
                raise AssertionError(statement)

    def expr(self, expr: Expr) -> int:
        """The number of a formula."""
        known = self.known.get(id(expr))
        return known[0] if known else self._numbered(expr, self._words(expr))

    def _words(self, expr: Expr) -> tuple[object, ...]:
        match expr:
            case Const(value, sort):
                return ("const", value, self._plain(sort))
            case Var(name, domain, init):
                return ("var", repr(name), self._plain(domain), init)
            case Named(_, body):
                return ("named", self.expr(body))
            case Apply(op, args, sort):
                return (op.value, self._plain(sort), *map(self.expr, args))
        raise AssertionError(expr.__class__)

    def _plain(self, value: Domain | Sort) -> int:
        known = self.known.get(id(value))
        return known[0] if known else self._numbered(value, (repr(value),))

    def _numbered(self, value: object, words: tuple[object, ...]) -> int:
        number = self._numbers.get(words)
        if number is None:
            number = self._numbers[words] = len(self._numbers)
            self.add(number, *words)
        self.known[id(value)] = number, value
        return number
