"""A machine of SCXML or XState as a model to check: its system, and the words of its properties."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from random import Random
from time import process_time

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.model import SCXML, XSTATE, ForeignModel, beside_caller
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import read_scxml
from rovercheck.checker.scxml.records import StateMachine, carried_name
from rovercheck.checker.scxml.system import LoweredMachine, lowered_machine
from rovercheck.checker.scxml.xstate.bindings import bindings_path
from rovercheck.checker.scxml.xstate.reader import read_xstate
from rovercheck.checker.scxml.xstate.runner import runner_of
from rovercheck.spec_model.lang.domain import Domain, Num, boolean
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Var, any_of
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.system import Note, System

SECONDS = 1.0
"""Seconds for which the system is run beside the algorithm of the standard whenever a machine is read."""
RUNS, STEPS = 20, 50


@dataclass(frozen=True)
class MachineModel(ForeignModel):
    """A machine.  ``model["motor"]`` is a datum, ``model["event"]`` the event of a step.

    ``model["event.speed"]`` is what the event carries as ``_event.data.speed``.
    """

    path: Path
    lowered: LoweredMachine

    @property
    def system(self) -> System:
        """The system that properties are about."""
        return self.lowered.system

    @property
    def names(self) -> Mapping[str, Expr]:
        """Everything that has a name."""
        carried = {var.name: var for var in self.lowered.carried.values()}
        return {**self.lowered.data, "event": self.lowered.event, **carried}

    def __getitem__(self, name: str) -> Expr:
        """The formula of a name.  Raises ``ModelError`` for one that is not there."""
        if name not in self.names:
            raise ModelError(f"{self.path.name} has no datum {name!r}. {did_you_mean(name, self.names)}")
        return self.names[name]

    def guard(self, name: str) -> Expr:
        """Whether a guard of XState that has no binding holds in a step.  Raises ``ModelError``."""
        return self._one_of(self.lowered.guards, name, "guard without a binding")

    def ran(self, action: str) -> Expr:
        """Whether an action of XState that has no binding ran in the last step.  Raises ``ModelError``."""
        return self._one_of(self.lowered.ran, action, "action without a binding")

    def _one_of(self, known: Mapping[str, Expr], name: str, what: str) -> Expr:
        if name not in known:
            raise ModelError(f"{self.path.name} has no {what} {name!r}. {did_you_mean(name, known)}")
        return known[name]

    def active(self, *states: str) -> Expr:
        """The condition that one of some states is active, by their ids.  Raises ``ModelError``."""
        return any_of(*(self._active(one) for one in states))

    def _active(self, id: str) -> Expr:
        states = [one for one in self.lowered.machine.states if one.kind != "history"]
        known = {name: one for one in states for name in filter(None, (one.known_as, one.id))}
        if id not in known:
            raise ModelError(f"{self.path.name} has no state {id!r}. {did_you_mean(id, known)}")
        return self.system.charts[0].active_path(self.lowered.view.paths[known[id]])


def scxml_model(path: str | Path) -> MachineModel:
    """The machine in a file ``.scxml``, named from the folder of the file that asks for it.

    Domains of data are read from ``NAME.domains.toml`` beside it.  Raises ``ModelError`` for what cannot be
    read, or has no meaning here.
    """
    return read_machine(beside_caller(path, here(__name__)))


def xstate_model(path: str | Path) -> MachineModel:
    """The machine of XState in a file ``.json``, its ``machine.config``.

    It is named from the folder of the file that asks for it.  What guards and actions mean is read from
    ``NAME.bindings.toml`` beside it, domains of data from ``NAME.domains.toml``.  Raises ``ModelError`` for
    what cannot be read, or has no meaning here.
    """
    return read_machine(beside_caller(path, here(__name__)))


def read_machine(path: Path) -> MachineModel:
    """The same of a path as it stands; read once as long as nothing of it changes."""
    if not path.exists():
        raise ModelError(f"There is no {path}; name a machine, a file {SCXML} or {XSTATE}.")
    whole = path.resolve()
    files = (whole, domains_path(whole), bindings_path(whole))
    return _read(whole, tuple((one, one.stat().st_mtime_ns if one.exists() else 0) for one in files))


@lru_cache(maxsize=8)
def _read(path: Path, _: tuple[tuple[Path, int], ...]) -> MachineModel:
    return machine_model(path, machine_in(path))


def machine_in(path: Path) -> StateMachine:
    """What stands in a file, of either kind.  Raises ``ModelError`` for what cannot be read."""
    return read_xstate(path) if path.suffix == XSTATE else read_scxml(path)


def machine_model(path: Path, machine: StateMachine) -> MachineModel:
    """A machine that was read, with its domains.  Raises ``ModelError`` for what has no meaning here."""
    said = read_domains(domains_path(path))
    carried = {carried_name(name): kind for name, kind in machine.carried.items()}
    known = {*machine.data, *carried}
    for name, domain in said.domains.items():
        if name not in known:
            raise ModelError(f"{said.path}: {name} is no datum. {did_you_mean(name, known)}")
        if name in machine.data:
            _fitting(said.path, name, domain, machine.data[name])
        elif carried[name] == "boolean":
            raise ModelError(f"{said.path}: {name} is true or false, and has no domain. Remove the line.")
        elif not _whole(domain):
            raise ModelError(f"{said.path}: {name} has whole numbers. Write {{ low = 0, high = 9 }}.")
    try:
        made = lowered_machine(machine, str(path), said.domains)
    except RecursionError:
        raise ModelError(f"{path.name}: states or actions are nested too deeply.") from None
    except ModelError as error:
        raise ModelError(f"{path.name}: {error}") from error
    notes = list(made.system.notes)
    difference, limited, _ = compared(made)
    if difference and not (limited and said.domains):
        raise ModelError(
            f"{path.name}: the two ways in which it is read differ {difference}. This is an error of "
            "rovercheck: please report it, with the file."
        )
    if difference:
        notes.append(Note(f"In a random run {difference}.", "domains as given"))
    system = replace(made.system, place=Place(str(path), 1), notes=tuple(notes))
    return MachineModel(path, replace(made, system=system))


def _whole(domain: Domain) -> bool:
    return isinstance(domain.sort, Num) and domain.sort.resolution == 1


def _fitting(file: Path, name: str, domain: Domain, first: bool | int) -> None:
    if isinstance(first, bool) or not _whole(domain) or first not in domain:
        raise ModelError(
            f"{file}: {name} begins as {str(first).lower()}; a domain is of whole numbers, with this one."
        )


def compared(lowered: LoweredMachine, seconds: float = SECONDS) -> tuple[str, bool, int]:
    """Both readings on random events: where they differ first, whether only the system says that a step has
    no meaning, as a value is outside a domain, and how many steps they were compared in.
    """
    random, end, steps = Random(1), process_time() + seconds, 0
    events = ("", *lowered.machine.offered)
    for run in range(RUNS):
        if run and process_time() > end:
            break
        direct, system = runner_of(lowered.machine), Interpreter(lowered.system)
        for tick in range(1, STEPS + 1):
            guards = {one: random.random() < 0.5 for one in lowered.guards}
            event, carried = random.choice(events), _chosen(random, lowered.carried)
            found = _step(lowered, direct, system, event, guards, carried)
            if found is None:
                break
            steps += 1
            if found[0]:
                return f"in tick {tick}: {found[0]}", found[1], steps
            if process_time() > 2 * seconds + end:
                break
    return "", False, steps


def _chosen(random: Random, among: Mapping[str, Var]) -> dict[str, bool | int]:
    """What an event carries: often the ends of a domain."""
    found: dict[str, bool | int] = {}
    for name, var in among.items():
        ends = [var.domain.low, var.domain.high]
        raw = random.choice(ends) if random.random() < 0.3 else random.choice(var.domain.values)
        found[name] = bool(raw) if var.domain is boolean else raw
    return found


def _step(
    lowered: LoweredMachine,
    direct: MachineRunner,
    system: Interpreter,
    event: str,
    guards: dict[str, bool],
    carried: dict[str, bool | int],
) -> tuple[str, bool] | None:
    """One step of both; nothing where neither gives it a meaning."""
    of_standard = of_system = ""
    try:
        direct.step(event, guards, carried)
    except DrawnFault as fault:
        of_standard = f"the algorithm says: {fault}"
    inputs = {lowered.guards[name].name: int(holds) for name, holds in guards.items()}
    inputs |= {lowered.carried[name].name: int(value) for name, value in carried.items()}
    try:
        inputs["event"] = lowered.event.domain.raw(event or "none")
        system.step({name: raw for name, raw in inputs.items() if name in lowered.system.inputs})
    except ModelError as error:
        of_system = f"the system says: {error}"
    if of_standard and of_system:
        return None
    if of_standard or of_system:
        return (of_standard or of_system).rstrip("."), bool(of_system)
    at, [chart] = system.valuation(), lowered.system.charts
    states = [one for one in lowered.machine.states if one.kind != "history"]
    other = {one.id for one in states if evaluate(chart.active_path(lowered.view.paths[one]), at)}
    told = [f"{id} is active in one of them" for id in sorted(other ^ {one.id for one in direct.active})]
    told += [
        f"{name} ran in one of them"
        for name, var in lowered.ran.items()
        if at[var.name] != (name in direct.ran)
    ]
    for name, var in lowered.data.items():
        if at[name] != var.domain.raw(direct.data[name]):
            told.append(f"{name} is {direct.data[name]} and {at[name]}")
    return ", ".join(told), False


__all__ = [
    "MachineModel",
    "compared",
    "machine_in",
    "machine_model",
    "read_machine",
    "scxml_model",
    "xstate_model",
]
