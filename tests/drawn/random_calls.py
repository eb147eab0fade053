"""Random models in which a chart calls subsystems, charts and Simulink functions."""

from pathlib import Path
from random import Random

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import (
    WrittenChart,
    WrittenData,
    WrittenState,
    WrittenTransition,
)
from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.random_charts import RandomChart
from tests.drawn.random_texts import INPUTS, MEMBERS
from tests.drawn.test_function_calls import CALL, IN, summing
from tests.drawn.test_simulink_functions import counting

ACTIONS = (
    "F;", "send(F);", "G; F;", "H;", "log = log + uint32(back);", "back2 = sum1(int8(3)) + back;",
    "back2 = sum1(back); G;", "back2 = sum1(sum1(int8(1))) - sum1(int8(2));",
)  # fmt: skip
GUARDS = ("[sum1(int8(1)) > 5]", "[back > 2]", "[back2 < 10]", "[in_d == 2]")
CALLED = (
    "o = o + 1;", "o = o + i;", "o = -o;", "if i > 1, K; end", "K; o = o + seen;", "o = seen - i;", "K; K;",
)  # fmt: skip


class RandomCalls:
    """One such model."""

    def __init__(self, seed: int) -> None:
        self.random, self.model = Random(seed), WrittenModel("one", step="0.1")
        self.root = self.model.root
        self.ends = 0

    def out(self, source: str) -> None:
        """An output of the model."""
        self.ends += 1
        self.root.line(source, self.root.outport(f"out{self.ends}", self.ends))

    def drawn(self) -> WrittenModel:
        """Everything: a chart with random states, what it calls, and the signals between."""
        ports = {n: self.root.inport(n, k, OutDataTypeStr=t) for k, (n, t) in enumerate(INPUTS.items(), 1)}
        block, chart = self.root.chart("C")
        chart.parallel, chart.saturates = self.random.random() < 0.4, self.random.random() < 0.6
        RandomChart(chart, self.random, [], small=True).draw()
        for name in ("back", "in_d"):
            chart.data(name, "input", "int8")
        chart.data("back2", "output", "int8")
        counting(self.root.simulink_function(chart, "y = sum1(a)"))
        outputs = [one.name for one in self._data(chart, "OUTPUT_DATA")]
        for name in "FGH":
            chart.event(name, "OUTPUT_EVENT", CALL)
        self._call_in(chart)
        sub, other = summing(self.root, "X"), self._called_chart()
        events = {name: f"{block}/{len(outputs) + n}" for n, name in enumerate("FGH", 1)}
        mux = self.root.block("Mux", "both", {"in": 2, "out": 1}, {}, Inputs="2")
        for source, target in (
            *((port, f"{block}/{n}") for n, port in enumerate(ports.values(), 1)),
            (events["F"], f"{sub}#trigger"), (events["G"], f"{mux}/1"), (events["H"], f"{mux}/2"),
            (mux, f"{other}#trigger"), (sub, f"{block}/{len(ports) + 1}"),
            (other, f"{block}/{len(ports) + 2}"),
            (f"{block}/{outputs.index('back2') + 1}", sub), (ports["u"], f"{other}/1"),
        ):  # fmt: skip
            self.root.line(source, target)
        for number in range(1, len(outputs) + 1):
            self.out(f"{block}/{number}")
        self.out(sub)
        self.out(other)
        return self.model

    @staticmethod
    def _data(chart: WrittenChart, scope: str) -> list[WrittenData]:
        return [one for one in chart.of(WrittenData) if one.scope == scope]

    def _call_in(self, chart: WrittenChart) -> None:
        """Calls in some states and transitions of a chart."""
        waiting = list(chart.children)
        while waiting:
            one = waiting.pop()
            if isinstance(one, WrittenState) and one.type != "FUNC_STATE":
                waiting += one.children
                for section in ("en", "du", "ex"):
                    if self.random.random() < 0.3:
                        one.label += f"\n{section}: {self.random.choice(ACTIONS)}"
            elif isinstance(one, WrittenTransition) and not one.label and one.source is not None:
                one.label = self.random.choice((*GUARDS, f"{{{self.random.choice(ACTIONS)}}}"))

    def _called_chart(self) -> str:
        """A chart that two function calls wake up, and that calls a subsystem itself."""
        block, chart = self.root.chart("D")
        for name, scope in (("i", "input"), ("seen", "input"), ("o", "output")):
            chart.data(name, scope, "int8")
        for name in "PQ":
            chart.event(name, IN, CALL)
        chart.event("K", "OUTPUT_EVENT", CALL)
        states = [chart.state(self._called_label(name)) for name in "ABC"]
        chart.transition(None, states[0])
        for one in states:
            for order in (1, 2):
                label = self.random.choice(("P", "Q", "[i > 0]", "after(2, tick)", "Q[o > 3]", "after(2, P)"))
                chart.transition(one, self.random.choice(states), label, order)
        sub = summing(self.root, "Y")
        for source, target in ((f"{block}/2", f"{sub}#trigger"), (block, sub), (sub, f"{block}/2")):
            self.root.line(source, target)
        return block

    def _called_label(self, name: str) -> str:
        lines = [name]
        for section in ("en", "du", "ex", "on P", "on Q"):
            if self.random.random() < 0.5:
                lines.append(f"{section}: {self.random.choice(CALLED)}")
        return "\n".join(lines)


def random_calls(seed: int, folder: Path) -> DrawnModel:
    """The model of a seed, written as a package and read again."""
    gears = {name: number for number, name in enumerate(MEMBERS)}
    beside = dictionary(folder / "types.sldd", enumerations={"Gear": gears})
    return read_model(RandomCalls(seed).drawn().save(folder / "one.slx"), [beside])


__all__ = ["random_calls"]
