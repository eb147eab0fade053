"""Faults put in by hand into charts and blocks, and whether a property of the catalogue kills them."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

from pytest import MonkeyPatch

from benchmarks.faults.edits import BlockEdit, ChartEdit, PartEdit, of_block, of_chart
from rovercheck.checker.engines import Limits
from rovercheck.checker.results.verdict import Verdict
from rovercheck.checker.verify.checked import length
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.edit import everywhere, in_block, in_system, instead
from rovercheck.spec_model.lang.expr import Const, Expr, Var
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems
from tests.faults import FaultSuite

Change = Callable[[Expr], Expr]


@dataclass(frozen=True)
class Fault:
    """A slip in one chart or block, and the property that must kill it."""

    text: str
    part: str
    killer: str
    edit: PartEdit

    def __str__(self) -> str:
        return f"{self.part}: {self.text}"


def in_charts(table: Mapping[str, Sequence[tuple[str, str, ChartEdit]]]) -> list[Fault]:
    """The faults of a table: for each chart what is wrong, who kills it, and the edit."""
    return [Fault(text, part, killer, of_chart(e)) for part in table for text, killer, e in table[part]]


def in_blocks(table: Mapping[str, Sequence[tuple[str, str, BlockEdit]]]) -> list[Fault]:
    """The same for function blocks."""
    return [Fault(text, part, killer, of_block(e)) for part in table for text, killer, e in table[part]]


# --- who kills ----------------------------------------------------------------------------------


def decided(killer: str, edit: Callable[[System], System]) -> Verdict:
    """The killer's verdict on its own system after the edit; an over-approximation is taken as it is."""
    prop = catalogue()[killer]
    changed = replace(edit(systems()[prop.on]), over=False)
    [result] = decide(Task(changed, (prop,)), systems(), "explicit", Limits())
    return result.verdict


@cache
def _as_specified(killer: str) -> tuple[str, int | None]:
    verdict = decided(killer, lambda system: system)
    return verdict.word, length(verdict)


def with_fault(fault: Fault) -> Verdict:
    """The verdict of the fault's killer on the system with the fault."""
    return decided(fault.killer, lambda system: in_system(system, fault.part, fault.edit))


class ChartFaults(FaultSuite):
    """Each fault has its killer: the property named with it."""

    def killed(self, fault: Fault, patch: MonkeyPatch) -> bool:
        """Whether the verdict, or the length of the counterexample, is another than without the fault."""
        verdict = with_fault(fault)
        assert verdict.word != "unknown"
        return (verdict.word, length(verdict)) != _as_specified(fault.killer)


# --- slips in expressions and blocks -----------------------------------------------------------------


def reads(wrong: Var, *, for_: Var) -> Change:
    """Another variable is read."""
    return instead(for_.name, lambda _: wrong)


def mistaken(wrong: Const, *, for_: Const) -> Change:
    """One member of an enumeration is taken for another."""

    def change(node: Expr) -> Expr:
        same = isinstance(node, Const) and node.sort == for_.sort and node.value == for_.value
        return wrong if same else node

    return lambda expr: everywhere(expr, change)


def expressions(change: Change) -> BlockEdit:
    """A change in every expression of a block."""
    return lambda block: in_block(block, change)


def value(of: Var, change: Change) -> BlockEdit:
    """Another value is assigned to a variable, wherever the block assigns one."""
    return _assignments(of, lambda found: [Assign(found.var, change(found.value))])


def forgotten(of: Var) -> BlockEdit:
    """A variable keeps its value where the block assigns one."""
    return _assignments(of, lambda found: [Assign(found.var, found.var)])


def goes_to(wrong: Var, *, for_: Var) -> BlockEdit:
    """What is meant for one variable, which keeps its value, is assigned to another."""
    return _assignments(for_, lambda found: [Assign(wrong, found.value), Assign(found.var, found.var)])


def _assignments(of: Var, change: Callable[[Assign], Sequence[Action]]) -> BlockEdit:
    def walk(actions: Sequence[Action]) -> Iterator[Action]:
        for action in actions:
            if isinstance(action, If):
                yield If(action.condition, tuple(walk(action.then)), tuple(walk(action.otherwise)))
            elif isinstance(action, Assign) and action.var.name == of.name:
                yield from change(action)
            else:
                yield action

    return lambda block: Block(block.name, tuple(walk(block.do)), text=block.text)
