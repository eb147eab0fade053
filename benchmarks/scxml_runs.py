"""Random machines of SCXML in python-statemachine, which reads SCXML by itself: do they do the same?

    pip install --target FOLDER python-statemachine==3.2.2
    PYTHONPATH=FOLDER python -m benchmarks.scxml_runs [COUNT] [FIRST]

Each is run for 15 events in the interpreter by the standard's algorithm and there; what is active and the
data are compared after each.  Where they differ, the machine is run again with ``benchmarks.scxml_mends``, in
which four defects of python-statemachine 3.2.2 are mended, and those that make the difference are told.
The exit code is 1 if one differs, or has no end, even so.

Of the first 300 machines 9 differ and 2 have no end there: 27, 118 and 170 for the content before a history,
113, 159, 213, 250, 274 and 291 for the numbers of states, 258 for the numbers and the order of states, 222
for the content and the numbers; 604 is the first for the past.  With the mends all are alike.
"""

import logging
import signal
import sys
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from contextlib import redirect_stdout
from functools import partial
from importlib import import_module
from io import StringIO
from itertools import combinations
from random import Random
from types import FrameType
from typing import Any, NoReturn
from xml.etree import ElementTree

from benchmarks.scxml_mends import MENDS, mended
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import machine_of
from rovercheck.checker.scxml.records import StateMachine
from tests.scxml.random_machines import inputs, random_machine

STEPS = 15
SPACE = "http://www.w3.org/2005/07/scxml"
PYTHON = {
    "x == 3 ? 0 : x + 1": "0 if x == 3 else x + 1", "!b": "not b", "true": "True", "false": "False",
    "b || x >= 2": "b or x >= 2",
}  # fmt: skip
"""Its expressions are those of Python."""


SECONDS = 2
"""For an event there, which may go on without end."""


class Endless(BaseException):
    """An event there has no end.  No ``Exception``: it takes those for errors of the machine."""


class Refused(Exception):
    """python-statemachine has no meaning for a machine."""


def in_python(text: str, machine: StateMachine) -> str:
    """A machine as python-statemachine reads it.

    It refuses ``type='internal'`` without a target, and with one outside of the source; there the standard
    has it mean the same as an external transition.
    """
    root = ElementTree.fromstring(text)
    states = {one.id: one for one in machine.states}
    for element in root.iter():
        for name in ("cond", "expr"):
            if name in element.attrib:
                element.attrib[name] = PYTHON.get(element.attrib[name], element.attrib[name])
        for one in element.findall(f"{{{SPACE}}}transition"):
            targets = [states[id] for id in one.attrib.get("target", "").split()]
            if not targets or not all(target.is_in(states[element.attrib["id"]]) for target in targets):
                one.attrib.pop("type", None)
    ElementTree.register_namespace("", SPACE)
    return ElementTree.tostring(root, encoding="unicode")


class Witness:
    """A machine at work in python-statemachine.  Raises ``Refused``."""

    def __init__(self, text: str) -> None:
        processor = import_module("statemachine.io.scxml.processor").SCXMLProcessor(trusted=True)
        invalid = import_module("statemachine.exceptions").InvalidDefinition
        try:
            processor.parse_scxml("random", text)
            with redirect_stdout(StringIO()):
                self.machine: Any = processor.start()
        except invalid as error:
            raise Refused(str(error)) from error

    def step(self, event: str) -> None:
        """One event from outside, and everything that follows."""
        if event and not self.machine.is_terminated:
            signal.alarm(SECONDS)
            try:
                with redirect_stdout(StringIO()):  # of <log>
                    self.machine.send(event)
            finally:
                signal.alarm(0)

    def seen(self) -> tuple[set[str], dict[str, Any]]:
        """The states that are active, and the data."""
        model = self.machine.model
        return set(self.machine.configuration_values), {"x": model.x, "b": model.b}


def difference(text: str, machine: StateMachine, events: Sequence[str]) -> str:
    """Where a machine differs first; empty where both do the same, up to a step that is told in its place."""
    ours, theirs = MachineRunner(machine), None
    for number, event in enumerate(("", *events)):
        try:
            ours.step(event)
        except DrawnFault:
            return ""
        try:
            if theirs is None:
                theirs = Witness(in_python(text, machine))
            theirs.step(event)
        except Endless:
            return f"step {number} ({event}) has no end there"
        active, (found, data) = {one.id for one in ours.active}, theirs.seen()
        if (found, data) != (active, ours.data):
            return f"step {number} ({event}): {sorted(active)} {ours.data}, {sorted(found)} {data}"
    return ""


def cause(differs: Callable[[], str]) -> Collection[str]:
    """The fewest mends with which nothing differs; empty if all of them together do not help."""
    for number in range(1, len(MENDS) + 1):
        for some in combinations(MENDS, number):
            with mended(some):
                if not differs():
                    return some
    return ()


def _endless(_number: int, _frame: FrameType | None) -> NoReturn:
    raise Endless


def main(count: int = 300, first: int = 0) -> int:
    """Run them, and print what differs; the exit code."""
    signal.signal(signal.SIGALRM, _endless)
    logging.disable(logging.CRITICAL)
    told = Counter[str]()
    for seed in range(first, first + count):
        text = random_machine(seed, timed=False)
        machine = machine_of(text.encode(), "random.scxml")
        events = [one for one in inputs(machine.offered, Random(seed), STEPS) if one]
        try:
            found = difference(text, machine, events)
        except Refused as error:
            told["refused there"] += 1
            print(f"{seed}: {str(error)[:200]}", flush=True)
            continue
        if not found:
            told["alike"] += 1
            continue
        defects = cause(partial(difference, text, machine, events))
        told["with a known defect there" if defects else "different"] += 1
        print(f"{seed}: {found}", *(f"\n    {MENDS[one]}" for one in defects), sep="", flush=True)
    print(", ".join(f"{number} {word}" for word, number in told.items()))
    return 1 if told["different"] else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
