"""Random diagrams of blocks, with delays, buses, Goto and From, and subsystems that are controlled."""

from pathlib import Path
from random import Random

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem

INPUTS = {"u": "int8", "k": "uint8", "on": "boolean", "x": "double"}
ONE, TWO, THREE = ({"in": n, "out": 1} for n in (1, 2, 3))


class RandomDiagram:
    """Draws blocks into one system; ``pool`` are its signals by type."""

    def __init__(self, system: WrittenSystem, random: Random, depth: int = 0) -> None:
        self.system, self.random, self.depth = system, random, depth
        self.pool: dict[str, list[str]] = {"logical": [], "int8": [], "uint8": [], "double": []}
        self.numbers = 0

    def add(self, kind: str, signal: str) -> None:
        """A signal that blocks may use."""
        self.pool["logical" if kind == "boolean" else kind].append(signal)

    def signal(self, *kinds: str) -> tuple[str, str]:
        """A signal of one of some types, with its type."""
        found = [(kind, one) for kind in kinds or self.pool for one in self.pool[kind]]
        return self.random.choice(found)

    def draw(self, count: int) -> None:
        """So many blocks."""
        ways = (
            self._logic, self._relation, self._sum, self._gain, self._switch, self._delay, self._saturate,
            self._extreme, self._conversion, self._goto, self._bus, self._feedback, self._controlled,
            self._constant, self._magnitude, self._mux,
        )  # fmt: skip
        for _ in range(count):
            self.random.choice(ways)()

    def block(self, kind: str, ports: dict[str, int], inputs: list[str], gives: str, **values: object) -> str:
        """A block with its inputs."""
        self.numbers += 1
        made = self.system.block(kind, f"{kind}{self.numbers}", ports, {}, **values)
        for number, one in enumerate(inputs, 1):
            self.system.line(one, f"{made}/{number}")
        if gives:
            self.add(gives, made)
        return made

    # --- blocks --------------------------------------------------------------------------------------------

    def _constant(self) -> None:
        kind = self.random.choice(("int8", "uint8", "double"))
        value = self.random.randint(0, 9)
        self.block("Constant", {"out": 1}, [], kind, Value=f"{kind}({value})")

    def _logic(self) -> None:
        operator = self.random.choice(("AND", "OR", "NOT", "NAND", "NOR", "XOR", "NXOR"))
        count = 1 if operator == "NOT" else 2
        inputs = [self.signal()[1] for _ in range(count)]
        self.block("Logic", {"in": count, "out": 1}, inputs, "logical", Operator=operator)

    def _relation(self) -> None:
        sign = self.random.choice(("<", "<=", ">", ">=", "==", "~="))
        self.block("RelationalOperator", TWO, [self.signal()[1], self.signal()[1]], "logical", Operator=sign)

    def _same(self) -> tuple[str, list[str]]:
        """A type of numbers with two signals of it."""
        kind, one = self.signal("int8", "uint8", "double")
        return kind, [one, self.signal(kind)[1]]

    def _rules(self) -> dict[str, object]:
        return {"SaturateOnIntegerOverflow": "on"} if self.random.random() < 0.5 else {}

    def _sum(self) -> None:
        kind, inputs = self._same()
        self.block(
            "Sum", TWO, inputs, kind, Inputs=self.random.choice(("++", "+-", "|-+", "2")), **self._rules()
        )

    def _gain(self) -> None:
        kind, one = self.signal("int8", "uint8", "double")
        factor = self.random.choice(("2", "-1", "0.5", "3")) if kind != "double" else "-1"
        said = {"OutDataTypeStr": kind} if factor == "0.5" else {}
        self.block("Gain", ONE, [one], kind, Gain=factor, **said, **self._rules())

    def _switch(self) -> None:
        kind, (one, other) = self._same()
        criteria = self.random.choice(("u2 >= Threshold", "u2 > Threshold", "u2 ~= 0"))
        control = self.signal()[1]
        self.block("Switch", THREE, [one, control, other], kind, Criteria=criteria, Threshold="1")

    def _delay(self) -> None:
        kind, one = self.signal()
        typed = kind in ("int8", "uint8") and self.random.random() < 0.5
        first = f"{kind}(2)" if typed else str(self.random.randint(0, 3))
        first = "true" if kind == "logical" and self.random.random() < 0.5 else first
        if kind == "logical" and first not in ("true", "0"):
            first = "false"
        self.block(self.random.choice(("UnitDelay", "Memory")), ONE, [one], kind, InitialCondition=first)

    def _saturate(self) -> None:
        kind, one = self.signal("int8", "uint8", "double")
        low = "0" if kind == "uint8" else "-2"
        self.block("Saturate", ONE, [one], kind, LowerLimit=low, UpperLimit="3")

    def _extreme(self) -> None:
        kind, inputs = self._same()
        self.block("MinMax", TWO, inputs, kind, Function=self.random.choice(("min", "max")), Inputs="2")

    def _magnitude(self) -> None:
        kind, one = self.signal("int8", "double")
        self.block("Abs", ONE, [one], kind, **self._rules())

    def _conversion(self) -> None:
        kind = self.random.choice(("int8", "uint8", "double", "boolean"))
        way = self.random.choice(("Floor", "Ceiling", "Zero", "Nearest", "Round"))
        _, one = self.signal()
        self.block("DataTypeConversion", ONE, [one], kind, OutDataTypeStr=kind, RndMeth=way, **self._rules())

    def _mux(self) -> None:
        kind, inputs = self._same()
        both = self.block("Mux", TWO, inputs, "")
        apart = self.block("Demux", {"in": 1, "out": 2}, [both], "", Outputs="2")
        for number in (1, 2):
            self.add(kind, f"{apart}/{number}")

    def _goto(self) -> None:
        kind, one = self.signal()
        self.numbers += 1
        tag = f"T{self.depth}_{self.numbers}"
        self.block("Goto", {"in": 1}, [one], "", GotoTag=tag)
        self.block("From", {"out": 1}, [], kind, GotoTag=tag)

    def _bus(self) -> None:
        inputs = [self.signal("int8")[1], self.signal("logical", "uint8")[1]]
        bus = self.block("BusCreator", TWO, inputs, "", Inputs="2", OutDataTypeStr="Bus: Pair")
        if self.random.random() < 0.5 and self.depth == 0:
            self.numbers += 1
            end = self.system.outport(f"pair{self.numbers}", 100 + self.numbers)
            self.system.line(bus, end)
        apart = self.block("BusSelector", {"in": 1, "out": 2}, [bus], "", OutputSignals="level,ready")
        self.add("int8", f"{apart}/1")
        self.add("logical", f"{apart}/2")

    def _feedback(self) -> None:
        """A sum that is held between two ends and remembered."""
        kind, one = self.signal("int8", "double")
        total = self.block("Sum", TWO, [one], "", Inputs="++", **self._rules())
        held = self.block("Saturate", ONE, [total], kind, LowerLimit="-5", UpperLimit="7")
        first = f"{kind}(1)" if self.random.random() < 0.5 else "1"
        before = self.block("UnitDelay", ONE, [held], "", InitialCondition=first)
        self.system.line(before, f"{total}/2")

    def _controlled(self) -> None:
        """A subsystem that is enabled or triggered, or only groups, with blocks and a chart that counts."""
        if self.depth > 1:
            return
        self.numbers += 1
        control: str = self.random.choice(("", "enable", "trigger"))
        kinds = [self.signal("int8", "uint8", "double") for _ in range(2)]
        block, system = self.system.subsystem(f"Sub{self.depth}_{self.numbers}", 2, 3, control)
        if control == "enable":
            system.block("EnablePort", "Enable", {}, {})
        if control == "trigger":
            kind = self.random.choice(("rising", "falling", "either"))
            system.block(
                "TriggerPort", "Trigger", {}, {}, **({} if kind == "rising" else {"TriggerType": kind})
            )
        inside = RandomDiagram(system, self.random, self.depth + 1)
        for number, (kind, one) in enumerate(kinds, 1):
            inside.add(kind, system.inport(f"i{number}", number))
            self.system.line(one, f"{block}/{number}")
        inside.add("int8", system.block("Constant", "c8", {"out": 1}, {}, Value="int8(3)"))
        inside.add("logical", system.block("Constant", "cl", {"out": 1}, {}, Value="true"))
        inside.add("uint8", system.block("Constant", "cu", {"out": 1}, {}, Value="uint8(9)"))
        inside.add("double", system.block("Constant", "cd", {"out": 1}, {}, Value="1.5"))
        inside.draw(self.random.randint(1, 4))
        counter, chart = system.chart(f"Count{self.depth}_{self.numbers}")
        chart.data("count", "output", "uint8", self.random.randint(0, 7))
        chart.more = {"executeAtInitialization": 1} if self.random.random() < 0.2 else {}
        chart.transition(None, chart.state("A\nen: count = uint8(1);\ndu: count = count * 2 + 1;"))
        inside.add("uint8", counter)
        if control:
            self.system.line(self.signal("logical", "int8")[1], f"{block}#{control}")
        for number, kinds_ in enumerate((("int8", "uint8"), ("logical",), ("double",)), 1):
            kind, one = inside.signal(*kinds_)
            system.line(one, system.outport(f"o{number}", number))
            self.add(kind, f"{block}/{number}")


def random_diagram(seed: int, folder: Path) -> DrawnModel:
    """The diagram of a seed, written as a package and read again."""
    random = Random(seed)
    model = WrittenModel("one", step="0.1")
    drawing = RandomDiagram(model.root, random)
    for number, (name, kind) in enumerate(INPUTS.items(), 1):
        drawing.add(kind, model.root.inport(name, number, OutDataTypeStr=kind))
    drawing.draw(random.randint(3, 14))
    every = [one for some in drawing.pool.values() for one in some]
    for number, one in enumerate(random.sample(every, min(6, len(every))), 1):
        model.root.line(one, model.root.outport(f"y{number}", number))
    beside = dictionary(
        folder / "types.sldd", buses={"Pair": [("level", "int8", "1"), ("ready", "boolean", "1")]}
    )
    return read_model(model.save(folder / "one.slx"), [beside])


__all__ = ["RandomDiagram", "random_diagram"]
