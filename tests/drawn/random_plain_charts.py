"""Random charts of what Stateflow and charts in Python have both, and a little of what only Stateflow has."""

from pathlib import Path
from random import Random

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import Node, WrittenChart, WrittenState
from rovercheck.checker.simulink.writer.packages import WrittenModel

SCRIPT = """function y = turned(a, b)
if a > b
    y = uint8(a - b);
elseif b == 2
    y = uint8(0);
else
    y = uint8(7);
end
end
"""


def random_plain_model(seed: int, folder: Path) -> DrawnModel:
    """A chart with the inputs ``u`` (int8) and ``on``, and the outputs ``t``, ``n`` and ``held``."""
    model = WrittenModel("one", step="0.1")
    ins = {"u": "int8", "on": "boolean"}
    outs = {"t": "double", "n": "uint8", "held": "boolean"}
    ports = [model.root.inport(name, n, OutDataTypeStr=kind) for n, (name, kind) in enumerate(ins.items(), 1)]
    ends = [model.root.outport(name, n) for n, name in enumerate(outs, 1)]
    block, chart = model.root.chart("C")
    for name, kind in ins.items():
        chart.data(name, "input", kind)
    for name, kind in outs.items():
        chart.data(name, "output", kind)
    _Drawing(Random(seed), chart).draw()
    for number, port in enumerate(ports, 1):
        model.root.line(port, f"{block}/{number}")
    for number, port in enumerate(ends, 1):
        model.root.line(f"{block}/{number}", port)
    return read_model(model.save(folder / "one.slx"))


class _Drawing:
    def __init__(self, random: Random, chart: WrittenChart) -> None:
        self.random, self.chart, self.number = random, chart, 0
        self.leaves: list[WrittenState] = []
        self.names: list[str] = []
        self.below: dict[WrittenState | None, list[WrittenState]] = {None: []}
        self.regions: set[WrittenState | None] = set()

    def draw(self) -> None:
        """All of it."""
        self.chart.saturates = self.random.random() < 0.6
        if self.random.random() < 0.3:
            self.chart.parallel = True
            self.regions.add(None)
        self.chart.function("y = turned(a, b)", script=SCRIPT)
        self.chart.data("K", "constant", "int8", 2)
        self._level(None, 0)
        for holder in self.below:
            self._transitions(holder)

    def _level(self, holder: WrittenState | None, depth: int) -> None:
        chance = self.random.random
        self.below[holder] = []
        for order in range(1, 2 + self.random.randrange(3 if depth else 2) + (depth == 0)):
            name = f"S{len(self.names)}"
            self.names.append(name)
            parts = [name]
            parts += [f"{word}: {self._action()}" for word in ("en", "du", "ex") if chance() < 0.5]
            regions = depth < 2 and chance() < 0.2
            state = self.chart.state(
                "\n".join(parts), holder, order if holder in self.regions else 0, parallel=regions
            )
            self.below[holder].append(state)
            if regions:
                self.regions.add(state)
            if regions or (depth < 2 and chance() < 0.4):
                self._level(state, depth + 1)

    # --- transitions ---------------------------------------------------------------------------------------

    def _transitions(self, holder: WrittenState | None) -> None:
        states, chance = self.below[holder], self.random.random
        if holder in self.regions or not states:
            return
        if holder is not None and chance() < 0.3:
            self.chart.junction(holder, history=True)
        if chance() < 0.3:
            junction = self.chart.junction(holder)
            self.chart.transition(None, junction, self._label(times=False), 1, holder)
            self.chart.transition(junction, self.random.choice(states), self._label(times=False), 1, holder)
            self.chart.transition(None, self._inside(states), "", 2, holder)
        else:
            self.chart.transition(None, self._inside(states), "", 1, holder)
        for state in states:
            for order in range(1, 1 + self.random.randrange(1, 4)):
                self._way(state, self._end(states), holder, order)
        if holder is not None and chance() < 0.25:
            target = self.random.choice(states)
            self.chart.transition(holder, target, self._label(times=False), 1, holder, inner=True)

    def _way(self, source: WrittenState, end: Node, holder: WrittenState | None, order: int) -> None:
        if self.random.random() < 0.6:
            self.chart.transition(source, end, self._label(), order)
            return
        junction = self.chart.junction(holder)
        self.chart.transition(source, junction, self._label(), order)
        count = 1 + self.random.randrange(2) if self.random.random() < 0.9 else 0
        for number in range(1, 1 + count):
            self.chart.transition(junction, end, self._label(), number)

    def _end(self, states: list[WrittenState]) -> WrittenState:
        every = [one for some in self.below.values() for one in some]
        return self._inside(states) if self.random.random() < 0.8 else self.random.choice(every)

    def _inside(self, states: list[WrittenState]) -> WrittenState:
        one = self.random.choice(states)
        inner = self.below.get(one)
        if inner and one not in self.regions and self.random.random() < 0.4:
            return self.random.choice(inner)
        return one

    # --- texts ---------------------------------------------------------------------------------------------

    def _label(self, times: bool = True) -> str:
        parts = ""
        if self.random.random() < 0.8:
            parts += f"[{self._guard(times)}]"
        if self.random.random() < 0.3:
            parts += f"{{{self._action()}}}"
        if self.random.random() < 0.3:
            parts += f"/{{{self._action()}}}"
        return parts

    def _guard(self, times: bool) -> str:
        number = self.random.randrange(-2, 4)
        plain = [
            f"u == {number}", f"u > {number}", "on", "~on", "n > 3", "held && u ~= K", "turned(u, K) == 0",
            "double(u) + double(n) > 4", f"in({self.random.choice(self.names)})", "hasChanged(on)",
            "bitand(n, 4) ~= 0", "t > 40 || u < K", "turned(u, 1) > n",
        ]  # fmt: skip
        timed = [
            f"after({number + 4}, tick)", f"after({number + 3}00, msec)", "before(3, tick)", "at(2, tick)",
            "after(0.3, sec) && on", "duration(u > 0) > 0.2", "temporalCount(tick) >= 3",
            "elapsed(sec) > 0.25",
        ]  # fmt: skip
        return self.random.choice(plain + (timed if times else []))

    def _action(self) -> str:
        self.number += 1
        number = self.number
        return self.random.choice([
            f"t = mod(t * 3 + {number}, 97);", "n = n + 1;", "n = n - 3;", "held = u > 1;", "held = ~held;",
            f"if u > {number % 4}, n = uint8({number % 9}); else t = mod(t + 1, 97); end",
            "n = bitor(n, 8);", "n = bitand(n, 13);", "n = turned(u, 1);", "n = uint8(t / 2);", "n = n * 2;",
            f"t = {number % 90}; n = uint8(t);",
        ])  # fmt: skip


__all__ = ["random_plain_model"]
