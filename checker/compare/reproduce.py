"""A mismatch as a test that anyone can run: a pytest file with the inputs, and what the charts require."""

from collections.abc import Iterator
from dataclasses import replace
from hashlib import sha256

from rovercheck.checker.board_tests.pytest_file import pytest_file
from rovercheck.checker.compare.beside import StepMismatch
from rovercheck.checker.compare.result import Failure
from rovercheck.checker.results.board_test import BoardStep, BoardTest
from rovercheck.checker.testgen.expected_outputs import under_test
from rovercheck.checker.testgen.scripts import Script, script

Found = StepMismatch | Failure


def script_of(found: Found) -> Script:
    """The inputs of a mismatch or a failure."""
    return script(found.board, [step.inputs for step in found.steps])


def file_name(found: Found) -> str:
    """``crosscheck_board1_0a1b2c3d.py``: the same name for the same inputs and output."""
    text = repr(([step.inputs for step in found.steps], _subject(found)))
    return f"crosscheck_{found.board.name}_{sha256(text.encode()).hexdigest()[:8]}.py"


def _subject(found: Found) -> str:
    """The output that differs first, or that there is no answer."""
    return found.differences[0].name if isinstance(found, StepMismatch) else "answers"


def reproduction(found: Found, address: str, charts: str = "") -> str:
    """The text of the test.

    ``address`` is that of the implementation, ``KIND:WHAT``; ``charts`` says how the charts differ from those
    specified.
    """
    board = replace(under_test(found.board), implementation=address)
    steps = tuple(BoardStep(step.inputs, step.expected) for step in found.steps)
    return pytest_file(list(_about(found, charts)), [BoardTest(board, _subject(found), steps)])


def _about(found: Found, charts: str) -> Iterator[str]:
    """What must be, and what was."""
    what = "is not what the charts require" if isinstance(found, StepMismatch) else "fail"
    yield f"{found.board.name}: {_subject(found)} {what} in step {found.tick}."
    yield (
        "Written by `rovercheck compare`.  It fails while the implementation has the fault; the outputs "
        f"required are those of the charts{f' {charts}' if charts else ''} as they were then."
    )
    if isinstance(found, Failure):
        yield ascii(found.message.splitlines()[0])[1:-1]
        return
    if found.earlier:
        yield (
            f"Other outputs differ before, in {found.earlier} of the steps: the test fails there first, and "
            "shows this one when they are repaired."
        )
    signal = {o.name: o.signal for o in found.board.outputs}
    for d in found.differences:
        was = "missing" if d.actual is None else signal[d.name].show(d.actual)
        yield f"Step {found.tick}: {d.name} must be {signal[d.name].show(d.expected)}, and was {was}."
