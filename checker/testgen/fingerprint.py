"""What the charts of a board are, as one short key: what was proved of them is kept for no others."""

from collections.abc import Iterator
from hashlib import sha256

from rovercheck.checker.encode.python_text import text_of
from rovercheck.checker.testgen.compiled_charts import source
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System


def fingerprint(board: Board, model: System) -> str:
    """SHA-256, in hexadecimal, of the charts of a board and of its model: variables, step and assumption."""
    lines = [*_text(board.system), *_text(model)]
    return sha256("\n".join(lines).encode()).hexdigest()


def _text(system: System) -> Iterator[str]:
    lowered = lower(system)
    yield from (_drawn(v) for v in (*lowered.inputs, *lowered.variables, *lowered.frozen))
    yield text_of(lowered.assume, lambda var: var.name)
    yield source(lowered)


def _drawn(var: Var) -> str:
    return f"{var.name}: {var.domain!r} = {var.init}"
