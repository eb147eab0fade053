"""A run as a picture of stacked lanes; the only module that needs matplotlib."""

from collections.abc import Sequence
from io import BytesIO
from typing import TYPE_CHECKING
from warnings import catch_warnings, simplefilter

from rovercheck.checker.extras import PLOT
from rovercheck.checker.render.lanes import Band, ChartLane, Curve, LaneLimit, LaneRows, Lanes, Mark, Tone
from rovercheck.checker.render.run_style import (
    BOTTOM,
    BRIEF,
    CHART,
    COLOURS,
    DASHES,
    FILL,
    GAP,
    HATCH,
    INK,
    LEFT,
    LINE,
    MEANINGS,
    RIGHT,
    ROW,
    SHORTEST,
    STYLE,
    TOP,
    WIDTH,
    legend,
    together,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SUFFIXES = (".svg", ".png", ".pdf")
"""The formats, by the suffix of the file."""

FONTS = b"'DejaVu Sans', Verdana, sans-serif"
"""For whoever looks at an SVG picture without the font with which it was laid out."""


class PlotError(Exception):
    """The picture cannot be drawn here; the message says what to install."""


def draw(lanes: Lanes, suffix: str) -> bytes:
    """The picture in one of ``SUFFIXES``, the same from run to run.

    Raises ``PlotError`` without matplotlib.
    """
    if not PLOT.installed:
        raise PlotError(f"{PLOT.needed('A plot')}.")
    from matplotlib import rc_context, rcdefaults, rcParams

    with rc_context(), catch_warnings():
        simplefilter("ignore")  # of a letter that the font lacks
        rcdefaults()  # whatever the settings of the user are
        rcParams.update(STYLE)
        figure = _figure(lanes)
        target = BytesIO()
        dateless = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {"Software": None}}
        figure.savefig(target, format=suffix[1:], dpi=100, metadata=dateless[suffix])
    return target.getvalue().replace(b"'DejaVu Sans'", FONTS)


def _figure(lanes: Lanes) -> "Figure":
    from matplotlib.figure import Figure

    heights = [CHART if isinstance(lane, ChartLane) else ROW * len(lane.rows) for lane in lanes.lanes]
    below = BOTTOM + LINE * (len(legend(lanes.marks)) + 0.9)
    height = TOP + sum(heights) + GAP * len(heights) + below
    figure = Figure(figsize=(WIDTH, height))
    top = height - TOP
    for place, (lane, tall) in enumerate(zip(lanes.lanes, heights, strict=True)):
        box = (LEFT / WIDTH, (top - tall) / height, (WIDTH - LEFT - RIGHT) / WIDTH, tall / height)
        axes = figure.add_axes(box)
        _frame(axes, lanes, last=place == len(heights) - 1)
        if isinstance(lane, ChartLane):
            _chart(axes, lane)
        else:
            _rows(axes, lane, lanes.end_s)
        if place == 0:
            _numbers(axes, lanes.marks, tall)
        top -= tall + GAP
    _words(figure, lanes, height, below)
    return figure


def _frame(axes: "Axes", lanes: Lanes, *, last: bool) -> None:
    axes.set_xlim(0, lanes.end_s)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.tick_params(axis="x", labelbottom=last, length=3 if last else 0)
    axes.tick_params(axis="y", length=2, pad=2)
    for mark in lanes.marks:
        if mark.until_s > mark.at_s:
            axes.axvspan(mark.at_s, mark.until_s, color=INK, alpha=0.05, linewidth=0, zorder=0)
        axes.axvline(mark.at_s, color=INK, linewidth=0.6, linestyle=(0, (2, 2)), zorder=3)
    if last:
        axes.annotate(
            "s", (1, 0), xycoords="axes fraction", xytext=(12, -6), textcoords="offset points", va="top"
        )


def _chart(axes: "Axes", chart: ChartLane) -> None:
    values = [value for curve in chart.curves for value in curve.values]
    low, high = min([chart.low, *values]), max([chart.high, *values])
    room = (high - low) * 0.06
    axes.set_ylim(low - room, high + room)
    _limits(axes, [limit for limit in chart.limits if low <= limit.value <= high])
    if chart.ticks:
        axes.set_yticks([tick for tick in chart.ticks if low - room <= tick <= high + room])
    for place, curve in enumerate(chart.curves):
        _curve(axes, curve, place)
    axes.grid(axis="y", color="#e4e5ea", linewidth=0.5)
    axes.set_axisbelow(True)
    axes.text(
        -1.68 / (WIDTH - LEFT - RIGHT),
        1.0,
        chart.title,
        transform=axes.transAxes,
        va="top",
        fontweight="bold",
    )
    _key(axes, chart.curves)


def _limits(axes: "Axes", limits: Sequence[LaneLimit]) -> None:
    """Lines across, named at the right; names that would meet are moved up."""
    bottom, top = axes.get_ylim()
    lowest = bottom
    for limit in sorted(limits, key=lambda limit: limit.value):
        axes.axhline(
            limit.value, color=FILL[Tone.CRITICAL][0], linewidth=0.6, linestyle=(0, (4, 2)), zorder=1
        )
        place = max(limit.value, lowest)
        axes.annotate(
            limit.name,
            (1, place),
            xycoords=("axes fraction", "data"),
            xytext=(3, -1),
            textcoords="offset points",
            va="center",
            fontsize=7,
            color=FILL[Tone.CRITICAL][0],
            annotation_clip=False,
        )
        lowest = place + (top - bottom) * 0.115 / CHART if limit.name else lowest


def _curve(axes: "Axes", curve: Curve, place: int) -> None:
    axes.plot(
        curve.times_s,
        curve.values,
        color=COLOURS[place % len(COLOURS)],
        linestyle=DASHES[place % len(DASHES)],
        linewidth=1.2,
        drawstyle="steps-post" if curve.steps else "default",
        zorder=2.5,
    )


def _key(axes: "Axes", curves: Sequence[Curve]) -> None:
    """The names of the curves, under the title of the chart, each in the colour and dashes of its curve."""
    from matplotlib.lines import Line2D

    wide = WIDTH - LEFT - RIGHT
    for place, curve in enumerate(curves):
        y = 1 - (0.3 + 0.155 * place) / CHART
        colour, dashes = COLOURS[place % len(COLOURS)], DASHES[place % len(DASHES)]
        line = Line2D(
            [-1.68 / wide, -1.42 / wide],
            [y, y],
            color=colour,
            linestyle=dashes,
            linewidth=1.4,
            transform=axes.transAxes,
            clip_on=False,
        )
        axes.add_line(line)
        axes.text(-1.36 / wide, y, curve.name, transform=axes.transAxes, va="center", fontsize=7.5)


def _rows(axes: "Axes", lane: LaneRows, end_s: float) -> None:
    axes.set_ylim(len(lane.rows), 0)
    axes.set_yticks([place + 0.5 for place in range(len(lane.rows))], [row.name for row in lane.rows])
    axes.tick_params(axis="y", length=0, labelsize=7.5)
    axes.spines["left"].set_visible(False)
    axes.spines["bottom"].set_visible(False)
    inches_per_s = (WIDTH - LEFT - RIGHT) / end_s
    for place, row in enumerate(lane.rows):
        for band in row.bands:
            _band(axes, place, band, inches_per_s)
    axes.annotate(
        lane.title,
        (1, 0.5),
        xycoords="axes fraction",
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        fontweight="bold",
    )


def _band(axes: "Axes", place: int, band: Band, inches_per_s: float) -> None:
    fill, ink, hatch = FILL[band.tone]
    long = band.end_s - band.start_s
    axes.broken_barh(
        [(band.start_s, long)],
        (place + 0.08, 0.84),
        facecolor=fill,
        edgecolor=fill,
        hatch=hatch or None,
        hatchcolor=HATCH,
        linewidth=1 if long * inches_per_s < BRIEF else 0,
        zorder=2,
    )
    if long * inches_per_s >= SHORTEST * (len(band.label) + 1):
        box = {"facecolor": fill, "edgecolor": "none", "pad": 0.6} if hatch else None
        axes.text(
            band.start_s + 0.05 / inches_per_s,
            place + 0.52,
            band.label,
            va="center",
            fontsize=7,
            color=ink,
            bbox=box,
            zorder=4,
        )


def _numbers(axes: "Axes", marks: Sequence[Mark], tall: float) -> None:
    """The numbers of the events, over the first lane; events too near share a place."""
    for numbers, at_s in together(marks, axes.get_xlim()[1]):
        axes.annotate(
            numbers,
            (at_s, 1 + 0.06 / tall),
            xycoords=("data", "axes fraction"),
            ha="center",
            va="bottom",
            fontsize=7.5,
            fontweight="bold",
            color="#ffffff",
            bbox={"boxstyle": "round,pad=0.22", "facecolor": INK, "edgecolor": "none"},
            annotation_clip=False,
        )


def _tones(figure: "Figure", height: float, below: float) -> None:
    """What the fillings mean, for bands too short for a label."""
    from matplotlib.patches import Rectangle

    x, y = LEFT, below - BOTTOM + 0.1
    for tone, meaning in MEANINGS.items():
        fill, _, hatch = FILL[tone]
        size = 0.22 / WIDTH, 0.11 / height
        box = Rectangle(
            (x / WIDTH, (y - 0.055) / height),
            *size,
            facecolor=fill,
            hatch=hatch,
            hatchcolor=HATCH,
            linewidth=0,
        )
        figure.add_artist(box)
        figure.text((x + 0.28) / WIDTH, y / height, meaning, fontsize=7.5, va="center")
        x += 0.5 + SHORTEST * len(meaning)


def _words(figure: "Figure", lanes: Lanes, height: float, below: float) -> None:
    figure.text(0.07 / WIDTH, 1 - 0.2 / height, lanes.title, fontsize=13, fontweight="bold", va="center")
    figure.text(0.07 / WIDTH, 1 - 0.45 / height, lanes.note, fontsize=8, color="#5b6170", va="center")
    _tones(figure, height, below)
    for line, texts in enumerate(legend(lanes.marks)):
        for column, text in enumerate(texts):
            y = (below - BOTTOM - LINE * (line + 0.8)) / height
            figure.text((0.07 + column * WIDTH / 2) / WIDTH, y, text, fontsize=8, va="center")
