"""The order of the engines, as data: measured on the rover by ``python -m benchmarks.portfolio``.

What a turn grants is first of all counted in what an engine stores or looks ahead, so that a busy machine
does not change who answers.  Engines that cannot be bounded like that are granted many times the seconds
in which they decide what they do decide.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from rovercheck.checker.engines import Limits


@dataclass(frozen=True)
class Turn:
    """An engine and what it may spend in its turn; None: all that the user allows.

    ``share`` is the part it may take of the time that is left of the user's limit, if there is one.
    """

    engine: str
    depth: int | None = None
    memory: int | None = None
    transitions: int | None = None
    seconds: float | None = None
    share: float = 1.0

    def within(self, limits: Limits, left: float | None) -> Limits:
        """What it may spend when the user allows ``limits`` and ``left`` seconds of them remain."""
        shared = None if left is None else self.share * left
        return replace(
            limits,
            depth=_least(self.depth, limits.depth),
            memory=limits.memory if self.memory is None else min(self.memory, limits.memory),
            transitions=_least(self.transitions, limits.transitions),
            seconds=self.seconds if shared is None else min(shared, self.seconds or shared),
        )


def _least(first: int | None, second: int | None) -> int | None:
    return min((n for n in (first, second) if n is not None), default=None)


MB = 1 << 20

CHECKS = Turn("explicit", memory=128 * MB, transitions=250_000_000, share=0.5)
"""The turn in which it is asked at last whether a model of few states leaves a domain at all, where a run
that counts whatever other runs do has ended the other turns before that was known."""

RECORDED = Turn("kinduction", seconds=120, share=0.3)
"""Before any search: what a recorded proof still shows is shown in seconds."""

_FEW = Turn("explicit", memory=32 * MB, transitions=32_000_000, share=0.3)
"""A second at most: of a broad question it is not known before whether it has few states."""

_SHARED = Turn("explicit", transitions=64_000_000, share=0.4)
"""Half a minute that the cases of a scene share: where one has a short run, the largest need not be searched
to its end; where none has, this is lost on what takes longer."""

SOON = Turn("kinduction", seconds=60, share=0.2)
"""A broad question with more states than that is mostly proved in one to four seconds, or not at all.

Not asked where a proof is recorded: what that leaves open was not proved like this.
"""

_RUNS = Turn("simulation", share=0.2)
"""A second or two for runs that a person would think of; of no use where runs are short or loops."""

_PARTS = Turn("localisation", seconds=300, share=0.5)
"""Proofs about whole boards, of which few variables matter; of no use where little is asked about."""

_PROOFS = (
    Turn("kinduction", seconds=120, share=0.4),
    Turn("pdr", seconds=60, share=0.4),
    Turn("bdd", memory=512 * MB, seconds=60, share=0.4),
)
"""Engines that prove without enumerating; of narrow questions, what a small enumeration left open."""

_LONG = (_RUNS, *_PROOFS, Turn("explicit", share=0.8), Turn("bmc"))
"""What remains for questions that some enumeration has not decided."""

ORDERS: Mapping[str, tuple[Turn, ...]] = MappingProxyType(
    {
        "narrow": (CHECKS, *_LONG),
        "broad": (_FEW, SOON, CHECKS, *_LONG),
        "driven": (
            _SHARED,
            Turn("explicit", share=0.8),
            Turn("bmc", depth=32, share=0.3),
            *_PROOFS,
            Turn("bmc"),
        ),
        "wide": (
            Turn("bmc", depth=32, share=0.3),
            Turn("explicit", memory=64 * MB, seconds=60, share=0.3),
            _RUNS,
            _PARTS,
            *_PROOFS,
            Turn("bmc"),
        ),
        "vast": (
            Turn("bmc", depth=32, share=0.6),
            _RUNS,
            _PARTS,
            Turn("pdr", seconds=120, share=0.6),
            Turn("kinduction", seconds=120, share=0.4),
            Turn("bmc"),
        ),
        "short": (
            Turn("bmc", depth=12, share=0.3),
            Turn("explicit", memory=64 * MB, seconds=60, share=0.3),
            *_PROOFS,
            Turn("bmc"),
        ),
        "concrete": (Turn("bmc", share=0.5), *_PROOFS),
    }
)
"""The turns by kind of question (``Shape.kind``).  An engine that is not there loses its turns.

Enumeration comes first where it can be afforded: it decides most searches of the rover in less time than any
other engine, and its runs are shortest.  Wide systems are mostly asked for runs, which are mostly short.
"""
