"""The systems in which the monitors of Board 2 are checked: each source alone, all four, and two boards."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from rovercheck.spec_model.board2.monitors import RECORDS, monitor_sources, monitors
from rovercheck.spec_model.board2.slow2 import Record, exact, forgotten, mean_slow, runs
from rovercheck.spec_model.environment import board2 as env
from rovercheck.spec_model.environment.board1 import clock
from rovercheck.spec_model.lang.chart import Component
from rovercheck.spec_model.lang.expr import Var, all_of
from rovercheck.spec_model.lang.system import Note, System, in_order
from rovercheck.spec_model.signals.board2_supervisor import SOURCES, SourceSignals
from rovercheck.spec_model.system_table import SystemTable

GRID = Note(
    "Time stamps lie on the 20 ms grid: an update carries the time of the step that sees it. "
    "A stamp between two steps lets an age pass a strict limit one step earlier.",
    brief="stamps on the steps",
)
WITH_FRAMES = "A new alive counter of Board 1 comes with an accepted frame only."
LONG_OR_SHORT = (
    "Of the gaps only a row of long or of short ones is remembered; the mean of both kinds is free at each "
    "new gap (more runs than the specification)."
)
FORGOTTEN = "The gaps are forgotten: the mean is free at each new gap (more runs than the specification)."
ANY_STAMPS = "Alive counters may change without a frame."


def watching(
    sources: Sequence[SourceSignals], record: Record, name: str = "Monitors_2"
) -> tuple[Component, ...]:
    """Clocks, records and regions of some sources."""
    notes, chart = monitors(record, sources, name)
    return (*(clock(f"{s.region}.age of {name}", s.update, s.age) for s in sources), *notes, chart)


all_sources = in_order(
    "monitors_2",
    *env.clocks,
    *RECORDS,
    monitor_sources,
    text="The monitors of Board 2 with stamps that change at will and the exact mean of ten gaps.",
    assume=env.heartbeat_travels_in_frames,
    notes=[GRID, WITH_FRAMES],
)


def _exact(source: SourceSignals) -> System:
    return in_order(
        f"monitors_2_{source.region}_exact",
        *watching([source], exact),
        text=f"The monitor of {source.region} of Board 2 with stamps that change at will.",
        notes=[GRID],
    )


def _rows(source: SourceSignals) -> System:
    return in_order(
        f"monitors_2_{source.region}",
        *watching([source], runs),
        text=f"The monitor of {source.region} of Board 2; means of long and short gaps together are open.",
        notes=[GRID, LONG_OR_SHORT],
        over=True,
        concrete=f"monitors_2_{source.region}_exact",
    )


# --- two boards that share the stamps of one source --------------------------------------------------


def twin(source: SourceSignals) -> SourceSignals:
    """The same source of a second Board 2."""

    def renamed(v: Var) -> Var:
        return Var(f"twin.{v.name}", v.domain, v.init, f"{v.doc}, second board")

    return replace(
        source,
        name=f"twin.{source.name}",
        update=renamed(source.update),
        age=renamed(source.age),
        status=renamed(source.status),
        deg=renamed(source.deg),
    )


twin_sup_status, twin_esp_status, twin_imu_status, twin_rx_status = (twin(s).status for s in SOURCES)


def _twice(shared: SourceSignals, record: Record) -> tuple[Component, ...]:
    """The monitors of two boards; the second sees the stamps of ``shared`` as the first does."""
    own = [replace(twin(s), update=s.update) if s is shared else twin(s) for s in SOURCES]
    return (*watching(SOURCES, record), *watching(own, record, "Twin_monitors_2"))


def _twice_exact(shared: SourceSignals) -> System:
    return in_order(
        f"monitors_2_twice_{shared.region}_exact",
        *_twice(shared, exact),
        text=f"The monitors of two Boards 2 that see the same stamps of {shared.region}.",
        notes=[GRID, ANY_STAMPS],
    )


def _twice_free(shared: SourceSignals) -> System:
    return in_order(
        f"monitors_2_twice_{shared.region}",
        *_twice(shared, forgotten),
        text=f"As monitors_2_twice_{shared.region}_exact, every mean of gaps left open.",
        assume=mean_slow(shared) == mean_slow(twin(shared)),
        notes=[GRID, ANY_STAMPS, FORGOTTEN, "Equal stamps have equal means."],
        over=True,
        concrete=f"monitors_2_twice_{shared.region}_exact",
    )


def _apart(shared: SourceSignals) -> System:
    others = [s for s in SOURCES if s is not shared]
    return in_order(
        f"monitors_2_apart_{shared.region}",
        *_twice(shared, exact),
        text=f"Two Boards 2 that see the same stamps of {shared.region}, and one of them no others.",
        assume=all_of(shared.update, *(s.update & ~twin(s).update for s in others)),
        notes=[GRID, "Every stamp comes in every step, or never."],
        under=True,
    )


def _each(name: str, make: Callable[[SourceSignals], System]) -> list[tuple[str, Callable[[], System]]]:
    """A system about each source, by the name that it has with a region in it."""
    return [(name.format(source.region), partial(make, source)) for source in SOURCES]


SYSTEMS = SystemTable(
    all_sources,
    *_each("monitors_2_{}_exact", _exact),
    *_each("monitors_2_{}", _rows),
    *_each("monitors_2_twice_{}_exact", _twice_exact),
    *_each("monitors_2_twice_{}", _twice_free),
    *_each("monitors_2_apart_{}", _apart),
)
