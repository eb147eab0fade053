"""A trace on the review page: its story to read, and the pictures that move."""

import pickle
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.render import player, timeline
from rovercheck.checker.render.page import Part
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.chart import Chart


def shared(runs: Mapping[str, Trace], charts: Iterable[Chart] = ()) -> dict[str, Trace]:
    """The same traces, in which charts that are equal to each other, or to one of these, are one object.

    Charts come with each trace from the process that found it; a picture is drawn once for each object.
    """
    known = {pickle.dumps(chart): chart for chart in charts}

    def one(chart: Chart) -> Chart:
        return known.setdefault(pickle.dumps(chart), chart)

    def shared(run: Trace) -> Trace:
        charts = {name: one(chart) for name, chart in run.system.statecharts.items()}
        return replace(run, system=replace(run.system, statecharts=charts))

    return {id: shared(run) for id, run in runs.items()}


def story(trace: Trace) -> Part:
    """What happened, only what the property depends on."""
    return timeline.story_part(trace)


def moving(trace: Trace) -> list[Part]:
    """The timeline, and the charts on which the run is played: a script shows both."""
    return [timeline.part(trace, still=False), player.part(trace, pictures=False, printed=False)]


def pictures(traces: Sequence[Trace]) -> Part:
    """The charts of all these traces, each once, for their players."""
    return player.gallery(traces)
