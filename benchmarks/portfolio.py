"""Every engine on every search of the rover: the measurements behind ``checker.verify.portfolio.order``.

    python -m benchmarks.portfolio [--seconds 20] [--jobs 2] [--system NAME]... [ID...]

Prints for each search its kind, its bits and, for each engine, the processor seconds it took and how many
of the goals it decided; then, for each kind of question, which engine decides how much in how little time.
A run that may not be a shortest one is counted apart (after a +), for it is searched for again.
"""

import argparse
import resource
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.engines import Limits, engines
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import GrantedTime, Order, Pool
from rovercheck.checker.results.verdict import Open
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.portfolio import Callbacks, PortfolioQuestion, answers
from rovercheck.checker.verify.portfolio.question import conclusive
from rovercheck.checker.verify.portfolio.shape import shape
from rovercheck.checker.verify.tasks import Task, tasks
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import Property, Unbounded
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.rover import systems

MEMORY = 2 << 30


@dataclass(frozen=True)
class Measured:
    """What one engine did with one search."""

    kind: str
    bits: int
    goals: int
    decided: int
    reached: int
    seconds: float


class Measure:
    """Puts the question of one search to one engine, in a child process."""

    def __init__(self, known: Mapping[str, System], seconds: float) -> None:
        self._known = known
        self._limits = Limits(seconds=seconds, memory=MEMORY)

    def __call__(self, send: Send, system: str, properties: tuple[Property, ...], engine: str) -> None:
        asked = reduce(lowered(self._known[system]), properties)
        question = PortfolioQuestion(asked.system, tuple(g.var for g in asked.goals))
        looks = shape(question)
        send(GrantedTime(self._limits.seconds))
        began = processor()
        found = [a for a, _ in answers(question, engine, self._limits, Callbacks()).values()]
        took = processor() - began
        decided = sum(conclusive(a) for a in found)
        reached = sum(not isinstance(a, Open) for a in found) - decided
        send(Measured(looks.kind, looks.bits, len(found), decided, reached, took))


def processor() -> float:
    """Processor seconds of this process and of the children it has seen the end of."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(used.ru_utime + used.ru_stime for used in both)


def measured(
    todo: Sequence[Task], seconds: float, jobs: int
) -> Iterator[tuple[Task, dict[str, Measured | str]]]:
    """For each search what each engine did, or why it did not."""
    names = tuple(engines())
    orders = [Order((t.system.name, t.properties, name), t.system.name) for t in todo for name in names]
    found: list[dict[str, Measured | str]] = [{} for _ in todo]
    for event in Pool(jobs, Measure, (systems(), seconds), 2 * MEMORY).run(orders):
        row, name = found[event.number // len(names)], names[event.number % len(names)]
        if isinstance(event.message, Measured):
            row[name] = event.message
        if event.done:
            row.setdefault(name, event.failure or "nothing")
            if len(row) == len(names):
                yield todo[event.number // len(names)], row


def line(task: Task, row: Mapping[str, Measured | str]) -> str:
    """One search in one line."""
    known = next((m for m in row.values() if isinstance(m, Measured)), None)
    head = f"{known.kind if known else '?':>6} {known.bits if known else 0:>4} bits"
    return f"{head} {task.title:<44}" + "".join(f" {n} {cell(row[n])}" for n in engines())


def cell(one: Measured | str) -> str:
    """``0.31s 4+1/5``, or why there is nothing."""
    if isinstance(one, str):
        return f"[{one[:30]}]"
    return f"{one.seconds:.2f}s {one.decided}{f'+{one.reached}' if one.reached else ''}/{one.goals}"


def summary(rows: Sequence[Mapping[str, Measured | str]]) -> Iterator[str]:
    """For each kind and engine: searches decided wholly, the fastest of all, goals, seconds."""
    yield f"{'kind':>6} {'engine':<12} {'whole':>6} {'fastest':>8} {'goals':>6} {'of':>6} {'seconds':>9}"
    kinds = sorted({m.kind for row in rows for m in row.values() if isinstance(m, Measured)})
    for kind in kinds:
        own = [{n: m for n, m in row.items() if isinstance(m, Measured) and m.kind == kind} for row in rows]
        for name in engines():
            mine = [row[name] for row in own if name in row]
            whole = [row for row in own if name in row and row[name].decided == row[name].goals]
            first = sum(fastest(row) == name for row in whole)
            decided, goals = sum(m.decided for m in mine), sum(m.goals for m in mine)
            seconds = sum(m.seconds for m in mine)
            yield f"{kind:>6} {name:<12} {len(whole):>6} {first:>8} {decided:>6} {goals:>6} {seconds:>9.1f}"


def fastest(row: Mapping[str, Measured]) -> str:
    """The engine that decided a whole search in the least time."""
    return min((m.seconds, n) for n, m in row.items() if m.decided == m.goals)[1]


def main() -> None:
    options = argparse.ArgumentParser(prog="benchmarks.portfolio")
    options.add_argument("ids", nargs="*")
    options.add_argument("--seconds", type=float, default=20.0)
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--system", action="append", default=[])
    chosen = options.parse_args()
    asked = [
        p
        for p in catalogue().values()
        if (p.id in chosen.ids if chosen.ids else not p.costly)
        and (p.on in chosen.system or not chosen.system)
        and not isinstance(p.form, Unbounded)
    ]
    rows = []
    for task, row in measured(list(tasks(asked, systems())), chosen.seconds, chosen.jobs):
        rows.append(row)
        print(line(task, row), flush=True)
    print("\n".join(summary(rows)))


if __name__ == "__main__":
    from benchmarks import portfolio  # so that the children find its classes by a name they can import

    portfolio.main()
