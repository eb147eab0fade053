"""A trace as a pytest file that gives the same run to a supervisor and compares what it produces.

It needs the run as the boards see it (``Trace.concrete``).
"""

import json
import re
import textwrap
from collections.abc import Mapping

from rovercheck.checker.render.waves import outcome
from rovercheck.checker.results.board_steps import BoardRun, Value, held
from rovercheck.checker.results.format import Format, Need
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.errors import ModelError

FORMAT = Format(
    "pytest",
    "trace",
    ".py",
    "pytest file: the run given to a supervisor, its outputs compared",
    needs=frozenset({Need.BOARD_STEPS}),
)
"""Shows the run as the boards see it."""

WIDTH = 106

NOTE = (
    "Written by `rovercheck trace`.  The outputs required are those of the charts as they were then, so the "
    "test passes for a supervisor that does as the charts do"
)
BROKEN = ", although they break the property: once they are repaired, write it anew."

TEMPLATE = '''"""{title}: a run that {shows} it, given to a supervisor.

{text}

{note}

It runs the supervisor{s} of this project, {names}.  For another:

    ROVERCHECK_IMPL=KIND:WHAT pytest {file}{only}

or `pytest --impl KIND:WHAT` where the option is known, as beside the files of `rovercheck generate-tests`.
"""

import os
from contextlib import closing

import pytest
from rovercheck.checker.adapters import start
from rovercheck.spec_model.abstraction import boards

CLOCK = "now_ms"
TICK_MS = {tick_ms}
NEAR = 1e-6  # in the unit, or as a part of the value: single precision will do
OURS = {{
{ours}}}

# Rows of steps with equal inputs: how many, the inputs that change (of a time stamp: how many ms before each
# of these steps its datum came, None where none comes), the outputs required that change (None: any value).
RUNS = {{
{runs}}}


def played(board, rows):
    """The inputs of each step, and the outputs required after it."""
    stamps = {{s.name for s in board.inputs if s.stamp}}
    now, at, lags, required = 0, board.at_power_up(), {{}}, {{}}
    for count, given, wanted in rows:
        lags |= {{name: value for name, value in given.items() if name in stamps}}
        at |= {{name: value for name, value in given.items() if name not in stamps}}
        required |= wanted
        for _ in range(count):
            now += TICK_MS
            at |= {{CLOCK: now}} | {{name: now - lag for name, lag in lags.items() if lag is not None}}
            yield dict(at), {{name: value for name, value in required.items() if value is not None}}


@pytest.mark.parametrize("name", RUNS)
def test_outputs(name, request):
    named = request.config.getoption("--impl", None) or os.environ.get("ROVERCHECK_IMPL")
    with closing(start(named or OURS[name], board := boards()[name])) as implementation:
        implementation.reset()
        for step, (inputs, required) in enumerate(played(board, RUNS[name]), start=1):
            actual = implementation.step(inputs)
            wrong = {{n: (v, actual[n]) for n, v in required.items()
                     if n in actual and abs(actual[n] - v) > NEAR * max(1, abs(v))}}
            assert not wrong, f"step {{step}} ({{inputs[CLOCK]}} ms), output: (required, actual) {{wrong}}"
'''


def render(trace: Trace) -> str:
    """The text of the file.  Raises ``ModelError`` for a run that is not known as a board sees it."""
    runs = required(trace)
    title = trace.property.id or trace.system.name
    names = [run.board for run in runs]
    broken = outcome(trace) == "violated"
    return TEMPLATE.format(
        title=_quotable(title),
        shows="breaks" if broken else "shows",
        text=_wrapped(_quotable(trace.property.text) or "A run of the model."),
        note=_wrapped(NOTE + (BROKEN if broken else ".")),
        s="s" * (len(names) > 1),
        names=" and ".join(names),
        file=f"test_{re.sub(r'[^a-z0-9]+', '_', title.lower()).strip('_')}.py",
        only=f" -k {names[0]}" if len(names) > 1 else "",
        tick_ms=runs[0].tick_ms,
        ours="".join(f"    {_text(run.board)}: {_text(run.implementation)},\n" for run in runs),
        runs="".join(f"    {_text(run.board)}: [\n{_rows(run)}    ],\n" for run in runs),
    )


def required(trace: Trace) -> tuple[BoardRun, ...]:
    """The run as the boards see it.  Raises ``ModelError`` where it was not worked out."""
    if not trace.concrete:
        raise ModelError(
            f"This run of {trace.system.name} is not known as the inputs of a supervisor; use the format "
            "csv or json, or a property of a board."
        )
    return trace.concrete


def _rows(run: BoardRun) -> str:
    """Each row below the ticks and the time that it stands for."""
    found, first = [], 1
    for count, given, wanted in held(run):
        last = first + count - 1
        ticks = f"ticks {first} to {last}" if count > 1 else f"tick {first}"
        found.append(f"        # {ticks}, from {first * run.tick_ms} ms\n        ({count},\n")
        found.append(f"{_values(given)},\n{_values(wanted)}),\n")
        first = last + 1
    return "".join(found)


def _values(values: Mapping[str, Value | None]) -> str:
    inside = ", ".join(f"{_text(name)}: {value!r}" for name, value in values.items())
    lines = textwrap.wrap(f"{{{inside}}}", WIDTH - 10, break_long_words=False, break_on_hyphens=False)
    return textwrap.indent("\n ".join(lines), " " * 9)


def _text(shown: str) -> str:
    return json.dumps(shown)


def _wrapped(text: str) -> str:
    return textwrap.fill(text, WIDTH)


def _quotable(text: str) -> str:
    """Text that can stand in a documentation string."""
    return text.replace("\\", "\\\\").replace('"', "'")
