"""A model of Simulink run by both of its readings: the direct interpreter, and the system made of it."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from time import process_time

from rovercheck.checker.drawn.faults import BY_ZERO, DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.lowered import LoweredModel
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.drawn.lower.uses import uses_of
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var

RUNS, STEPS = 20, 50
LONGEST = 20
"""Steps for which inputs are held at most."""
NEAR = 1e-9
"""Relative difference up to which two real numbers count as one; absolute below 1, where digits cancel."""
NEAR_IN_SINGLE = 1e-6
"""The same where some are in single precision, which has seven digits."""


@dataclass(frozen=True)
class ReadingDifference:
    """A step in which the readings give different outputs: by output the interpreter's and the system's.

    ``run`` are the inputs of all steps so far, ``fired`` the transitions that the interpreter took.
    """

    tick: int
    values: Mapping[str, tuple[float, float]]
    run: tuple[Mapping[str, float], ...]
    fired: tuple[str, ...]
    said: str = ""

    def __str__(self) -> str:
        told = ", ".join(f"{name} is {_two(one, other)}" for name, (one, other) in self.values.items())
        fired = f", after {'; '.join(self.fired)}" if self.fired else ""
        return f"in tick {self.tick} {told or self.said}{fired}"


@dataclass(frozen=True)
class Readings:
    """How far two readings were compared, and where they differ first."""

    runs: int
    steps: int
    difference: ReadingDifference | None = None


def compared_readings(lowered: LoweredModel, seconds: float, step: str = "", seed: int = 1) -> Readings:
    """Both readings on random inputs and those on both sides of each limit, held for a while.

    It ends after so many seconds of the processor.  Raises ``ModelError`` where the interpreter does not know
    the model.
    """
    random, end, steps = Random(seed), process_time() + seconds, 0
    uses = uses_of(lowered)
    values = {
        name: list(interesting(var, uses.get(var.name, ((), False))[0]))
        for name, var in lowered.inputs.items()
        if isinstance(var, Var)
    }
    for run in range(RUNS):
        if run and process_time() > end:
            return Readings(run, steps)
        difference, taken = _one_run(lowered, values, random, step)
        steps += taken
        if difference is not None:
            return Readings(run + 1, steps, difference)
    return Readings(RUNS, steps)


def _one_run(
    lowered: LoweredModel, values: Mapping[str, list[float]], random: Random, step: str
) -> tuple[ReadingDifference | None, int]:
    try:
        runner = ModelRunner(lowered.model, step)
    except DrawnFault as fault:
        raise ModelError(f"{lowered.model.name}: {fault}.") from fault
    near = _nearness(lowered.model)
    system, run = LoweredRun(lowered), list[Mapping[str, float]]()
    given = {name: random.choice(some) for name, some in values.items()}
    left = dict.fromkeys(values, 0)
    for tick in range(1, STEPS + 1):
        for name, some in values.items():
            left[name] -= 1
            if left[name] < 0:
                given[name], left[name] = random.choice(some), random.choice((0, 0, 1, 3, LONGEST))
        given |= {
            name: given[of] for name, of in lowered.free.items()
        }  # the interpreter has one value of each
        run.append(dict(given))
        faults = list[str]()
        direct, other = dict[str, float](), dict[str, float]()
        try:
            direct = dict(runner.step(given))
        except DrawnFault as fault:
            faults.append(f"the interpreter says: {fault}")
        try:
            other = system.step(given)
        except ModelError as error:
            faults.append(f"the system says: {error}")
        if len(faults) == 2 or (faults and BY_ZERO in faults[0]):
            return None, tick  # after a division by 0 the interpreter goes on with Inf, as MATLAB does
        wrong = {
            n: (direct[n], other[n])
            for n in direct.keys() & other.keys()
            if not _alike(direct[n], other[n], near)
        }
        if wrong or faults:
            said = "; ".join(faults)
            return ReadingDifference(tick, wrong, tuple(run), tuple(runner.fired), said), tick
    return None, STEPS


def interesting(var: Var, constants: Iterable[Fraction]) -> Iterator[float]:
    """The ends of a domain, and the values on both sides of each constant that it is compared with."""
    near = {var.domain.low, var.domain.high, var.init}
    resolution = var.sort.resolution if isinstance(var.sort, Num) else Fraction(1)
    for constant in constants:
        raw = round(constant / resolution)
        near |= {raw - 1, raw, raw + 1}
    for raw in sorted(near):
        if raw in var.domain:
            yield float(raw * resolution)


def _two(one: float, other: float) -> str:
    """Two numbers, with as many digits as it takes to tell them apart."""
    digits = next((n for n in (6, 9) if f"{one:.{n}g}" != f"{other:.{n}g}"), 17)
    return f"{one:.{digits}g} and {other:.{digits}g}"


def _nearness(model: DrawnModel) -> float:
    """Relative difference up to which two real numbers of a model count as one."""
    levels = (level for chart in model.charts for level in chart.content.every_level())
    types = {one.type for level in levels for one in level.data}
    types |= {element.type for bus in model.buses for element in bus.elements}
    return NEAR_IN_SINGLE if "single" in types else NEAR


def _alike(one: float, other: float, near: float) -> bool:
    return one == other or abs(one - other) <= near * max(abs(one), abs(other), 1)


def rounding_note(lowered: LoweredModel, difference: ReadingDifference, given: Collection[str]) -> str:
    """What a difference says of the numbers of a model, if it need be no error; ``given`` have a domain.

    The system does not round real numbers, and a datum may leave a domain that a user has given.
    """
    if difference.said:
        return f"In a random run {difference}." if set(given) - lowered.inputs.keys() else ""
    if not lowered.real:
        return ""
    return f"Real numbers are exact: the interpreter, which rounds them, differs {difference}."


__all__ = ["ReadingDifference", "Readings", "compared_readings", "interesting", "rounding_note"]
