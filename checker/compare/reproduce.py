"""A mismatch as a test that anyone can run: a pytest file with the inputs in held blocks."""

from collections.abc import Iterator, Mapping
from hashlib import sha256
from json import dumps

from rovercheck.checker.compare.beside import StepMismatch
from rovercheck.checker.compare.result import Failure
from rovercheck.checker.compare.smaller import columns
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Stimulus

WIDTH = 100
AS_READ: Mapping[str, str] = {}

TEMPLATE = '''"""{title}

Written by rovercheck compare.  It fails while the implementation has the fault; run it with pytest.
{expected}
"""

from rovercheck.checker.compare import {names}

IMPLEMENTATION = {address}
STIMULUS = Stimulus(
    start_ms={start},
    blocks=(  # steps, and what changes at the start of them; a stamp: when it is renewed
{blocks}
    ),
)


def test_{board}_{output}() -> None:
    mismatch = replay("{board}", IMPLEMENTATION, STIMULUS{charts})
    assert mismatch is None, f"step {{mismatch.tick}}: {{mismatch.differences}}"
'''


def stimulus_of(found: StepMismatch | Failure) -> Stimulus:
    """The inputs of a mismatch or a failure in held blocks."""
    return columns(found.board, [step.inputs for step in found.steps]).stimulus()


def file_name(found: StepMismatch | Failure) -> str:
    """``crosscheck_board1_0a1b2c3d.py``: the same name for the same inputs and output."""
    text = repr((stimulus_of(found), _subject(found)))
    return f"crosscheck_{found.board.name}_{sha256(text.encode()).hexdigest()[:8]}.py"


def _subject(found: StepMismatch | Failure) -> str:
    """The output that differs first, or that there is no answer."""
    return found.differences[0].name if isinstance(found, StepMismatch) else "answers"


def pytest_file(
    found: StepMismatch | Failure,
    address: str,
    interpretations: Mapping[str, str] = AS_READ,
    repair: str = "",
) -> str:
    """The text of the test.

    ``address`` is that of the implementation, ``KIND:WHAT``; ``interpretations`` and ``repair`` those of the
    charts.
    """
    stimulus = stimulus_of(found)
    what = "is not what the charts require" if isinstance(found, StepMismatch) else "fail"
    blocks = "\n".join(_block(block) for block in stimulus.blocks)
    names = ["InputBlock", "Stimulus", "replay"]
    names += [word for word in ("SILENT", "Every") if word in blocks]
    return TEMPLATE.format(
        title=f"{found.board.name}: {_subject(found)} {what} in step {found.tick}.",
        expected="\n".join(_expectation(found)),
        names=", ".join(sorted(names, key=lambda n: (not n.isupper(), n))),
        address=dumps(address),
        start=stimulus.start_ms,
        blocks=blocks,
        charts=_charts(interpretations, repair),
        board=found.board.name,
        output="".join(c if c.isalnum() else "_" for c in _subject(found)),
    )


def _charts(interpretations: Mapping[str, str], repair: str) -> str:
    parts = [f"interpretations={dumps(dict(interpretations))}"] if interpretations else []
    parts += [f"repair={dumps(repair)}"] if repair else []
    return "".join(f", {part}" for part in parts)


def _expectation(found: StepMismatch | Failure) -> Iterator[str]:
    """What must be, and what was."""
    if isinstance(found, Failure):
        yield ascii(found.message.splitlines()[0])[1:-1]
        return
    signal = {o.name: o.signal for o in found.board.outputs}
    for d in found.differences:
        was = "missing" if d.actual is None else signal[d.name].show(d.actual)
        yield f"Step {found.tick}: {d.name} must be {signal[d.name].show(d.expected)}, and was {was}."


def _block(block: InputBlock) -> str:
    pairs = [f"({dumps(name)}, {_change(change)})" for name, change in block.changes]
    one_line = f"        InputBlock({block.steps}, ({', '.join(pairs)}{',' * (len(pairs) == 1)})),"
    if len(one_line) <= WIDTH:
        return one_line
    inside = "\n".join(f"            {pair}," for pair in pairs)
    return f"        InputBlock({block.steps}, (\n{inside}\n        )),"


def _change(change: Change) -> str:
    if change == SILENT:
        return "SILENT"
    if isinstance(change, Every):
        return "Every()" if change == Every() else f"Every({change.gaps}, {change.lags_ms})"
    return repr(change)
