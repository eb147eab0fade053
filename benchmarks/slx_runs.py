"""Random systems of charts, written as models of Simulink and read again: do they do the same?

    python -m benchmarks.slx_runs [--write] [--show] [COUNT] [FIRST]

Each is run for 60 steps in the interpreter of charts, and what is read of its file in both readings; with
``--write`` also the charts in Python that ``import --write`` makes of the file.  With ``--show`` the charts
of the file are drawn, it is decided there and in the system which of its states are reachable, and a run to
one of them is written as a page.  The exit code is 1 if one of them differs.
"""

import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from benchmarks.slx_verdicts import ReadAgain
from rovercheck import check, model, picture, reachable, trace
from rovercheck.checker.results.verdict import Proved
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System
from tests.export.slx_runs import differences, random_system

SECONDS = 20.0
"""For the states of a system."""


def reached(system: System) -> Iterator[Property]:
    """That each state of its charts is reachable."""
    for chart in system.charts:
        for number, path in enumerate(filter(None, chart.states)):
            that, id = chart.active_path(path), f"{chart.name.upper()}-{number}"
            yield reachable(id, f"{chart.name}: {'.'.join(path)}", that=that, covers=["R"], on=system.name)


def show(system: System, folder: Path, seed: int) -> int:
    """Draw, check and trace what is read of a file; the answer is how many states were decided.

    Raises ``AssertionError`` where a verdict is another one than of the system, ``ModelError`` for a system
    that is refused.
    """
    again = ReadAgain(system, folder)
    for chart in again.read.charts:
        picture(chart).write(folder / "chart.svg")
    asked = list(reached(system))
    read = model(again.read, *map(again.property, asked))
    required = {one.result.property.id: one.word for one in check(model(system, *asked), seconds=SECONDS)}
    found = check(read, seconds=SECONDS)
    told = {one.result.property.id: one.word for one in found}
    wrong = {id: (word, required[id]) for id, word in told.items() if word != required[id]}
    wrong = {id: words for id, words in wrong.items() if "unknown" not in words}
    assert not wrong, f"seed {seed}: {wrong}"
    witnesses = [one.result.property.id for one in found if isinstance(one.result.verdict, Proved)]
    for id in witnesses[-1:]:
        trace(read, id).write(folder / "run.html")
    return sum(word != "unknown" for word in told.values())


def main(count: int = 1000, first: int = 0, *, written: bool = False, shown: bool = False) -> int:
    """Run them, and print what differs; the exit code."""
    told, states = Counter[str](), 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            system = random_system(seed)
            try:
                differences(system, Path(folder), seed, written=written)
                states += show(system, Path(folder), seed) if shown else 0
                told["alike"] += 1
            except ModelError as error:
                told["refused"] += 1
                print(f"{seed}: {error}", flush=True)
            except AssertionError as error:
                told["different"] += 1
                print(error, flush=True)
    print(", ".join(f"{number} {word}" for word, number in told.items()))
    if shown:
        print(f"{states:,} states were decided")
    return 1 if told["different"] else 0


if __name__ == "__main__":
    given = [one for one in sys.argv[1:] if not one.startswith("--")]
    sys.exit(main(*map(int, given), written="--write" in sys.argv, shown="--show" in sys.argv))
