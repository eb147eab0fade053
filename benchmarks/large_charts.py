"""Charts of thousands of states, as files that a user could have written, and the time of every stage.

    python -m benchmarks.large_charts [REPETITIONS] [--limit SECONDS] [--only SHAPE] [--states N]
                                      [--model FILE] [--write]

A chart of n states has five transitions for each, guarded by a few inputs and, every tenth of them, by the
time since entry.  Its states lie in one level (``flat``), in composites of composites (``nested``), or in
parallel regions (``parallel``).  Prints Markdown; ``--write`` puts it into ``benchmarks/RESULTS.md``,
``--model`` writes the model file of one chart and does nothing else.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from random import Random
from statistics import median
from time import perf_counter, process_time
from typing import TypeVar

from benchmarks.markdown import number, table
from benchmarks.measure import ROOT, run
from benchmarks.results import write

T = TypeVar("T")

SIZES = (200, 600, 2000)
SHAPES = ("flat", "nested", "parallel")
TRANSITIONS = 5
GROUP = 12
"""States of a composite, and composites of one, in the nested chart."""
REGIONS = 4
STAGES = ("read", "well-formed", "lower", "slice", "partition", "encode", "compile", "interpret")

_HEAD = '''"""A chart of {n} states, {shape}."""

from rovercheck.properties.forms import always, reachable
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, implies, var
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.lang.words import after

go = flag("go")
stop = flag("stop")
fault = flag("fault")
speed = var("speed", integer(0, 120, "km/h"))
load = var("load", integer(0, 9))
lamp = flag("lamp")
motor = flag("motor")
level = var("level", integer(0, 9))
'''

_GUARDS = (
    "go & (speed > {a})",
    "stop | fault",
    "(load > {b}) & ~stop",
    "(speed <= {a}) & (load == {b})",
    "fault & ~go",
    "go & (load <= {b}) & (speed > {a})",
)


def model(shape: str, n: int, seed: int = 1) -> str:
    """The text of a model file with one chart, ``Large``, and two properties."""
    random = Random(f"{shape} {n} {seed}")
    if shape == "flat":
        body = _level([f"S{i}" for i in range(n)], random)
        chart = ["[", *body, "],", 'default="S0",']
    elif shape == "nested":
        body, first = _nested(list(range(n)), random)
        chart = ["[", *body, "],", f'default="{first}",']
    else:
        chart = ["[", *_regions(n, random), "],", "parallel=True,"]
    last = f"S{n - 1}"
    lines = [
        _HEAD.format(n=n, shape=shape),
        "large = Chart(",
        '    "Large",',
        *(f"    {line}" for line in chart),
        ")",
        "",
        'LARGE_1 = always("LARGE-1", "The motor is off while the lamp is on.",',
        '                 that=implies(lamp, ~motor), covers=["R1"], on=large)',
        f'LARGE_2 = reachable("LARGE-2", "{last} can be reached.",',
        f'                    that=large.active("{last}"), covers=["R1"], on=large)',
        "",
        'REQUIREMENTS = {"R1": "Lamp and motor exclude each other."}',
    ]
    return "\n".join(lines) + "\n"


def _level(names: Sequence[str], random: Random, ends: Sequence[str] = ()) -> list[str]:
    """States beside each other; most transitions lead to one that is near, as in charts that people draw."""
    lines: list[str] = []
    for at, name in enumerate(names):
        near = [names[(at + step) % len(names)] for step in (1, 2, random.randint(3, 9), -1)]
        targets = [*near, random.choice(ends or names)]
        lines += _state(name, targets, at, random)
    return [f"    {line}" for line in lines]


def _state(name: str, targets: Sequence[str], at: int, random: Random) -> list[str]:
    lamp = at % 3 == 0
    entry = f"assign(lamp, {lamp}), assign(motor, {not lamp}), assign(level, {at % 10})"
    transitions = []
    for order, target in enumerate(targets):
        guard = random.choice(_GUARDS).format(a=random.randrange(5, 120, 5), b=random.randrange(1, 9))
        if (at * TRANSITIONS + order) % 10 == 9:
            guard = f"after({20 * random.randint(2, 50)} * ms)"
        transitions.append(f'        to("{target}", when={guard}),')
    return [f'State("{name}", entry=[{entry}], transitions=[', *transitions, "    ]),"]


def _nested(numbers: Sequence[int], random: Random) -> tuple[list[str], str]:
    """States in composites of at most ``GROUP`` parts; one transition of each may lead anywhere."""
    if len(numbers) <= GROUP:
        names = [f"S{i}" for i in numbers]
        return _level(names, random), names[0]
    size = GROUP
    while size * GROUP < len(numbers):
        size *= GROUP
    lines, groups = list[str](), [numbers[i : i + size] for i in range(0, len(numbers), size)]
    names = [f"C{group[0]}_{group[-1]}" for group in groups]
    for at, (name, group) in enumerate(zip(names, groups, strict=True)):
        inside, first = _nested(group, random)
        away = f"S{random.choice(groups[(at + 1) % len(groups)])}"
        lines += [f'State("{name}", default="{first}", transitions=[to("{away}", when=fault & (load > 8))],']
        lines += ["    states=[", *inside, "]),"]
    return [f"    {line}" for line in lines], names[0]


def _regions(n: int, random: Random) -> Iterator[str]:
    size = n // REGIONS
    for region in range(REGIONS):
        names = [f"S{i}" for i in range(region * size, (region + 1) * size if region < REGIONS - 1 else n)]
        yield f'    State("Region{region}", default="{names[0]}", states=['
        yield from (f"    {line}" for line in _level(names, random))
        yield "    ]),"


# --- measuring ---------------------------------------------------------------------------------------


def staged(path: Path) -> None:
    """In a process of its own: the processor seconds of each stage, a line each.

    Reading holds well-formedness, which is then measured once more, by itself.
    """
    from rovercheck.checker.encode.native import NativeSearch, NativeTask, OptimisationLevel, layout
    from rovercheck.checker.encode.symbolic import transition
    from rovercheck.checker.model.load import load
    from rovercheck.checker.process.garbage import collect_seldom
    from rovercheck.checker.process.isolate import DEEP
    from rovercheck.checker.system.partition import partitions
    from rovercheck.checker.system.slice import sliced
    from rovercheck.properties.reduce import reduce
    from rovercheck.spec_model.lang.interpret import Interpreter
    from rovercheck.spec_model.lang.lower import lower
    from rovercheck.spec_model.lang.wellformed import check_chart

    sys.setrecursionlimit(DEEP)  # as in every child that searches
    collect_seldom()

    def timed(name: str, work: Callable[[], T]) -> T:
        began = process_time()
        done = work()
        print(f"{name} {process_time() - began:.3f}", flush=True)
        return done

    given = timed("read", lambda: load(path))
    [system] = given.systems.values()
    timed("well-formed", lambda: check_chart(system.charts[0]))
    lowered = timed("lower", lambda: lower(system))
    question = reduce(lowered, list(given.properties.values()))
    goals = [g.var for g in question.goals]
    part = timed("slice", lambda: sliced(question.system, goals))
    timed("partition", lambda: partitions(part))
    timed("encode", lambda: transition(part))
    native = timed(
        "compile", lambda: NativeSearch.compile(NativeTask(part, layout(part.variables), tuple(goals)))
    )
    assert native.level in OptimisationLevel
    timed("interpret", lambda: Interpreter(system))


def stages(path: Path) -> Mapping[str, float]:
    """The seconds of each stage that came to its end."""
    own = [sys.executable, "-m", "benchmarks.large_charts", "--stages", str(path)]
    cost = run(own, 600, ROOT, {"ROVERCHECK_CACHE": ""})
    lines = [line.split() for line in cost.text.splitlines()]
    return {words[0]: float(words[1]) for words in lines if len(words) == 2 and words[0] in STAGES}


def verdicts(path: Path, limit: float) -> list[str]:
    """Wall seconds to the first verdict and to the last, and the verdicts, of ``check --timeout``."""
    own = [sys.executable, "-m", "rovercheck", "check", "--model", str(path), "--timeout", f"{limit:g}"]
    began = perf_counter()
    first: float | None = None
    words: list[str] = []
    with subprocess.Popen(
        own, cwd=ROOT, env={**os.environ, "ROVERCHECK_CACHE": ""}, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            found = re.match(r"\S (LARGE-\d) +(proved|violated|unknown)", line)
            if found:
                words.append(f"{found[1]} {found[2]}")
                if found[2] != "unknown" and first is None:
                    first = perf_counter() - began
    return [number(first), number(perf_counter() - began), ", ".join(sorted(words))]


def report(repetitions: int, limit: float, shapes: Sequence[str], sizes: Sequence[int]) -> str:
    """The table in Markdown."""
    rows: list[list[str]] = []
    with tempfile.TemporaryDirectory() as folder:
        for shape in shapes:
            for n in sizes:
                print(f"  {shape} {n} ...", file=sys.stderr, flush=True)
                path = Path(folder) / f"{shape}{n}.py"
                path.write_text(model(shape, n), encoding="utf-8")
                taken = [stages(path) for _ in range(repetitions)]
                each = [[one[name] for one in taken if name in one] for name in STAGES]
                cells = [number(median(found) if found else None) for found in each]
                rows.append([shape, str(n), *cells, *verdicts(path, limit)])
    heads = ["chart", "states", *(f"{name} s" for name in STAGES), "first s", "all s", "verdicts"]
    return f"""Processor seconds of each stage; wall seconds to the first verdict and to the end of
`check --timeout {limit:g}`, two properties, nothing kept from earlier runs. Five transitions for each state.

{table(heads, rows)}"""


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="benchmarks.large_charts", description=(__doc__ or "").split("\n\n")[0]
    )
    parser.add_argument("repetitions", nargs="?", type=int, default=1)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for each search of `check`")
    parser.add_argument("--only", choices=SHAPES, action="append", help="charts of this shape")
    parser.add_argument("--states", type=int, action="append", help="charts of so many states")
    parser.add_argument("--model", type=Path, help="write the model file of the first chart, and end")
    parser.add_argument("--stages", type=Path, help="time the stages of this model file, and end")
    parser.add_argument("--write", action="store_true", help="put the table into benchmarks/RESULTS.md")
    chosen = parser.parse_args()
    shapes, sizes = chosen.only or SHAPES, chosen.states or SIZES
    if chosen.stages:
        staged(chosen.stages)
    elif chosen.model:
        chosen.model.write_text(model(shapes[0], sizes[0]), encoding="utf-8")
    else:
        text = report(chosen.repetitions, chosen.limit, shapes, sizes)
        print(text)
        if chosen.write:
            write("large charts", "Large charts", text, chosen.repetitions)


if __name__ == "__main__":
    main()
