"""Systems of charts, written as machines of SCXML and run in SCION: do they do the same?

    npm install --prefix FOLDER @scion-scxml/scxml@4.3.27
    SCION=FOLDER/node_modules python -m benchmarks.scxml_export_runs [--systems] [--examples] [COUNT] [FIRST]
    SCION=FOLDER/node_modules python -m benchmarks.scxml_export_runs --boards

Random systems, with ``--systems`` those of the rover, or with ``--examples`` those of ``examples``.  Each is
run in the interpreter of charts and there, under the same random inputs, some of which stay for long; with
``--boards``, both boards in the tests kept with the project, which take every transition.  Active states and
data are compared after each step.  Where SCION is not as the standard says, the script beside mends it.  The
exit code is 1 if one of them differs.
"""

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from rovercheck.checker.export.scxml import ScxmlMachine
from rovercheck.checker.model.load import load
from rovercheck.checker.testgen import Test, kept
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems
from tests.export.scxml_runs import Charts, ScxmlStep, scxml_run, unlike
from tests.export.slx_runs import random_system

ROWS = 400
"""Steps of each run."""
EXAMPLES = Path(__file__).parents[1] / "examples" / "models"


class Scion:
    """SCION under node, which runs one machine after the other."""

    def __init__(self) -> None:
        script = str(Path(__file__).with_suffix(".js"))
        self._node = subprocess.Popen(
            ["node", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def run(self, text: str, steps: Iterable[ScxmlStep]) -> dict[str, Any]:
        """What a machine shows after each step, or why it cannot be run."""
        assert self._node.stdin is not None and self._node.stdout is not None
        self._node.stdin.write(json.dumps({"text": text, "steps": [one.given for one in steps]}) + "\n")
        self._node.stdin.flush()
        found: dict[str, Any] = json.loads(self._node.stdout.readline())
        return found

    def close(self) -> None:
        """End it."""
        assert self._node.stdin is not None
        self._node.stdin.close()
        self._node.wait()


def difference(scion: Scion, machine: ScxmlMachine, steps: Sequence[ScxmlStep]) -> str:
    """Where a machine differs first; empty where it shows in each step what it must."""
    answer = scion.run(machine.text, steps)
    if "error" in answer:
        return f"there: {answer['error'][:300]}"
    for number, (step, (active, data)) in enumerate(zip(steps, answer["told"], strict=True), start=1):
        found = unlike(machine, step, set(active), data)
        if found:
            return f"step {number}, {step.given}: {found}"
    return ""


Run = tuple[str, Callable[[], tuple[ScxmlMachine, Sequence[ScxmlStep]]]]
"""A name, and what makes a machine with what it must show."""


def runs(words: Sequence[str]) -> Iterator[Run]:
    """The runs that are asked for."""
    if "--boards" in words:
        for name, board in boards().items():
            yield from ((f"{name}, {test.name}", partial(_tested, board, test)) for test in kept(name))
        return
    for number, (name, system) in enumerate(chosen(words)):
        yield name, partial(scxml_run, system, number, ROWS)


def _tested(board: Board, test: Test) -> tuple[ScxmlMachine, Sequence[ScxmlStep]]:
    charts, reader = Charts(board.system, measured=True), board.reader()
    return charts.machine, [charts.step(reader.step(inputs)) for inputs in test.steps]


def chosen(words: Sequence[str]) -> Iterator[tuple[str, System]]:
    """The systems that are asked for."""
    numbers = [int(one) for one in words if one.isdecimal()]
    first = numbers[1] if len(numbers) > 1 else 0
    if "--systems" in words or "--examples" in words:
        found = dict(systems()) if "--systems" in words else _examples()
        yield from list(found.items())[first : first + numbers[0] if numbers else None]
        return
    for seed in range(first, first + (numbers[0] if numbers else 300)):
        yield str(seed), random_system(seed)


def _examples() -> dict[str, System]:
    folders = sorted(one for one in EXAMPLES.iterdir() if one.is_dir())
    return {name: one for folder in folders for name, one in load(folder).systems.items()}


def main(words: Sequence[str]) -> int:
    """Run them, and print what differs; the exit code."""
    told, scion = Counter[str](), Scion()
    for name, run in runs(words):
        try:
            found = difference(scion, *run())
        except ModelError as error:
            told["refused"] += 1
            print(f"{name}: {error}", flush=True)
            continue
        except LookupError as error:
            told["without inputs"] += 1
            print(f"{name}: {error}", flush=True)
            continue
        told["different" if found else "alike"] += 1
        if found:
            print(f"{name}: {found}", flush=True)
    scion.close()
    print(", ".join(f"{number} {word}" for word, number in told.items()))
    return 1 if told["different"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
