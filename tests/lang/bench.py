"""A bench for small charts: states that note digits, and what happened in each tick."""

from collections.abc import Sequence

from rovercheck.spec_model.lang.action import Action, assign
from rovercheck.spec_model.lang.chart import Block, Component, Junction, State, Transition
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Var, flag, var
from rovercheck.spec_model.lang.interpret import FiredTransition, Interpreter
from rovercheck.spec_model.lang.system import in_order

log = var("log", integer(0, 10**9))
a, b, c = flag("a"), flag("b"), flag("c")
n = var("n", integer(0, 9))


def note(digit: int) -> Action:
    """Append a digit to the log: the order in which actions ran."""
    return assign(log, log * 10 + digit)


def state(
    name: str, entry: int = 0, during: int = 0, exit: int = 0, *, transitions: Sequence[Transition] = (),
    states: Sequence[State] = (), default: str | Transition | Sequence[Transition] | None = None,
    junctions: Sequence[Junction] = (), parallel: bool = False,
) -> State:  # fmt: skip
    """A state that notes a digit when it is entered, stays active and is left; 0 for nothing."""
    notes = [[note(digit)] if digit else [] for digit in (entry, during, exit)]
    return State(
        name, entry=notes[0], during=notes[1], exit=notes[2], transitions=transitions, states=states,
        default=default, junctions=junctions, parallel=parallel,
    )  # fmt: skip


class Bench:
    """Runs components and says what happened in each tick."""

    def __init__(self, *components: Component, frozen: Sequence[Var] = ()) -> None:
        clear = Block("Clear", [assign(log, 0)])
        self.interpreter = Interpreter(in_order("Bench", clear, *components, frozen=frozen))
        self.fired: tuple[FiredTransition, ...] = ()

    def tick(self, *true: Var, **values: int) -> str:
        """One tick with the flags named true; returns the digits noted in it."""
        inputs = dict.fromkeys(self.interpreter.system.inputs, 0) | {v.name: 1 for v in true} | values
        self.fired = self.interpreter.step(inputs)
        return str(self.interpreter.data["log"]).strip("0")

    def at(self, place: str = "C") -> str:
        """The active state of a chart or of a composite."""
        charts = self.interpreter.system.charts
        location = next(v for chart in charts for v in chart.locations if v.name == place)
        return location.domain.show(self[place])

    def __getitem__(self, name: str) -> int:
        return self.interpreter.valuation()[name]
