"""``rovercheck mutate --record-kills``: for each property a fault that it notices."""

from collections.abc import Collection, Generator, Mapping
from contextlib import closing

from rovercheck.checker.commands.check.further import needs_mutant
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.output import counted, err, out, wrapped, write
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.engines import Limits
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_runs import KILLS, KeptRun, file_of, read, text
from rovercheck.checker.mutate.kills import Kill, kills, still
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.process.pool import Jobs, Order, Pool, cores
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.searches import SLACK
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System

SHOWN = 40
"""Properties that are named, of those for which no fault was found."""


def record_kills(model: Model, limits: Limits, jobs: Jobs | None, about: Collection[str] = ()) -> Exit:
    """Look for a fault that each proved demand notices, and keep it with the run that shows it.

    Only demands about the systems ``about``, if these are named.  What is recorded is gone through again;
    only demands of which it shows nothing any more are looked at.  Raises ``UsageError`` where
    the file cannot be written, ``ModelError`` where what is recorded cannot be read.
    """
    place, premises = file_of(model, KILLS), read(file_of(model))
    known = {id: kept for id, kept in read(place, KILLS).items() if id in model.properties}
    chosen = {pick("system", name, model.systems).name for name in about}
    asked = {name: of for name, of in demands_of(model).items() if not chosen or name in chosen}
    total = [p.id for properties in asked.values() for p in properties]
    found = {id: kept for id, kept in known.items() if id not in total}
    whole = True
    try:
        for name, one in _found(model, premises, known, asked, limits, jobs):
            if one is None:
                whole = False
                found = {p.id: known[p.id] for p in asked[name] if p.id in known} | found
            else:
                found |= {id: KeptRun(name, kill.run, kill.mutant) for id, kill in one.items()}
    except KeyboardInterrupt:
        found = known | found
        err.print("Interrupted: what was found so far is kept.")
        return Exit.INTERRUPTED
    finally:
        write(text(found, KILLS), place)
    left = [id for id in total if id not in found]
    demands = counted(len(total), "proved demand", "proved demands")
    out.print(f"{len(total) - len(left)} of {demands} kill a mutant of the charts.")
    if left:
        more = f" and {len(left) - SHOWN} more" if len(left) > SHOWN else ""
        out.print(wrapped(f"None was found for {', '.join(left[:SHOWN])}{more}.", 4), markup=False)
    return Exit.AS_EXPECTED if whole else Exit.INCONCLUSIVE


def demands_of(model: Model) -> dict[str, list[Property]]:
    """The demands that are proved, by system; those about what happens some day are left out."""
    found: dict[str, list[Property]] = {}
    for prop in model.stated().values():
        if model.expected(prop.id).verdict == "proved" and needs_mutant(prop):
            found.setdefault(prop.on, []).append(prop)
    return found


def _found(
    model: Model,
    premises: Mapping[str, KeptRun],
    known: Mapping[str, KeptRun],
    asked: Mapping[str, list[Property]],
    limits: Limits,
    jobs: Jobs | None,
) -> Generator[tuple[str, dict[str, Kill] | None], None, None]:
    """The kills system by system, as they are found; None of one that was not looked at whole."""
    orders, names = [], list(asked)
    for name in names:
        system = model.systems[name]
        runs = {id: k.run for id, k in premises.items() if k.system in (name, system.concrete)}
        kept = {p.id: Kill(known[p.id].mutant, known[p.id].run) for p in asked[name] if p.id in known}
        orders.append(Order((system, tuple(asked[name]), kept, runs, limits.seconds or 60.0), name))
    pool = Pool(jobs or cores(), _Killing, (), limits.memory + SLACK)
    done = 0
    with ProgressLine(err) as line, closing(pool.run(orders)) as events:
        for event in events:
            if isinstance(event.message, dict):
                yield names[event.number], event.message
            if event.done:
                if event.failure:
                    err.print(f"{names[event.number]}: not looked at whole: {event.failure}", markup=False)
                    yield names[event.number], None
                done += 1
                line.show(f"{done}/{len(names)} systems done")


class _Killing:
    """Looks for kills in one system after the other, in a child."""

    def __call__(
        self,
        send: Send,
        system: System,
        properties: tuple[Property, ...],
        kept: Mapping[str, Kill],
        premises: Mapping[str, Run],
        seconds: float,
    ) -> None:
        good = still(system, properties, kept)
        send(good)
        left = [p for p in properties if p.id not in good]
        for found in kills(system, left, list(premises.values()), seconds, premises):
            send(found)


__all__ = ["demands_of", "record_kills"]
