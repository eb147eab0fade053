"""How long a large chart takes from its Simulink file: read, looked through, lowered, drawn.

    python -m benchmarks.slx_large [REPETITIONS]

The chart has 120 states (10 with 11 each), 360 transitions, 150 junctions and 70 functions, half of them
graphical and half of MATLAB.  ``read`` is the file as the neutral model, ``import`` also the system that is
made of it and 1,000 steps of both readings, ``graph`` the file read and drawn.  Told is the shortest time of
some repetitions, in seconds of the processor, the start of Python included.
"""

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from benchmarks.measure import ROOT, Cost, run
from rovercheck.checker.simulink.writer.charts import WrittenChart, WrittenState
from rovercheck.checker.simulink.writer.packages import WrittenModel

OUTER, INNER, FUNCTIONS = 10, 11, 70
STATES, TRANSITIONS, JUNCTIONS = OUTER * (INNER + 1), 360, 150
READ = """\
import sys
from pathlib import Path
from rovercheck.checker.simulink.model import read_model
read_model(Path(sys.argv[1]))
"""


def drawn() -> WrittenModel:
    """The model: one chart between an input ``u`` and an output ``t``."""
    model = WrittenModel("large", step="0.02")
    block, chart = model.root.chart("Large")
    chart.data("u", "input", "int16")
    chart.data("t", "output", "int16")
    _functions(chart)
    _states(chart)
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int16"), block)
    model.root.line(f"{block}/1", model.root.outport("t", 1))
    return model


def _functions(chart: WrittenChart) -> None:
    """Each adds its number to what it is given."""
    for number in range(FUNCTIONS):
        name = f"f{number}"
        if number % 2:
            script = f"function y = {name}(x)\ny = x + {number};"
            made = chart.function(f"y = {name}(x)", script=script)
        else:
            made = chart.function(f"y = {name}(x)")
            chart.transition(None, chart.junction(made), f"{{y = x + {number};}}", holder=made)
        chart.data("x", "function input", "int16", holder=made)
        chart.data("y", "function output", "int16", holder=made)


def _states(chart: WrittenChart) -> None:
    outer: list[WrittenState] = []
    inner: list[WrittenState] = []
    for a in range(OUTER):
        one = chart.state(f"S{a}\nen: t = f{a}(u);")
        outer.append(one)
        own = [
            chart.state(f"S{a}_{b}\ndu: t = f{(a * INNER + b) % FUNCTIONS}(u);", one) for b in range(INNER)
        ]
        inner += own
        chart.transition(None, own[0], holder=one)
        for b, state in enumerate(own):
            junction = chart.junction(one)
            chart.transition(state, junction, f"[u > {b}]")
            chart.transition(junction, own[(b + 1) % INNER], f"[u < {100 + a}]")
    chart.transition(None, outer[0])
    for one, following in zip(outer, [*outer[1:], outer[0]], strict=True):
        chart.transition(one, following, "after(5, sec)")
    count = OUTER + 1 + 2 * OUTER * INNER + OUTER + FUNCTIONS // 2
    through = JUNCTIONS - OUTER * INNER - FUNCTIONS // 2
    for k in range(through):
        junction = chart.junction()
        chart.transition(inner[7 * k], junction, f"[u == {200 + k}]", 2)
        chart.transition(junction, outer[(k + 3) % OUTER], "{t = f1(u);}")
    for k in range(TRANSITIONS - count - 2 * through):
        source, target = inner[k], inner[(k + 5) % len(inner)]
        chart.transition(source, target, f"[u == {300 + k}]", 3)


def main(repetitions: int = 3) -> int:
    """Print the times; the exit code is 1 if a command fails."""
    with tempfile.TemporaryDirectory() as folder:
        file = drawn().save(Path(folder) / "large.slx")
        rovercheck = [sys.executable, "-m", "rovercheck"]
        stages: dict[str, Callable[[], Cost]] = {
            "read": lambda: run([sys.executable, "-c", READ, file], folder=ROOT),
            "import": lambda: run([*rovercheck, "import", file], folder=ROOT),
            "graph": lambda: run(
                [*rovercheck, "graph", "Large", "--model", file, "-o", file.with_suffix(".svg")], folder=ROOT
            ),
        }
        for name, stage in stages.items():
            costs = [stage() for _ in range(repetitions)]
            if any(one.status for one in costs):
                print(costs[0].text)
                return 1
            print(f"{name:8} {min(one.seconds for one in costs):5.2f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
