"""The Promela language of SPIN: a loop that chooses inputs, runs the step as written, and asserts.

Gerard J. Holzmann: The SPIN Model Checker, 2003.  Search with ``-DSAFETY``; with ``-DBFS`` the first
violation is a shortest one.
"""

from collections.abc import Iterator, Sequence

from rovercheck.checker.export.flow import ExportFlow, ExportReach
from rovercheck.checker.export.machine import meaning
from rovercheck.checker.export.names import identifiers, one_line
from rovercheck.checker.export.problem import Problem
from rovercheck.checker.export.statements import Text
from rovercheck.checker.results.format import Format
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

FORMAT = Format("promela", "problem", ".pml", "Promela: statements, for SPIN")

LISTED = 64
"""Domains of at most this many values are chosen from a list, others by counting."""

_WORDS = """
active assert atomic bit bool break byte chan c_code c_decl c_expr c_state c_track d_proctype d_step do else
empty enabled eval false fi full get_priority goto hidden if init inline int len local ltl mtype nempty never
nfull notrace np_ od of pc_value pid printf printm priority proctype provided return run select set_priority
short show skip STDIN timeout trace true typedef unless unsigned xr xs
auto case char const continue default double enum extern float for long register restrict signed sizeof static
struct switch union void volatile while
linux unix cas final max min mix maxseq0 minseq0 now pptr rand rot rover this uchar uint ulong ushort wasnew
"""
KEYWORDS = frozenset(_WORDS.split())
"""Words that a model cannot use as names: of the language, of C and its macros, of what SPIN writes."""


def export(problem: Problem) -> str:
    """The problem as a process; between two ticks the variables of the state hold it, everything else being
    0.

    Inputs that are not admissible change nothing.  Raises ``ModelError`` for numbers that need more than 32
    bits.
    """
    goals = [b.var for b in problem.bad]
    system = sliced(problem.system, goals)
    return "".join(f"{line}\n" for line in _Process(problem, system, goals).lines())


class _Process:
    """The parts of the file."""

    def __init__(self, problem: Problem, system: TransitionSystem, goals: Sequence[Var]) -> None:
        self._header, self._system, self._goals = problem.header, system, goals
        lasting = {v.name for v in system.variables}
        self._passing = [v for v in system.temps if v.name not in lasting]
        self._variables = [*system.frozen, *system.variables, *system.inputs, *self._passing]
        own = [v.name for v in self._variables]
        self._names = identifiers(own, KEYWORDS | {n for n in own if n.isupper()})
        self._reach = ExportReach(system)
        self._text = Text(self._names, self._reach)

    def lines(self) -> Iterator[str]:
        """Every line of the file."""
        body = [*self._tick()]
        yield from (f"/* {line.replace('*/', '* /')} */" for line in self._header)
        yield from self._declarations()
        yield from (f"int {name};" for name in self._text.scratch)
        yield from ("", "active proctype rover()", "{")
        if self._system.frozen:
            yield "    atomic {"
            yield from (f"        {line}" for v in self._system.frozen for line in self._choice(v))
            yield "    }"
        yield from ("    do", "    :: atomic {")
        yield from (f"        {line}" for v in self._system.inputs for line in self._choice(v))
        yield "        d_step {"
        yield from (f"            {line}" for line in body)
        yield from ("        }", "    }", "    od", "}")

    def _declarations(self) -> Iterator[str]:
        groups = (
            ("frozen", self._system.frozen),
            ("state", self._system.variables),
            ("inputs", self._system.inputs),
            ("within a tick", self._passing),
        )
        for title, variables in groups:
            if variables:
                yield from ("", f"/* {title} */")
            lasting = title == "state"
            yield from (self._declaration(v, v.init if lasting else 0) for v in variables)

    def _declaration(self, var: Var, init: int) -> str:
        name = self._names[var.name]
        said = [*([var.name] if var.name != name else []), *([meaning(var)] if meaning(var) else [])]
        comment = f" /* {one_line(': '.join(said)).replace('*/', '* /')} */" if said else ""
        return f"{self._reach.type(var)} {name}{f' = {init}' if init else ''};{comment}"

    # --- the tick ----------------------------------------------------------------------------------

    def _choice(self, var: Var) -> Iterator[str]:
        """Statements that give a variable any value of its domain."""
        name, domain = self._names[var.name], var.domain
        if len(domain) <= LISTED or not domain.dense:
            yield f"if {' '.join(f':: {name} = {value}' for value in domain.values)} fi;"
        else:
            yield f"{name} = {domain.low}; do :: {name} < {domain.high} -> {name}++ :: break od;"

    def _tick(self) -> Iterator[str]:
        flow = self._reach.start()
        before, admissible = self._text.value(self._system.assume, flow)
        yield from before
        yield from ("if", f":: {admissible} ->")
        yield from (f"    {line}" for line in self._text.program(self._system.step, flow))
        yield from (f"    assert(!{self._names[goal.name]});" for goal in self._goals)
        yield from (f"    assert({condition});" for condition in self._domains(flow))
        yield from (":: else", "fi;")
        for name in (
            *(self._names[v.name] for v in (*self._system.inputs, *self._passing)),
            *self._text.scratch,
        ):
            yield f"{name} = 0;"

    def _domains(self, flow: ExportFlow) -> Iterator[str]:
        """What must hold after a tick for variables that the text does not show to be in their domains."""
        for var in self._system.variables:
            name, domain = self._names[var.name], var.domain
            if isinstance(domain.sort, Bool) and len(domain) == 2:
                continue
            if not domain.dense:
                yield " || ".join(f"{name} == {value}" for value in domain.values)
            elif not flow.within(var):
                yield f"{domain.low} <= {name} && {name} <= {domain.high}"
