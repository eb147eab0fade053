"""A mismatch as a test that anyone can run: a pytest file with the inputs in held blocks."""

from hashlib import sha256
from json import dumps

from checker.conform.cross.beside import Mismatch
from checker.conform.cross.smaller import columns
from checker.conform.cross.stimulus import SILENT, Block, Change, Every, Stimulus

WIDTH = 100

TEMPLATE = '''"""{title}

Written by rovercheck crosscheck.  It fails while the implementation has the fault; run it with pytest.
{expected}
"""

from checker.conform.cross import {names}

IMPLEMENTATION = {address}
STIMULUS = Stimulus(
    start_ms={start},
    blocks=(  # steps, and what changes at the start of them; a stamp: when it is renewed
{blocks}
    ),
)


def test_{board}_{output}() -> None:
    mismatch = replay("{board}", IMPLEMENTATION, STIMULUS)
    assert mismatch is None, f"step {{mismatch.tick}}: {{mismatch.differences}}"
'''


def stimulus_of(mismatch: Mismatch) -> Stimulus:
    """The inputs of a mismatch in held blocks."""
    return columns(mismatch.board, [step.inputs for step in mismatch.steps]).stimulus()


def file_name(mismatch: Mismatch) -> str:
    """``crosscheck_board1_0a1b2c3d.py``: the same name for the same inputs and output."""
    text = repr((stimulus_of(mismatch), mismatch.differences[0].name))
    return f"crosscheck_{mismatch.board.name}_{sha256(text.encode()).hexdigest()[:8]}.py"


def pytest_file(mismatch: Mismatch, address: str) -> str:
    """The text of the test.  ``address`` is that of the implementation, ``KIND:WHAT``."""
    stimulus = stimulus_of(mismatch)
    first = mismatch.differences[0]
    signal = {o.name: o.signal for o in mismatch.board.outputs}
    lines = [
        f"Step {mismatch.tick}: {d.name} must be {signal[d.name].show(d.expected)}, and was "
        f"{'missing' if d.actual is None else signal[d.name].show(d.actual)}."
        for d in mismatch.differences
    ]
    blocks = "\n".join(_block(block) for block in stimulus.blocks)
    names = ["Block", "Stimulus", "replay"]
    names += [word for word in ("SILENT", "Every") if word in blocks]
    return TEMPLATE.format(
        title=f"{mismatch.board.name}: {first.name} is not what the charts require in step {mismatch.tick}.",
        expected="\n".join(lines),
        names=", ".join(sorted(names, key=lambda n: (not n.isupper(), n))),
        address=dumps(address),
        start=stimulus.start_ms,
        blocks=blocks,
        board=mismatch.board.name,
        output="".join(c if c.isalnum() else "_" for c in first.name),
    )


def _block(block: Block) -> str:
    pairs = [f"({dumps(name)}, {_change(change)})" for name, change in block.changes]
    one_line = f"        Block({block.steps}, ({', '.join(pairs)}{',' * (len(pairs) == 1)})),"
    if len(one_line) <= WIDTH:
        return one_line
    inside = "\n".join(f"            {pair}," for pair in pairs)
    return f"        Block({block.steps}, (\n{inside}\n        )),"


def _change(change: Change) -> str:
    if change == SILENT:
        return "SILENT"
    if isinstance(change, Every):
        return "Every()" if change == Every() else f"Every({change.gaps}, {change.lags_ms})"
    return repr(change)
