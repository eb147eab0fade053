"""How a plotted run looks: its measures, colours and hatches, and where its numbers and texts go."""

from collections.abc import Sequence
from typing import Any

from rovercheck.checker.render.lanes import Mark, Tone

WIDTH = 12.8
"""Inches; 1280 points of a screen."""
LEFT, RIGHT = 1.75, 1.2
CHART, ROW, GAP = 0.95, 0.2, 0.16
TOP, BOTTOM, LINE = 0.85, 0.42, 0.19
SHORTEST = 0.075
"""Inches that a character takes at least, or a band has no label."""
BRIEF = 0.02
"""Inches; what is shorter gets a border, or nobody would see it."""
HATCH = "#7a5a10"
INK, FAINT = "#1d2433", "#8a90a0"
COLOURS = ("#1f4e9c", "#d1730a", "#3d8f6e", "#8b3a94")
"""Blue, orange, green, purple: distinguished by all eyes, and in grey by their dashes."""
DASHES: tuple[tuple[float, tuple[float, ...]], ...] = (
    (0, (1, 0)),
    (0, (5, 2)),
    (0, (1, 1)),
    (0, (6, 2, 1, 2)),
)
FILL = {
    Tone.OK: ("#e3efe8", INK, ""),
    Tone.DEGRADED: ("#f2bd4b", INK, "////"),
    Tone.CRITICAL: ("#8c1030", "#ffffff", ""),
    Tone.IDLE: ("#f1f1f4", FAINT, ""),
    Tone.FIRST: ("#bcd3f2", INK, ""),
    Tone.SECOND: ("#f6cfa0", INK, "...."),
    Tone.ACTION: ("#5b6b9c", "#ffffff", ""),
}
"""Light to dark as it gets worse, with hatches, so that a print in grey still tells them apart."""
MEANINGS = {
    Tone.OK: "OK",
    Tone.DEGRADED: "degraded, or stopped",
    Tone.CRITICAL: "critical, or emergency stop",
    Tone.ACTION: "true, or a manoeuvre",
    Tone.FIRST: "Board 1",
    Tone.SECOND: "Board 2",
    Tone.IDLE: "nothing of these",
}
WIDEST = 84
"""Letters of an explanation that have room; the table has them all."""
STYLE: dict[Any, Any] = {
    "text.parse_math": False,
    "svg.hashsalt": "rovercheck",
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "hatch.linewidth": 0.5,
    "axes.edgecolor": FAINT,
    "axes.linewidth": 0.6,
    "text.color": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
}


def together(marks: Sequence[Mark], end_s: float) -> list[tuple[str, float]]:
    """Numbers to print at a place; those of events less than a number's width apart are joined."""
    joined: list[list[Mark]] = []
    for mark in sorted(marks, key=lambda mark: mark.at_s):
        width = 0.17 * end_s / (WIDTH - LEFT - RIGHT) * (len(joined[-1]) if joined else 1)
        if joined and mark.at_s - joined[-1][-1].at_s < width:
            joined[-1].append(mark)
        else:
            joined.append([mark])
    return [
        (" ".join(str(m.number) for m in group), sum(m.at_s for m in group) / len(group)) for group in joined
    ]


def legend(marks: Sequence[Mark]) -> list[list[str]]:
    """The explanations of the numbers, in lines of at most two."""
    whole = (f"{mark.number}: at {mark.at_s:g} s, {mark.text}" for mark in marks)
    texts = [text if len(text) <= WIDEST else f"{text[:WIDEST]}…" for text in whole]
    half = -(-len(texts) // 2)
    return [texts[line::half] if half else [] for line in range(half)]
