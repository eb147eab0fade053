"""Charts whose step is a program already: what an imported chart shows, and what it does.

Stateflow has constructs that the charts written here do not: inner transitions, history, events that are
sent to a whole chart, functions with memory.  A chart that is read from a file is lowered as a whole where
it is read; its states are those that a person sees.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from rovercheck.spec_model.lang.action import Action, Assign, If, reads, writes
from rovercheck.spec_model.lang.chart import Block, Chart, Path, State
from rovercheck.spec_model.lang.domain import Domain, Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.figure import ChartFigure
from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import Program
from rovercheck.spec_model.lang.transition import Junction, Transition


@dataclass(frozen=True)
class StepProgram:
    """What a chart does in a step.

    ``temporaries`` are written before they are read in every step.  ``fired`` says which path was taken where
    its marker, a variable that nothing reads, is assigned; ``tested`` in the same way which transition with
    a condition was tested, and whether that held, ``rivals`` which two were valid together, so that their
    order decided, and ``overflows`` which integer did not fit its type.  ``starting`` are raw values that
    variables have before the first step, of a chart that is entered when it is initialized.  ``elsewhere``
    are the active states of other charts, which the step executes as it calls them.
    """

    statements: Program
    temporaries: tuple[Var, ...] = ()
    starting: Mapping[str, int] = field(default_factory=dict)
    fired: Mapping[str, FiredTransition] = field(default_factory=dict)
    tested: Mapping[str, tuple[str, bool]] = field(default_factory=dict)
    rivals: Mapping[str, str] = field(default_factory=dict)
    overflows: Mapping[str, str] = field(default_factory=dict)
    elsewhere: tuple[Var, ...] = ()

    @cached_property
    def unmarked(self) -> Program:
        """The statements without the markers, which nothing reads."""
        return without(self.statements, self.markers)

    @cached_property
    def markers(self) -> frozenset[str]:
        """The variables that are only assigned to tell something."""
        return frozenset((*self.fired, *self.tested, *self.rivals, *self.overflows))


FAULT = Domain(Num(), (0,))
"""The domain of what is assigned 1 in a step that has no meaning; its ``doc`` says why."""


def is_fault(var: Var) -> bool:
    """Whether an assignment to a variable only says that a step has no meaning."""
    return var.domain is FAULT or (var.hidden and bool(var.doc) and var.domain == FAULT)


class ProgrammedChart(Chart):
    """A chart with the program of its step.  Its labels are texts, as the file has them.

    ``final`` are the states in which it is meant to stay; with ``waits`` time passes only in steps without
    an event.
    """

    def __init__(
        self,
        name: str,
        states: Sequence[State],
        program: StepProgram,
        *,
        default: Sequence[Transition] = (),
        junctions: Sequence[Junction] = (),
        parallel: bool = False,
        inner: Mapping[Path, Sequence[Transition]] | None = None,
        figure: ChartFigure | None = None,
        text: str = "",
        place: Place | None = None,
        final: Collection[Path] = (),
        waits: bool = False,
    ) -> None:
        self.name, self.text, self.local_to, self.data, self.label_faults = name, text, (), (), ()
        self.root = State(
            name, states=states, junctions=junctions, default=default, parallel=parallel, place=place
        )  # fmt: skip
        self.program, self._inner, self._figure = program, inner or {}, figure
        self.final, self.waits = tuple(final), waits

    _written = (*Chart._written, "program", "_inner", "_figure", "final", "waits")

    @property
    def figure(self) -> ChartFigure | None:
        """Where things stand in its drawing."""
        return self._figure

    @property
    def inner(self) -> Mapping[Path, Sequence[Transition]]:
        """Transitions that are drawn inside the state that they leave."""
        return self._inner

    def with_program(self, program: StepProgram) -> "ProgrammedChart":
        """The chart with another program, as one that also notes what it does."""
        root = self.root
        return ProgrammedChart(
            self.name, root.states, program, default=root.default, junctions=root.junctions,
            parallel=root.parallel, inner=self._inner, figure=self._figure, text=self.text, place=root.place,
            final=self.final, waits=self.waits,
        )  # fmt: skip

    def with_root(self, root: State) -> Chart:
        """Raises ``ModelError``: what such a chart does is not said by its states."""
        raise ModelError(f"{self.name} was imported, and is changed in its file.")

    def with_local_data(self, local_to: Sequence[tuple[Var, Sequence[str]]]) -> Chart:
        """Raises ``ModelError``: the same."""
        raise ModelError(f"{self.name} was imported, and is changed in its file.")

    @cached_property
    def entered(self) -> Var:
        """True once the chart has had its first execution."""
        own = super().entered
        return replace(own, hidden=True, init=self.program.starting.get(own.name, own.init))

    def location(self, path: Path = ()) -> Var:
        """The variable that says which state of an exclusive composite is active."""
        own = super().location(path)
        init = self.program.starting.get(own.name, own.init)
        return own if init == own.init else replace(own, init=init)

    @cached_property
    def _own(self) -> frozenset[str]:
        """The names of its temporaries, its markers and active states, those of charts that it calls too."""
        places = {place.name for place in (*self.locations, self.entered, *self.program.elsewhere)}
        return frozenset({v.name for v in self.program.temporaries} | places | self.program.markers)

    @cached_property
    def written(self) -> dict[str, Var]:
        """Data that its step writes, by name; active states and temporaries not included."""
        found = writes(self.program.statements)
        return {name: var for name, var in found.items() if name not in self._own}

    @cached_property
    def read(self) -> dict[str, Var]:
        """Data that its step reads, by name."""
        return {name: var for name, var in reads(self.program.statements).items() if name not in self._own}

    @cached_property
    def all_actions(self) -> tuple[Action, ...]:
        """The statements of its step."""
        return self.program.unmarked

    @property
    def guards(self) -> list[Expr]:
        """None: conditions are in the program."""
        return []

    def active_path(self, path: Path) -> Expr:
        """The condition that the state at ``path`` is active; for the chart itself, that it was entered."""
        return super().active_path(path) if path else self.entered == "yes"


class ProgrammedBlock(Block):
    """A function block that tells, too, which integer did not fit its type.

    ``marked`` are its statements with the markers of ``overflows``, as in a ``StepProgram``.
    """

    def __init__(
        self,
        name: str,
        marked: Program,
        overflows: Mapping[str, str],
        *,
        text: str = "",
        temporaries: Sequence[Var] = (),
        place: Place | None = None,
    ) -> None:
        do = without(marked, overflows.keys())
        super().__init__(name, do, text=text, temporaries=temporaries, place=place)
        self.marked, self.overflows = marked, overflows

    def with_marked(self, marked: Program) -> "ProgrammedBlock":
        """The block with other statements, as those that also note what it does."""
        return ProgrammedBlock(
            self.name, marked, self.overflows, text=self.text, temporaries=self.temporaries, place=self.place
        )


def without(statements: Program, names: Collection[str]) -> Program:
    """The statements without assignments to some variables."""
    made: list[Assign | If] = []
    for one in statements:
        if isinstance(one, If):
            then, otherwise = (
                without(tuple(a for a in part if isinstance(a, Assign | If)), names)
                for part in (one.then, one.otherwise)
            )
            if then or otherwise:
                made.append(If(one.condition, then, otherwise))
        elif one.var.name not in names:
            made.append(one)
    return tuple(made)


__all__ = ["FAULT", "ProgrammedChart", "StepProgram", "is_fault", "without"]
