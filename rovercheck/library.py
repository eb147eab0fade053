"""rovercheck as a library: check a model, and look at what comes of it, in a script or a notebook.

import rovercheck

found = rovercheck.check("heater.py")
assert found.as_expected
rovercheck.trace("heater.py", "HEAT-3").write("heat-3.html")
"""

import html
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import process_time
from typing import overload

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import write
from rovercheck.checker.commands.shared.select import pick, pick_engine, pick_properties
from rovercheck.checker.commands.trace.formats import exit_written
from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.explain.explanation import explained, unexplained
from rovercheck.checker.explain.unrolled_run import OutOfTime
from rovercheck.checker.extras import CERTIFICATES
from rovercheck.checker.model import Model
from rovercheck.checker.model import load as files
from rovercheck.checker.model.drawn import SimulinkModel, simulink_model
from rovercheck.checker.model.kept_invariants import invariants_of
from rovercheck.checker.model.load import model
from rovercheck.checker.model.machine import scxml_model, xstate_model
from rovercheck.checker.model.rover import rover
from rovercheck.checker.render import Renderer, renderers
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.certificates import Certification
from rovercheck.checker.verify.checked import CheckedProperty, worst
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import MachineWarning, SearchSettings, events
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

EXPLAINED_FOR = 10.0
"""Seconds of computing for the cause of a violation; without it a run is shown all the same."""
USUAL = ("html", "svg", "table")
"""The formats that a suffix means which several have."""
FRAME = 640
"""Pixels of height that a run takes in a notebook."""


class NoTrace(LookupError):
    """A verdict rests on no run; the message says on what."""


@dataclass(frozen=True)
class View:
    """A run or a chart to look at: printed, shown by a notebook, or written in any of its formats.

    ``kind`` is ``trace`` or ``statechart``; ``systems`` are those of the model, by name.
    """

    kind: str
    thing: Trace | Chart
    systems: Mapping[str, System] = field(default_factory=dict, repr=False)

    def write(self, path: str | Path, format: str | None = None) -> Path:
        """Write a file, by default in the format of its suffix, and return its path.

        Raises ``ModelError`` for a format that there is not, or that cannot show it, and where nothing can be
        written.
        """
        place = Path(path)
        try:
            if isinstance(self.thing, Trace):
                exit_written(self._format(place, format), self.thing, self.systems, place)
            else:
                write(self._format(place, format).render(self.thing), place)
        except UsageError as error:
            raise ModelError(str(error)) from error
        return place

    def _format(self, place: Path, format: str | None) -> Renderer:
        known = renderers(self.kind)
        if format is not None:
            return pick(f"{self.kind} format", format, known)
        fitting = [name for name, one in known.items() if place.name.endswith(one.FORMAT.suffix)]
        if not fitting:
            suffixes = ", ".join(sorted({one.FORMAT.suffix for one in known.values()}))
            raise ModelError(f"{place} has no suffix of a format; write one of {suffixes}.")
        return known[next((name for name in USUAL if name in fitting), fitting[0])]

    def _text(self, format: str) -> str:
        return str(renderers(self.kind)[format].render(self.thing))

    def __str__(self) -> str:
        return self._text("table") if self.kind == "trace" else str(self.thing)

    def _repr_html_(self) -> str:
        if self.kind == "statechart":
            return self._text("svg")
        page = html.escape(self._text("html"), quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="{FRAME}" style="border:0"></iframe>'


@dataclass(frozen=True)
class Results(Sequence[CheckedProperty]):
    """What a check found, in the order in which the properties are written."""

    found: tuple[CheckedProperty, ...]

    @property
    def as_expected(self) -> bool:
        """Whether every verdict is the one that is expected, "proved" unless a baseline says otherwise.

        It is not where a proof was checked again and rejected.
        """
        return worst(self.found) is Exit.AS_EXPECTED

    def __len__(self) -> int:
        return len(self.found)

    def __iter__(self) -> Iterator[CheckedProperty]:
        return iter(self.found)

    @overload
    def __getitem__(self, key: int | str) -> CheckedProperty: ...
    @overload
    def __getitem__(self, key: slice) -> "Results": ...
    def __getitem__(self, key: int | str | slice) -> "CheckedProperty | Results":
        """A result by its number or by the id of its property.  Raises ``KeyError`` or ``IndexError``."""
        if isinstance(key, slice):
            return Results(self.found[key])
        if isinstance(key, int):
            return self.found[key]
        by_id = {one.result.property.id: one for one in self.found}
        return by_id[key]

    def __str__(self) -> str:
        return "\n".join(" ".join(row) for row in self._rows())

    def _rows(self) -> Iterator[tuple[str, str, str]]:
        for one in self.found:
            note = "" if one.as_expected else f"; expected is {one.expected.verdict}"
            yield one.result.property.id, one.word, f"({evidence(one.result)}{note})"

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{title}</th>" for title in ("property", "verdict", "evidence"))
        rows = ("".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in self._rows())
        return f"<table><tr>{head}</tr>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"


def check(
    of: Model | str | Path,
    *ids: str,
    engine: str = AUTO,
    depth: int | None = None,
    seconds: float | None = None,
    certify: bool = False,
) -> Results:
    """Decide the properties of a model, or those of the ids given.

    ``of`` is a ``Model`` or the path of one; ``seconds`` and ``depth`` (ticks) limit each search, and what
    they cut short is unknown, never proved.  ``certify``: every proof is checked again without the engine
    that found it.  Properties that are marked as costly are decided when they are named.  Raises
    ``ModelError`` for a model or a name without meaning, and where nothing is left to check,
    ``ModuleNotFoundError`` for ``certify`` where the solver for that is not installed.

    >>> from rovercheck import Block, always, assign, check, flag, in_order, model
    >>> lamp, on = flag("lamp"), flag("on")
    >>> system = in_order("lamp", Block("Lamp", [assign(lamp, on)]))
    >>> said = always("LAMP-1", "It shines when on.", that=lamp == on, covers=["R1"], on="lamp")
    >>> check(model(system, said))["LAMP-1"].word
    'proved'
    """
    model = _read(of)
    properties = _chosen(model, ids)
    if certify and not CERTIFICATES.installed:
        raise ModuleNotFoundError(f"{CERTIFICATES.needed('certify=True')}.")
    certifying = Certification(None, True, {}, "", ()) if certify else None
    limits = Limits(depth, seconds)
    search = SearchSettings(_engine(engine), limits, None, invariants_of(model), certifying)
    found = {
        one.property.id: CheckedProperty(one, model.expected(one.property.id))
        for one in _results(properties, model, search)
    }
    return Results(tuple(found[prop.id] for prop in properties))


def _results(properties: Sequence[Property], model: Model, search: SearchSettings) -> Iterator[Result]:
    """The results as they are found; what is wrong with the machine is a Python warning."""
    for one in events(properties, model.systems, search):
        if isinstance(one, Result):
            yield one
        elif isinstance(one, MachineWarning):
            warnings.warn(one.text, RuntimeWarning, stacklevel=3)


def trace(of: Model | str | Path, id: str, *, seconds: float | None = None) -> View:
    """The counterexample of a property, or the witness of a situation, with the cause of its end.

    Raises ``NoTrace`` where the verdict rests on no run, ``ModelError`` for what has no meaning.
    """
    model = _read(of)
    prop = _one(id, model)
    search = SearchSettings(limits=Limits(None, seconds))
    [found] = _results([prop], model, search)
    if isinstance(found.verdict, Unknown) or not isinstance(found.verdict.because, Trace):
        raise NoTrace(f"{prop.id} is {found.verdict.word} and has no trace: {evidence(found)}.")
    on_record = model.expected(prop.id)
    because = on_record.because if on_record.verdict == found.verdict.word else ""
    run = _explained(found.verdict.because, prop, model).with_reason(because)
    return View("trace", run, model.systems)


def load(path: str | Path) -> Model:
    """The model that a file or a folder holds.  Raises ``ModelError`` for what has no meaning."""
    return files.load(Path(path))


def picture(chart: Chart) -> View:
    """The picture of a chart: shown by a notebook, or written as SVG, HTML, DOT and others."""
    return View("statechart", chart)


def _explained(trace: Trace, prop: Property, model: Model) -> Trace:
    start = process_time()
    if unexplained(trace):
        return trace
    try:
        return explained(
            trace, prop, model.systems[trace.system.name], over=lambda: process_time() - start > EXPLAINED_FOR
        )
    except OutOfTime:
        return trace


def _read(of: Model | str | Path) -> Model:
    return of if isinstance(of, Model) else load(of)


def _engine(name: str) -> str:
    try:
        return pick_engine(name)
    except UsageError as error:
        raise ModelError(str(error)) from error


def _one(id: str, model: Model) -> Property:
    try:
        return pick("property", id, model.stated())
    except UsageError as error:
        raise ModelError(str(error)) from error


def _chosen(model: Model, ids: Sequence[str]) -> list[Property]:
    try:
        found = pick_properties(ids, (), model.stated(), among=model.systems)
    except UsageError as error:
        raise ModelError(str(error)) from error
    if not found:
        raise ModelError(
            f"Nothing to check: all properties of {model.name} are costly; name those that you want."
        )
    return found


__all__ = [
    "Model",
    "NoTrace",
    "Results",
    "SimulinkModel",
    "View",
    "check",
    "load",
    "model",
    "picture",
    "rover",
    "scxml_model",
    "simulink_model",
    "trace",
    "xstate_model",
]
