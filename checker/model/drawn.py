"""A model of Simulink as a model to check: its system, and the words in which properties speak of it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from rovercheck.checker.drawn.free import freed
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.domains import DomainsFile, domains_path, read_domains
from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.model import SIMULINK, ForeignModel, beside_caller
from rovercheck.checker.model.two_readings import compared_readings, rounding_note
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import Expr, any_of
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.system import Note, System

SECONDS = 1.0
"""Seconds for which the system is run beside the direct interpreter whenever a model is read."""


@dataclass(frozen=True)
class SimulinkModel(ForeignModel):
    """A model of Simulink with its formulas by their names in Simulink.

    ``model["door"]`` is an input, an output or a datum of a chart; elements are named ``probe.level`` and
    ``force(2)``, data that share a name ``Oven.left``.
    """

    path: Path
    lowered: LoweredModel

    @property
    def drawn(self) -> DrawnModel:
        """What the file says."""
        return self.lowered.model

    @property
    def system(self) -> System:
        """The system that properties are about."""
        return self.lowered.system

    @property
    def names(self) -> Mapping[str, Expr]:
        """Everything that has a name: inputs, outputs, and data of charts."""
        own = {name.rpartition(".")[2]: expr for name, expr in self.lowered.data.items()}
        return {**own, **self.lowered.data, **self.lowered.inputs, **self.lowered.outputs}

    def __getitem__(self, name: str) -> Expr:
        """The formula of a name.  Raises ``ModelError`` for one that is not there."""
        names = self.names
        if name not in names:
            raise ModelError(f"{self.path.name} has no signal {name!r}. {did_you_mean(name, names)}")
        return names[name]

    def chart(self, name: str = "") -> Chart:
        """A chart by its name, or the only one.  Raises ``ModelError``."""
        charts = {one.name: one for one in self.system.charts}
        if not name and len(charts) == 1:
            return next(iter(charts.values()))
        wanted = name.replace("/", "_") if name not in charts else name
        if wanted not in charts:
            raise ModelError(f"{self.path.name} has no chart {name!r}. {did_you_mean(name, charts)}")
        return charts[wanted]

    def active(self, *states: str) -> Expr:
        """The condition that one of some states is active: ``Oven/Cooking/Heat``, or ``Heat`` where that is
        the only one of its name.  Raises ``ModelError``.
        """
        return any_of(*(self._active(one) for one in states))

    def _active(self, state: str) -> Expr:
        path = state.replace("/", ".")
        charts = {one.name: one for one in self.system.charts}
        first, _, rest = path.partition(".")
        if first in charts and rest:
            return charts[first].active(rest)
        found, faults = list[Expr](), list[str]()
        for one in charts.values():
            try:
                found.append(one.active(path))
            except ModelError as error:
                faults.append(str(error))
        if len(found) != 1:
            if found:
                raise ModelError(f"{len(found)} charts have a state {state!r}; write its chart before it.")
            raise ModelError(faults[0] if len(faults) == 1 else f"No chart has a state {state!r}.")
        return found[0]


def simulink_model(path: str | Path) -> SimulinkModel:
    """The model in a file ``.slx``, named from the folder of the file that asks for it.

    Domains of inputs are read from ``NAME.domains.toml`` beside it.  Raises ``ModelError`` for what cannot be
    read, or has no meaning here.
    """
    return read_simulink(beside_caller(path, here(__name__)))


def read_simulink(path: Path) -> SimulinkModel:
    """The same of a path as it stands; read once as long as nothing of it changes."""
    if not path.exists():
        raise ModelError(f"There is no {path}; name a model of Simulink, a file {SIMULINK}.")
    whole = path.resolve()
    beside = [one for one in sorted(whole.parent.iterdir()) if one.suffix in (".sldd", ".m", SIMULINK)]
    files = (whole, domains_path(whole), *beside, *read_domains(domains_path(whole)).beside)
    return _read(whole, tuple((one, one.stat().st_mtime_ns if one.exists() else 0) for one in files))


@lru_cache(maxsize=8)
def _read(path: Path, _: tuple[tuple[Path, int], ...]) -> SimulinkModel:
    said = read_domains(domains_path(path))
    return lowered_simulink(path, read_model(path, said.beside), said)


def lowered_simulink(path: Path, model: DrawnModel, said: DomainsFile) -> SimulinkModel:
    """A model that was read, with its domains.  Raises ``ModelError`` for what has no meaning here."""
    model = free_in(model, said)
    refused = [str(note) for note in notes_of(model) if note.kind == "refused"]
    if refused:
        raise ModelError("\n".join(f"{path.name}: {one}" for one in refused))
    try:
        lowered = lowered_model(model, path.name, said.domains, said.step)
    except NotLowered as error:
        raise ModelError(f"{path.name}: {error}.") from error
    unknown = said.domains.keys() - lowered.inputs.keys() - lowered.taken
    if unknown:
        name = min(unknown)
        known = [*lowered.inputs, *lowered.taken]
        raise ModelError(
            f"{said.path}: {name} is no input and no datum of the model. {did_you_mean(name, known)}"
        )
    notes = [*lowered.system.notes, *_beside(path, lowered, said)]
    system = replace(lowered.system, place=Place(str(path), 1), notes=tuple(notes))
    return SimulinkModel(path, replace(lowered, system=system))


def free_in(model: DrawnModel, said: DomainsFile) -> DrawnModel:
    """The model with what a file of domains lets be free.  Raises ``ModelError`` with that file."""
    try:
        return freed(model, said.free)
    except ModelError as error:
        raise ModelError(f"{said.path}: {error}") from error


def _beside(path: Path, lowered: LoweredModel, said: DomainsFile) -> Iterator[Note]:
    """The system is run beside the direct interpreter.

    Yields a note where they differ in a model that computes with real numbers, which the system does not
    round, or where only one of them gives a step a meaning in a model with domains that a user has given, as
    a datum may leave one; raises ``ModelError`` where they differ otherwise.
    """
    found = compared_readings(lowered, SECONDS, said.step).difference
    if found is None:
        return
    note = rounding_note(lowered, found, said.domains)
    if not note:
        raise ModelError(
            f"{path.name}: the two ways in which it is read differ {found}. This is an error of rovercheck: "
            "please report it, with the file."
        )
    yield Note(note, "domains as given" if found.said else "exact reals")


__all__ = ["SimulinkModel", "free_in", "lowered_simulink", "read_simulink", "simulink_model"]
