"""Random models of Simulink: a chart with everything that Stateflow knows, and blocks around it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import (
    Node,
    WrittenChart,
    WrittenData,
    WrittenJunction,
    WrittenState,
)
from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.random_texts import EVENTS, INPUTS, MEMBERS, WHOLE, Language, Texts

PAIR = """function [p, q] = pair(v, w)
persistent last
if isempty(last)
    last = int16(1);
end
held = zeros(1, 3);
place = 1;
while place <= 3
    if double(v) > 20 * place
        held(place) = double(w);
        place = place + 1;
        continue
    end
    held(place) = place;
    if w == 3
        break
    end
    place = place + 1;
end
switch place
    case {1, 2}
        last = int16(sum(held));
    case 3
        last = last + 1;
    otherwise
        last = min(last * 2, 100);
end
p = last;
if held(2) > 2
    q = int8(helped(held));
    return
end
q = int8(place);
end
function r = helped(values)
r = 0;
for one = values
    if one < 0
        continue
    end
    r = r + one;
end
end
"""
OUTPUTS = ("log", "a", "b", "flag", "y")


@dataclass(eq=False)
class _Level:
    """A state being made, or the chart, with the states in it."""

    state: WrittenState | None
    parallel: bool
    name: str = ""
    inside: "list[_Level]" = field(default_factory=list)

    def every(self) -> "list[_Level]":
        return [self, *(below for one in self.inside for below in one.every())]


class RandomChart:
    """Draws into one chart."""

    def __init__(
        self, chart: WrittenChart, random: Random, input_events: Sequence[str], small: bool = False
    ) -> None:
        self.chart, self.random = chart, random
        kinds = {name: random.choice(WHOLE) for name in ("a", "b", "g", "h")}
        self.texts = Texts(random, chart.language, kinds, input_events=list(input_events))
        self.texts.members, self.texts.array = random.random() < 0.4, random.random() < 0.4
        self.names, self.loops = 0, 1
        self.most = random.choice((1, 2, 3, 4) if small else (3, 5, 5, 8))
        self.texts.sends = 1 if small else 2

    def draw(self) -> None:
        """Everything: data, states, functions, transitions."""
        chart, texts = self.chart, self.texts
        for name in INPUTS:
            chart.data(name, "input")
        outputs = {"log": "uint32", "flag": "boolean", "y": "double"} | texts.kinds
        for name in OUTPUTS:
            chart.data(name, "output", outputs[name], self._initial())
        for name in ("g", "h"):
            chart.data(name, "local", texts.kinds[name], self._initial())
        for event in EVENTS:
            chart.event(event)
            chart.data(f"seen_{event}", "local", "uint8", 7)
        if texts.members:
            chart.data("mode", "local", "Enum: Gear")
        if texts.array:
            chart.data("list", "local", self.random.choice(WHOLE), self._initial(), "3")
        if not texts.c:
            chart.data("n", "local", "double")
        self._functions()
        root = _Level(None, chart.parallel)
        self._inside(root, 0)
        states = [one for one in root.every() if one.state is not None]
        texts.states = [one.name for one in states]
        for number, one in enumerate(states):
            if number < 3:
                more = {"outputState": one.state.ssid if one.state else 0}
                chart.data(f"is_{one.name}", "output", "boolean", more=more)
        for level in root.every():
            if level.state is not None:
                self._label(level, level.state)
        for level in root.every():
            self._level(level)

    def _initial(self) -> object:
        return self.random.choice([None, None, 1, 3])

    # --- states --------------------------------------------------------------------------------------------

    def _inside(self, level: _Level, depth: int) -> None:
        count = self.random.randint(2, 3)
        for order in range(1, count + 1):
            self.names += 1
            name = f"S{self.names}"
            parallel = self.random.random() < 0.3
            made = self.chart.state(name, level.state, order if level.parallel else 0, parallel=parallel)
            below = _Level(made, parallel, name)
            level.inside.append(below)
            if depth < 2 and self.names < self.most and self.random.random() < 0.45 - 0.15 * depth:
                self._inside(below, depth + 1)
            else:
                made.parallel = below.parallel = False

    def _label(self, level: _Level, state: WrittenState) -> None:
        texts, lines = self.texts, [level.name]
        for section in ("en", "du", "ex", "en, du"):
            if self.random.random() < (0.1 if "," in section else 0.4):
                lines.append(f"{section}: {texts.actions()}")
        if self.random.random() < 0.25:
            lines.append(f"on {texts.event().partition(' |')[0]}: {texts.actions()}")
        state.label = "\n".join(lines)

    # --- transitions ---------------------------------------------------------------------------------------

    def _level(self, level: _Level) -> None:
        if level.parallel or not level.inside:
            return
        history = None
        if level.state is not None and self.random.random() < 0.3:
            history = self.chart.junction(level.state, history=True)
        self._defaults(level)
        for one in level.inside:
            self._outer(level, one, history)
        if level.state is not None and self.random.random() < 0.4:
            self._inner(level, level.state, history)

    def _defaults(self, level: _Level) -> None:
        """A default path that always leads to a state."""
        holder = level.state
        states = [one.state for one in level.inside]
        if self.random.random() < 0.4:
            junction = self.chart.junction(holder)
            self.chart.transition(None, junction, self.texts.label(always=True), 1, holder or self.chart)
            for order in (1, 2):
                label = self.texts.label(always=order == 2, timed=False)
                self.chart.transition(
                    junction, self.random.choice(states), label, order, holder or self.chart
                )
            return
        label = self.texts.label(always=True) if self.random.random() < 0.4 else ""
        self.chart.transition(None, states[0], label, 1, holder or self.chart)

    def _targets(self, level: _Level) -> list[Node]:
        """States that a transition may lead to from a state in a level: none in another region."""
        found: list[Node] = []
        for one in level.inside:
            found += [below.state for below in one.every() if below.state is not None]
        return found

    def _outer(self, level: _Level, one: _Level, history: WrittenJunction | None) -> None:
        assert one.state is not None
        targets = self._targets(level)
        near: list[Node] = [other.state for other in level.inside if other.state is not None]
        holder = level.state or self.chart
        orders = self.random.randint(0, 3)
        for order in range(1, orders + 1):
            target = self.random.choice([*near, *targets])
            if history is not None and self.random.random() < 0.15:
                target = history
            if level.state is not None and self.random.random() < 0.08:
                target = level.state
            if self.random.random() < 0.3:
                self._path(one.state, holder, order, targets, inner=False)
                continue
            sends = self.random.random() < 0.12 and self.texts.may_send()
            label = self.texts.sending_label() if sends else self.texts.label()
            self.chart.transition(one.state, target, label, order, holder)

    def _inner(self, level: _Level, state: WrittenState, history: WrittenJunction | None) -> None:
        targets: list[Node] = [*self._targets(level), state]
        for order in range(1, self.random.randint(1, 2) + 1):
            target = self.random.choice(targets)
            if history is not None and self.random.random() < 0.2:
                target = history
            if self.random.random() < 0.35:
                self._path(state, state, order, targets, inner=True)
            else:
                self.chart.transition(state, target, self.texts.label(), order, state, inner=True)

    def _path(
        self, source: WrittenState, holder: WrittenState | WrittenChart, order: int, targets: Sequence[Node],
        inner: bool,
    ) -> None:  # fmt: skip
        """A path through junctions: with branches, dead ends, and perhaps a loop of a few turns."""
        chart, texts = self.chart, self.texts
        inside = holder if isinstance(holder, WrittenState) else None
        first = chart.junction(inside)
        chart.transition(source, first, texts.label(), order, holder, inner=inner)
        if self.random.random() < 0.25:
            chart.transition(source, first, texts.label(), order + 10, holder, inner=inner)
        if self.loops and self.random.random() < 0.3:
            self.loops -= 1
            chart.transition(
                first,
                first,
                f"[h >= 0 && h < {self.random.randint(1, 4)}]{{h = h + 1; {texts.note()}}}",
                1,
                holder,
            )
        for number in range(2, self.random.randint(2, 4) + 1):
            label = texts.label(always=self.random.random() < 0.3)
            if self.random.random() < 0.35:
                end = chart.junction(inside)
                chart.transition(first, end, label, number, holder)
                if self.random.random() < 0.7:
                    last = texts.label(always=self.random.random() < 0.4)
                    chart.transition(end, self.random.choice(targets), last, 1, holder)
            else:
                chart.transition(first, self.random.choice(targets), label, number, holder)

    # --- functions -----------------------------------------------------------------------------------------

    def _functions(self) -> None:
        texts, chart = self.texts, self.chart
        if self.random.random() < 0.4:
            body = f"r = double(v) + {self.random.randint(0, 3)};"
            keeps = (
                "persistent p\nif isempty(p)\n p = 0;\nend\np = mod(p + 1, 5);\n"
                if self.random.random() < 0.6 else "p = 2;\n"
            )  # fmt: skip
            loop = "for i = 1:3\n if r > 5\n  break\n end\n r = r + p;\nend\n"
            early = "if v == 1\n r = 9;\n return\nend\n" if self.random.random() < 0.5 else ""
            script = f"function r = made(v)\n{body}\n{early}{keeps}{loop}end\n"
            chart.function("r = made(v)", script=script)
            texts.functions.append("made")
        if self.random.random() < 0.4:
            self._graphical()
        if self.random.random() < 0.3 and not texts.c:
            chart.function("[p, q] = pair(v, w)", script=PAIR)
            texts.pairs = True

    def _graphical(self) -> None:
        """A flow chart that counts up in a loop, and answers with what it counted."""
        chart, c = self.chart, self.texts.c
        function = chart.function("r = flow(v)")
        kind = self.random.choice(WHOLE)
        chart.data("v", "function input", "int16", holder=function)
        chart.data("r", "function output", kind, holder=function)
        chart.data("i", "temporary", "uint8", holder=function)
        first, second, end = (chart.junction(function) for _ in range(3))
        chart.transition(None, first, "{i = 0; r = 1;}", 1, function)
        chart.transition(first, second, f"[i < {self.random.randint(1, 4)}]", 1, function)
        step = "r = r + v; i++;" if c else "r = r + cast(v, 'WHAT'); i = i + 1;".replace("WHAT", kind)
        chart.transition(second, first, f"{{{step}}}", 1, function)
        chart.transition(first, end, f"{{r = r - {self.random.randint(0, 5)};}}", 2, function)
        self.texts.functions.append("flow")


def random_model(seed: int, folder: Path, small: bool = False) -> DrawnModel:
    """The model of a seed, written as a package and read again; a small one has few states."""
    random = Random(seed)
    model = WrittenModel("one", step="0.1")
    ports = {
        name: model.root.inport(name, n, OutDataTypeStr=kind)
        for n, (name, kind) in enumerate(INPUTS.items(), 1)
    }
    block, chart = model.root.chart("C")
    languages: tuple[Language, ...] = ("MATLAB", "MATLAB", "C", "C with bit operations")
    chart.language = random.choice(languages)
    chart.parallel, chart.saturates = random.random() < 0.4, random.random() < 0.6
    chart.more = {
        name: 1 for name in ("executeAtInitialization", "initializeOutput") if random.random() < 0.2
    }
    events = {"UP": "RISING_EDGE_EVENT", "ANY": "EITHER_EDGE_EVENT"} if random.random() < 0.2 else {}
    if random.random() < 0.3:
        events = {name: "FALLING_EDGE_EVENT" for name in events}
    drawing = RandomChart(chart, random, list(events), small)
    for name, trigger in events.items():
        chart.event(name, "INPUT_EVENT", trigger)
    drawing.draw()
    for number, port in enumerate(ports.values(), 1):
        model.root.line(port, f"{block}/{number}")
    if events:
        both = model.root.block("Mux", "both", {"in": 2, "out": 1})
        model.root.line(ports["on"], f"{both}/1")
        model.root.line(ports["u"], f"{both}/2")
        model.root.line(both, f"{block}#trigger")
    outs = [one.name for one in chart.of(WrittenData) if one.scope == "OUTPUT_DATA"]
    for number, name in enumerate(outs, 1):
        model.root.line(
            f"{block}/{number}", model.root.outport(f"{name}_out" if number % 2 else name, number)
        )
    gears = {name: number for number, name in enumerate(MEMBERS)}
    beside = dictionary(folder / "types.sldd", enumerations={"Gear": gears})
    return read_model(model.save(folder / "one.slx"), [beside])


__all__ = ["RandomChart", "random_model"]
