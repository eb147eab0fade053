"""Random machines of SCXML in python-statemachine, which reads SCXML by itself: do they do the same?

    pip install --target FOLDER python-statemachine==3.2.2
    PYTHONPATH=FOLDER python -m benchmarks.scxml_runs [COUNT] [FIRST]

Each is run for 15 events in the interpreter by the standard's algorithm and there; what is active and the
data are compared after each.  The exit code is 1 if one of them differs.

Some differ.  Of seed 27 the steps were followed by hand, and ours are those of the standard; there
python-statemachine 3.2.2 seems to run the content of a transition to a history twice.  Whose fault the others
are is not settled.
"""

import logging
import signal
import sys
from collections import Counter
from collections.abc import Sequence
from contextlib import redirect_stdout
from importlib import import_module
from io import StringIO
from random import Random
from types import FrameType
from typing import Any, NoReturn
from xml.etree import ElementTree

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
        if theirs is None:
            theirs = Witness(in_python(text, machine))
        theirs.step(event)
        active, (found, data) = {one.id for one in ours.active}, theirs.seen()
        if (found, data) != (active, ours.data):
            return f"step {number} ({event}): {sorted(active)} {ours.data}, {sorted(found)} {data}"
    return ""


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
        except Endless:
            told["endless there"] += 1
            print(f"{seed}: an event has no end there", flush=True)
            continue
        told["different" if found else "alike"] += 1
        if found:
            print(f"{seed}: {found}", flush=True)
    print(", ".join(f"{number} {word}" for word, number in told.items()))
    return 1 if told["different"] else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
