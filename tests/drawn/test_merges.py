"""Merge blocks: one signal of several subsystems, of which that counts that was executed last."""

import re
from collections.abc import Sequence
from pathlib import Path

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.test_function_calls import Calling, summing
from tests.drawn.test_lowering import both
from tests.drawn.two_readings import compared
from tests.simulink.packages_by_hand import refused

KINDS = {"u": "int8", "p": "boolean", "q": "boolean"}
PORTS = {"enable": "EnablePort", "trigger": "TriggerPort"}


class Merging:
    """A model in which ``p`` and ``q`` control subsystems that give ``u + 1`` and ``u + 2``, merged."""

    def __init__(
        self, control: str = "enable", kinds: Sequence[str] = ("int8", "int8"), begins: str = "[]",
        **merge: object,
    ) -> None:  # fmt: skip
        self.model = WrittenModel("one")
        self.root, self.control = self.model.root, control
        numbered = enumerate(KINDS.items(), 1)
        self.ins = {name: self.root.inport(name, n, OutDataTypeStr=kind) for n, (name, kind) in numbered}
        self.merge = self.root.block("Merge", "M", {"in": 2, "out": 1}, {}, Inputs="2", **merge)
        self.blocks = [self.subsystem(n, kind, begins) for n, kind in enumerate(kinds, 1)]
        for number, (name, block) in enumerate(zip("pq", self.blocks, strict=True), 1):
            if control:
                self.root.line(self.ins[name], f"{block}#{control}")
            self.root.line(block, f"{self.merge}/{number}")
        self.root.line(self.merge, self.root.outport("y", 1))

    def subsystem(self, number: int, kind: str, begins: str) -> str:
        """A subsystem that adds its number."""
        block, inside = self.root.subsystem(f"S{number}", 1, 1, self.control)
        if self.control:
            inside.block(PORTS[self.control], "Control", {}, {})
        add = inside.block("Sum", "add", {"in": 2, "out": 1}, {}, OutDataTypeStr=kind)
        inside.line(inside.inport("u", 1), f"{add}/1")
        inside.line(inside.block("Constant", "by", {"out": 1}, {}, Value=f"int8({number})"), f"{add}/2")
        inside.line(add, inside.outport("v", 1, InitialOutput=begins))
        self.root.line(self.ins["u"], block)
        return block

    def read(self, folder: Path) -> DrawnModel:
        """The model, read again."""
        return read_model(self.model.save(folder / "one.slx"))


def merged(model: DrawnModel, rows: Sequence[tuple[int, int, int]]) -> list[float]:
    """The merged signal in each row of ``u``, ``p`` and ``q``, the same in both readings."""
    given = [dict(zip(KINDS, row, strict=True)) for row in rows]
    found = compared(model, given)
    assert (found.rows, found.refused, found.fault) == (len(rows), "", "")
    runner = ModelRunner(model)
    return [runner.step(row)["y"] for row in given]


def test_the_subsystem_that_was_executed_last_gives_the_signal(tmp_path: Path) -> None:
    """It holds its value while none is executed, and before any of them was, it is 0."""
    rows = [(5, 0, 0), (5, 1, 0), (7, 0, 0), (8, 0, 1), (9, 0, 0), (10, 1, 0), (11, 0, 0)]
    assert merged(Merging().read(tmp_path), rows) == [0, 6, 6, 10, 10, 11, 11]


def test_of_two_that_are_executed_in_one_step_the_later_one_gives_it(tmp_path: Path) -> None:
    rows = [(5, 1, 1), (6, 0, 0), (7, 1, 0), (8, 1, 1)]
    assert merged(Merging().read(tmp_path), rows) == [7, 7, 8, 10]


def test_subsystems_that_are_triggered_are_merged_too(tmp_path: Path) -> None:
    rows = [(5, 0, 0), (6, 1, 0), (7, 1, 1), (8, 1, 1), (9, 0, 1), (10, 1, 1)]
    assert merged(Merging("trigger").read(tmp_path), rows) == [0, 7, 9, 9, 9, 11]


def test_subsystems_that_a_chart_calls_are_merged_too(tmp_path: Path) -> None:
    """Of two calls in one step the second one counts."""
    made = Calling("A\ndu: n = u; if u > 2, G; end, if u > 0, F; end, if u < 0, G; end", "F", "G")
    merge = made.root.block("Merge", "M", {"in": 2, "out": 1}, {}, Inputs="2")
    for number, name in enumerate("XY", 1):
        sub = summing(made.root, name)
        made.root.line(f"{made.block}/1", sub)
        made.root.line(made.event(number), f"{sub}#trigger")
        made.root.line(sub, f"{merge}/{number}")
    made.out(merge, "merged")
    assert both(made.runner(tmp_path), [1, 1, -4, 0, 3, 0], "merged") == [0, 1, -4, -4, 4, 4]


def test_a_merge_may_say_how_it_begins(tmp_path: Path) -> None:
    rows = [(5, 0, 0), (5, 0, 1)]
    assert merged(Merging(InitialOutput="3", begins="9").read(tmp_path), rows) == [3, 7]


@pytest.mark.parametrize(
    ("model", "said"),
    [
        (Merging(begins="9"), "M: what feeds it has an initial output, and it has none: give it one, too"),
        (Merging(kinds=("int8", "int16")), "M: its inputs have several types: give them one"),
        (Merging(""), "M: .* feeds it: put that into a subsystem that is enabled, triggered or called"),
    ],
)
def test_what_cannot_be_merged_is_refused_by_both_readings(model: Merging, said: str, tmp_path: Path) -> None:
    for one in refused(model.read(tmp_path)):
        assert re.search(said, one), one
