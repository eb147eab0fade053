"""Inputs that an implementation takes otherwise: ages and gaps, which it computes from stamps.

Of what no change of the charts explains it is asked whether other values of one such input do.  Inputs that
are sampled are not asked about: with any other value of them almost everything would be explained.
"""

from collections.abc import Iterator, Mapping, Sequence

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.diagnosis.cover import PartCover
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.influence import ChangeInfluence
from rovercheck.checker.diagnosis.pieces import Pieces, Wrong, differing
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.spec_model.abstraction.interface import Carriage
from rovercheck.spec_model.lang.errors import ModelError


def explained_by_inputs(cover: PartCover) -> list[tuple[str, frozenset[int]]]:
    """Of the deviations that are left, by their places, those that other values of one input explain.

    Each is under one input, that which explains most.
    """
    part = cover.evidence
    bench = cover.bench or TrialBench(part)
    left = {n: cover.rows[n] for n in cover.left if bench.decides(cover.rows[n])}
    try:
        cone = part.cone if cover.system is None else part.group.cone(cover.system)
    except (ModelError, StopIteration):
        return []
    names = _computed(part, cone) if left else []
    influence = ChangeInfluence(cover.system or part.group.system, cone.outputs)
    every: list[tuple[str, frozenset[int]]] = []
    for name in names:
        outputs = influence.of_data(name)
        own = {n: rows for n, rows in left.items() if outputs.issuperset(cover.deviations[n].scope.outputs)}
        every.append((name, frozenset(_explained(bench, cone, name, own, cover.base))))
    found: list[tuple[str, frozenset[int]]] = []
    told = frozenset[int]()
    for name, places in sorted(every, key=lambda one: -len(one[1])):
        if places - told:
            found.append((name, places - told))
            told |= places
    return found


def stamps(part: PartEvidence) -> Mapping[str, str]:
    """The inputs of the charts that are made of stamps, each with its stamp."""
    rows = part.group.board.interface.inputs
    made = {c.var.name: (row.signal.name, c.how) for row in rows for c in row.carried}
    return {name: stamp for name, (stamp, how) in made.items() if how is not Carriage.SAMPLE}


def _computed(part: PartEvidence, cone: LogCone) -> list[str]:
    return [v.name for v in cone.system.inputs if v.name in stamps(part) and v.name not in cone.before]


def _explained(
    bench: TrialBench, cone: LogCone, name: str, left: Mapping[int, Pieces], base: Sequence[Wrong]
) -> Iterator[int]:
    numbers = bench.numbers
    concerned = {numbers[run] for pieces in left.values() for run, _ in pieces}
    wrong: dict[int, Wrong | None] = {}
    for number in concerned:
        before = base[number]
        with_it = dict(bench.mismatches(cone, number, None, (name, before)))
        new = with_it.keys() - before.keys()
        pieces = {row: differing(m) if m else before.get(row, frozenset()) for row, m in with_it.items()}
        wrong[number] = None if new else pieces
    for place, own in left.items():
        if all(_is_right(wrong[numbers[run]], row, pieces) for (run, row), pieces in own.items()):
            yield place


def _is_right(wrong: Wrong | None, row: int, pieces: frozenset[tuple[str, int]]) -> bool:
    return wrong is not None and not (wrong.get(row, frozenset()) & pieces)


__all__ = ["explained_by_inputs", "stamps"]
