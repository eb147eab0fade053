"""What fired: a complete path taken in one execution of a chart, with its label as drawn."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from rovercheck.spec_model.lang.action import Action, as_calls
from rovercheck.spec_model.lang.chart import Path, Transition
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.place import Place


@dataclass(frozen=True)
class FiredTransition:
    """A path taken from a state to a state, through junctions perhaps (rules G7, G9).

    ``source`` is empty for a default transition and ``order`` then 0; otherwise ``order`` is the
    position, from 1, of the path's first transition among those leaving ``source``.  ``event`` is the
    local event being processed.  ``place`` is where that first transition is written.
    """

    chart: str
    source: Path
    target: Path
    label: str
    order: int
    event: str | None = None
    place: Place | None = field(default=None, compare=False, repr=False)


def path_label(segments: Sequence[Transition]) -> str:
    """The labels of the segments of a path, those without label left out."""
    return " → ".join(filter(None, map(segment_label, segments)))


def segment_label(segment: Transition) -> str:
    """``event [guard] {condition action} / transition action``, each part optional (rule G6)."""
    if segment.label is not None:  # an imported chart, whose labels are shown as they are
        return segment.label.text
    parts = [segment.event or ""]
    parts += [f"[{text(segment.guard)}]"] if segment.guard is not None else []
    parts += [f"{{{_listed(segment.do)}}}"] if segment.do else []
    parts += [f"/ {_listed(segment.then)}"] if segment.then else []
    return " ".join(filter(None, parts))


def _listed(actions: Sequence[Action]) -> str:
    return "; ".join(map(str, as_calls(actions)))
