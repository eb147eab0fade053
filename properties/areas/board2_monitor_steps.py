"""What one step makes of a monitor of Board 2: its status, the stamps it sees, their gaps [design].

A monitor looks at its stamp in every step that leaves its status as it is, but for the first step (G2, G4).
The gaps are the times between stamps that it saw, in steps of 20 ms; the time until it looked first is none.
Its status is decided where of the gaps only a row of long or of short ones is known, which has all its runs.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from rovercheck.properties.document.sources import BLE, IMU, RX, SUP, Source, silent
from rovercheck.properties.forms import Property, always, costly
from rovercheck.properties.past import STEPPED
from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.domain import Bool, Domain, boolean, integer
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var, all_of, const, implies, ite, var
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import held, maximum, minimum, once, previous

STEP, GAPS = 20, 10
"""Milliseconds of a step, and the gaps of which the mean is asked."""
COVERS = ["B2-FLT-01"]


@dataclass(frozen=True)
class _Monitor:
    """The monitor of a source: what it keeps, and which looks find a new stamp.

    ``longest`` is the number of steps that stands for all longer gaps.
    """

    source: Source
    longest: int

    def kept(self, what: str, values: Domain) -> Var:
        return var(f"{self.source.update.name.removesuffix('update')}{what}", values, hidden=True)

    @property
    def steps(self) -> Domain:
        return integer(0, self.longest)

    @property
    def since(self) -> Var:
        """From the stamp to this step."""
        return self.kept("since", self.steps)

    @property
    def unseen(self) -> Var:
        """From the stamp that the last look saw to the one that none has seen yet."""
        return self.kept("pending", self.steps)

    @property
    def number(self) -> Var:
        return self.kept("gaps", integer(0, GAPS))

    @property
    def gap(self) -> Expr:
        """From the stamp that the last look saw to that of this step."""
        grown = _before(self.unseen) + ite(self.source.update, _before(self.since) + 1, 0)
        return minimum(grown, self.longest)

    @property
    def looks(self) -> Expr:
        return STEPPED & (self.source.status == previous(self.source.status))

    @property
    def finds(self) -> Expr:
        return self.looks & previous(once(self.looks)) & (self.gap > 0)


def _before(value: Var) -> Expr:
    """The value one step ago; before the first step there is no time, no gap and no long mean."""
    return ite(STEPPED, previous(value), FALSE if isinstance(value.sort, Bool) else const(0))


def _status(id: str, source: Source, what: str, recovery: int) -> Property:
    """``recovery`` is for how many steps the mean of a critical source must be short."""
    status, (fine, slow, gone) = source.status, source.levels
    was, late, long = previous(status), silent(source), previous(source.deg)

    def returns(level: str, steps: int, at_once: Expr) -> Expr:
        short = previous(held((status == level) & ~source.deg, for_=steps * ticks))
        return choose("E29", {"HYST": short, "INSTANT": at_once})

    mended = returns(slow, 50, ~long)
    return always(
        id, f"{what} is OK at first; a long mean degrades it, else silence makes it critical; it returns "
        f"after a short mean for more than 1 s, from critical for more than {recovery / 50:g} s.",
        that=all_of(
            STEPPED | (status == fine),
            implies(STEPPED & (was == fine), (status == slow) == long),
            implies(STEPPED & (was == fine) & ~long, (status == gone) == late),
            implies(was == slow, (status == fine) == mended),
            implies((was == slow) & ~mended, (status == gone) == late),
            implies(was == gone, (status == fine) == returns(gone, recovery, ~late)),
            implies(was == gone, status != slow),
        ),
        covers=COVERS, on=f"monitors_2_{source.region}", interpretations=["E29"],
    )  # fmt: skip


def _stamps(id: str, monitor: _Monitor, what: str, on: str) -> Property:
    since, longest = monitor.since, monitor.longest
    return always(
        id, f"{what}: the time since its stamp, and from the one seen last to one not yet seen, are counted "
        f"up to {STEP * longest} ms.",
        that=all_of(
            since == ite(monitor.source.update, 0, minimum(_before(since) + 1, longest)),
            monitor.unseen == ite(monitor.looks, 0, monitor.gap),
            monitor.kept("asked", boolean) == once(monitor.looks),
        ),
        covers=COVERS, on=on,
    )  # fmt: skip


def _counted(monitor: _Monitor) -> Expr:
    before = _before(monitor.number)
    return monitor.number == ite(monitor.finds, minimum(before + 1, GAPS), before)


def _enough(monitor: _Monitor) -> Expr:
    return monitor.number >= choose("E26", {"FILL": const(1), "WAIT-10": const(GAPS)})


def _rows(source: Source, what: str, recovery: int) -> Iterator[Property]:
    """What is known of the gaps where only a row of long or of short ones is remembered."""
    region = source.region
    on, most = f"monitors_2_{region}", source.mean // STEP
    monitor = _Monitor(source, most + 1)
    yield _status(f"PB2-70-{region}", source, what, recovery)
    yield _stamps(f"PB2-71-{region}", monitor, what, on)
    row, number = monitor.kept("row", integer(-GAPS, GAPS)), monitor.number
    before = _before(row)
    longer, shorter = minimum(maximum(before, 0) + 1, GAPS), maximum(minimum(before, 0) - 1, -GAPS)
    yield always(
        f"PB2-72-{region}", f"{what}: a look that finds another stamp makes the row of gaps above or up to "
        f"{source.mean} ms longer, or begins one of the other kind.",
        that=_counted(monitor)
        & (row == ite(monitor.finds, ite(monitor.gap > most, longer, shorter), before)),
        covers=COVERS, on=on,
    )  # fmt: skip
    free = monitor.kept("mean_slow", boolean)
    yield always(
        f"PB2-73-{region}", f"{what}: its mean is long if all gaps on record are, not if none is, and is "
        "asked only by a look that finds another stamp.",
        that=source.deg == ite(
            monitor.finds,
            _enough(monitor) & ((row >= number) | ((row > -number) & free)),
            _before(source.deg),
        ),
        covers=COVERS, on=on, interpretations=["E26"],
    )  # fmt: skip


def _gaps(source: Source, what: str) -> Iterator[Property]:
    """The ten gaps themselves.  With nine of one step the longest one that is counted makes the mean long."""
    region = source.region
    on = f"monitors_2_{region}_exact"
    monitor = _Monitor(source, GAPS * source.mean // STEP - (GAPS - 1) + 1)
    yield _stamps(f"PB2-74-{region}", monitor, what, on)
    last = [monitor.kept(f"gap{i}", monitor.steps) for i in range(1, GAPS + 1)]
    yield always(
        f"PB2-75-{region}", f"{what}: a look that finds another stamp adds its gap to the last nine; nothing "
        "else changes the gaps on record.",
        that=all_of(
            _counted(monitor),
            *(
                this == ite(monitor.finds, newer, _before(this))
                for this, newer in zip(last, (monitor.gap, *map(_before, last)), strict=False)
            ),
        ),
        covers=COVERS, on=on,
    )  # fmt: skip
    if source is IMU:
        return  # too hard a sum for all engines: five times as many steps as gaps
    total: Expr = sum(last[1:], start=last[0])
    yield always(
        f"PB2-76-{region}", f"{what}: its mean is long exactly if the gaps on record, ten or fewer, are "
        f"longer than {source.mean} ms on average.",
        that=source.deg == _enough(monitor) & (total > monitor.number * (source.mean // STEP)),
        covers=COVERS, on=on, interpretations=["E26"],
    )  # fmt: skip


PB2_70_SUP, PB2_71_SUP, PB2_72_SUP, PB2_73_SUP = _rows(SUP, "The supervisor of Board 1", recovery=100)
PB2_70_BLE, PB2_71_BLE, PB2_72_BLE, PB2_73_BLE = _rows(BLE, "The joystick link", recovery=50)
PB2_70_IMU, PB2_71_IMU, PB2_72_IMU, PB2_73_IMU = _rows(IMU, "The IMU", recovery=50)
PB2_70_RX, PB2_71_RX, PB2_72_RX, PB2_73_RX = _rows(RX, "The reception from Board 1", recovery=50)
PB2_74_SUP, PB2_75_SUP, PB2_76_SUP = map(costly, _gaps(SUP, "The supervisor of Board 1"))
PB2_74_BLE, PB2_75_BLE, PB2_76_BLE = map(costly, _gaps(BLE, "The joystick link"))
PB2_74_IMU, PB2_75_IMU = map(costly, _gaps(IMU, "The IMU"))
PB2_74_RX, PB2_75_RX, PB2_76_RX = map(costly, _gaps(RX, "The reception from Board 1"))
