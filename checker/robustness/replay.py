"""A finding as a test that anyone can run: a pytest file with the inputs and what must hold."""

import json
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from rovercheck.checker.adapters import LIMITS, start
from rovercheck.checker.adapters.implementation import Implementation, Values
from rovercheck.checker.adapters.lines import encoded, values
from rovercheck.checker.robustness.rules import NonsenseRule, RobustnessRules
from rovercheck.checker.robustness.sanitizers import Sanitizers, sanitizers
from rovercheck.checker.robustness.search import RobustnessFinding, RobustnessSearch
from rovercheck.spec_model.abstraction import Board, boards

UNLIMITED = -1
"""Sanitizers reserve far more memory than they use."""
TEXT = '''"""{about}

Written by `rovercheck robustness`.  It fails while the implementation has the fault:

    ROVERCHECK_IMPL=KIND:WHAT pytest THIS_FILE
"""

import os

from rovercheck.checker.robustness.replay import replayed
{imports}
IMPLEMENTATION = {address!r}
RULES = {rules}
STEPS = [
{steps}
]


def test_it_holds_what_it_must():
    implementation = os.environ.get("ROVERCHECK_IMPL", IMPLEMENTATION)
    assert replayed({board}, implementation, STEPS, RULES) == []
'''


@dataclass(frozen=True)
class HostileImplementation:
    """An implementation that takes odd inputs, where sanitizers write, and whether there are any."""

    implementation: Implementation
    logs: Path | None
    sanitized: Sanitizers


@contextmanager
def opened(
    address: str, board: Board, rules: RobustnessRules, *, sanitize: bool = True
) -> Iterator[HostileImplementation]:
    """An implementation, compiled with sanitizers where it is sources in C and the compiler has them.

    Raises ``ImplementationError`` if it cannot be started.
    """
    with tempfile.TemporaryDirectory(prefix="rovercheck-") as place:
        wanted = sanitize and address.startswith("c:")
        found = sanitizers(Path(place)) if wanted else Sanitizers(missing="" if wanted else "not asked for")
        limits = replace(LIMITS, step=rules.step_seconds, hostile=True)
        if found.flags:
            limits = replace(limits, memory=UNLIMITED, flags=found.flags, environment=found.environment or {})
        implementation = start(address, board, limits)
        try:
            yield HostileImplementation(implementation, Path(place) if found.flags else None, found)
        finally:
            implementation.close()


def replayed(board: str | Board, address: str, steps: Sequence[Any], rules: dict[str, Any]) -> list[str]:
    """What an implementation breaks in these steps, in words."""
    of = boards()[board] if isinstance(board, str) else board
    written = dict(rules)
    written["ranges"] = {name: tuple(pair) for name, pair in rules["ranges"].items()}
    written["nonsense"] = tuple(
        NonsenseRule(tuple(r["inputs"]), r["steps"], tuple((n, v) for n, v in r["required"]))
        for r in rules["nonsense"]
    )
    meant = RobustnessRules(**written)
    inputs = [values(dict(one)) for one in full(of, steps)]
    with opened(address, of, meant) as hostile:
        search = RobustnessSearch(of, hostile.implementation, meant, hostile.logs)
        return [f"step {b.step}: {b.says}" for b in search.broken(inputs)]


def full(board: Board, steps: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """All inputs of each step from those that change."""
    at: dict[str, Any] = dict(board.at_power_up())
    found = []
    for one in steps:
        at |= one
        found.append(dict(at))
    return found


def replay_test(finding: RobustnessFinding, board: Board, address: str, rules: RobustnessRules) -> str:
    """The test of a finding."""
    imports, expression = "", repr(board.name)
    if board.model:
        imports = "from rovercheck.checker.robustness.replay import board_at\n"
        expression = f"board_at({board.model!r}, {board.name!r})"
    return TEXT.format(
        about=f"{board.name}: {finding.breach.says.splitlines()[0]}, in step {finding.breach.step}.".replace(
            "\\", "/"
        ),
        imports=imports,
        address=address,
        rules=json.dumps(asdict(rules)).replace("true", "True").replace("false", "False"),
        steps="\n".join(f"    {_literal(one)}," for one in _changes(board, finding.inputs)),
        board=expression,
    )


def board_at(model: str, system: str) -> Board:
    """A board of a user's own model.  Raises ``ModelError``."""
    from rovercheck.checker.compare.variants import of_model
    from rovercheck.checker.model.load import load

    return of_model(load(Path(model)), system)


def file_of(finding: RobustnessFinding, board: Board) -> str:
    """``robustness_board1_0a1b2c3d.py``: the same name for the same cause."""
    text = f"{finding.breach.kind} {finding.breach.where}"
    return f"robustness_{board.name}_{sha256(text.encode()).hexdigest()[:8]}.py"


def _changes(board: Board, inputs: Sequence[Values]) -> Iterator[dict[str, Any]]:
    before: dict[str, Any] = dict(board.at_power_up())
    for one in inputs:
        yield {name: value for name, value in one.items() if repr(before[name]) != repr(value)}
        before = dict(one)


def _literal(moment: dict[str, Any]) -> str:
    """As Python writes it, with what is no number as in JSON lines."""
    return repr(json.loads(encoded(moment)))
