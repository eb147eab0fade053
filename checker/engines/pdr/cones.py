"""A SAT solver that holds only those parts of a machine that it was asked about.

A solver assigns every variable it has before it answers "satisfiable", so that a question about a few
latches is answered a hundred times faster if the cones of the others are not there.
"""

from collections.abc import Iterable, Sequence

from pysat.solvers import Minisat22

from rovercheck.checker.engines.pdr.machine import PdrMachine

GARBAGE = 3000
"""Temporary clauses after which a solver is better built anew."""
SMALL = 3000
GROWTH = 3
"""A solver with more variables, and with so many times those of its first question, is too large."""


class Cones:
    """An incremental solver with its own numbers for the variables of a machine.

    ``inside``: states are within their domains.
    """

    def __init__(self, machine: PdrMachine, *, inside: bool) -> None:
        self._machine = machine
        self._inside = inside
        self._solver = Minisat22()
        self._numbers = [0] * (machine.variables + 1)
        self.variables = 0
        """How many variables the solver has."""
        self._latches: list[tuple[int, int]] = []
        self._inputs: list[tuple[int, int]] = []
        self._temporary = 0
        self._first = 0

    def fresh(self) -> int:
        """A variable that stands for nothing of the machine."""
        self.variables += 1
        return self.variables

    def retire(self, condition: int) -> None:
        """Clauses that hold under a fresh variable (0: none) are not needed any more."""
        if condition:
            self._solver.add_clause([-condition])
            self._temporary += 1

    @property
    def bloated(self) -> bool:
        """Whether most of the solver is of no use to a question about few latches."""
        cones = self.variables - self._temporary
        return self._temporary >= GARBAGE or cones > max(SMALL, GROWTH * (self._first or cones))

    def literal(self, literal: int) -> int:
        """The solver's number for a literal of the machine, whose cone it holds from now on."""
        number = self._numbers[abs(literal)] or self._load(abs(literal))
        return number if literal > 0 else -number

    def literals(self, literals: Iterable[int]) -> list[int]:
        """The solver's numbers for some literals."""
        numbers = self._numbers
        return [
            (numbers[x] or self._load(x)) if x > 0 else -(numbers[-x] or self._load(-x)) for x in literals
        ]

    def add(self, clause: Sequence[int]) -> None:
        """A clause in the solver's numbers."""
        self._solver.add_clause(clause)

    def solve(self, assumptions: Sequence[int]) -> bool:
        """Whether the clauses can be satisfied under some literals in the solver's numbers."""
        self._first = self._first or self.variables
        return bool(self._solver.solve(assumptions))

    def core(self) -> frozenset[int]:
        """Assumptions of the last question that cannot be satisfied together."""
        return frozenset(self._solver.get_core() or ())

    def model(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The literals of the latches and of the inputs that the solver has, as last satisfied."""
        values = self._solver.get_model()
        latches = tuple(x if values[n - 1] > 0 else -x for x, n in self._latches)
        return latches, tuple(x if values[n - 1] > 0 else -x for x, n in self._inputs)

    def _load(self, variable: int) -> int:
        """Number a variable and everything it depends on, and add the clauses."""
        numbers, definitions = self._numbers, self._machine.definitions
        todo, loaded, facts = [variable], list[int](), dict[int, None]()
        while todo:
            one = todo.pop()
            if not numbers[one]:
                numbers[one] = self.fresh()
                loaded.append(one)
                found = self._facts(one)
                facts.update(dict.fromkeys(found))
                todo += map(abs, found)
                todo += (abs(x) for clause in definitions.get(one, ()) for x in clause)
        for one in loaded:
            for clause in definitions.get(one, ()):
                self._solver.add_clause(self.literals(clause))
        for fact in facts:
            self._solver.add_clause([self.literal(fact)])
        return numbers[variable]

    def _facts(self, variable: int) -> tuple[int, ...]:
        """Note a latch or an input; what is known of it."""
        machine = self._machine
        if variable > machine.latches:
            if variable < machine.true:
                self._inputs.append((variable, self._numbers[variable]))
            return ()
        self._latches.append((variable, self._numbers[variable]))
        return machine.domains.get(variable, ()) if self._inside else ()
