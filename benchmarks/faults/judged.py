"""What a person has judged about mutants that nothing finds: ``judged.toml``, one reason for each group."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

FILE = Path(__file__).with_name("judged.toml")
EQUIVALENT, OUTSIDE = "equivalent", "outside"
KINDS = (EQUIVALENT, OUTSIDE)
"""No input tells an equivalent mutant apart; one outside, only what the charts give no meaning to."""


@dataclass(frozen=True)
class Judgement:
    """Why a mutant cannot be found by comparing it with the charts."""

    kind: str
    reason: str


@cache
def judgements() -> Mapping[str, Judgement]:
    """The judgement of each judged mutant, by its name.

    Raises ``ValueError`` for a mutant that is judged twice, and for a judgement of an unknown kind.
    """
    found: dict[str, Judgement] = {}
    for group in tomllib.loads(FILE.read_text(encoding="utf-8"))["judged"]:
        judgement = Judgement(group["kind"], group["reason"])
        if judgement.kind not in KINDS:
            raise ValueError(f"{judgement.kind!r} is no kind of judgement; write {' or '.join(KINDS)}")
        for name in group["mutants"]:
            if name in found:
                raise ValueError(f"{name} is judged twice; keep one of the two")
            found[name] = judgement
    return found
