"""What the charts see of a log: their inputs, step by step, as far as what they are made of is logged."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.spec_model.abstraction.interface import BoardInterface, Carriage, SignalView
from rovercheck.spec_model.abstraction.readings import StampReading, StampsTaken
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW, MeanOfTen

See = Callable[[LogBlock], Cells]


class InputDecoder:
    """Reads the inputs of the charts off the blocks of one log, from its first."""

    def __init__(self, vocabulary: Vocabulary, signals: frozenset[str], from_power_up: bool) -> None:
        taken = vocabulary.board.interface.taken
        self._taken = _Taken(taken, from_power_up) if taken else None
        self._records = _SharedRecords(vocabulary.board.interface, from_power_up)
        self._see: dict[str, See] = {}
        for name, sight in vocabulary.sights.items():
            if sight.signal.name in signals and (sight.how is not Carriage.AGE or NOW in signals):
                self._see[name] = _SEES[sight.how](sight, from_power_up)

    @property
    def seen(self) -> frozenset[str]:
        """The inputs of the charts that are known."""
        return frozenset(self._see)

    def decode(self, block: LogBlock) -> dict[str, Cells]:
        """The raw values of the known inputs, row by row; ``None`` where they are not known."""
        block = block if self._taken is None else self._taken.block(block)
        seen = {name: see(block) for name, see in self._see.items()}
        return {**seen, **self._records.decode(block)} if self._records.views else seen


class _Taken:
    """Stamps as a variant of the board takes them, as far as they are known behind gaps."""

    def __init__(self, readings: Sequence[StampReading], from_power_up: bool) -> None:
        self._taken = StampsTaken(readings)
        if not from_power_up:
            self._gap()

    def block(self, block: LogBlock) -> LogBlock:
        """The rows with the stamps that are taken."""
        names = [name for name in self._taken.names if name in block.values]
        found: dict[str, Cells] = {name: [] for name in names}
        clock = block.values.get(NOW, [None] * len(block.missing))
        for row, (missing, now) in enumerate(zip(block.missing, clock, strict=True)):
            if missing:
                self._gap()
            stamps = {name: _whole(block.values[name][row]) for name in names}
            taken = self._taken.step(stamps, _whole(now))
            for name in names:
                found[name].append(taken[name])
        return replace(block, values={**block.values, **found})

    def _gap(self) -> None:
        """Steps that were not recorded, be it one or many."""
        self._taken.step({}, None)


def _whole(cell: Raw | None) -> int | None:
    return None if cell is None else int(cell)


class _SharedRecords:
    """Means of stamps that go into one record, one after the other in each step."""

    def __init__(self, interface: BoardInterface, from_power_up: bool) -> None:
        records = interface.records() if interface.taken else {}
        own = [id(record) for record in records.values()]
        every = [(v, records[v.var.name]) for v in interface.by_carriage[Carriage.SLOW] if records]
        self.views = [(v, record) for v, record in every if own.count(id(record)) > 1]
        self._known = from_power_up

    def decode(self, block: LogBlock) -> dict[str, Cells]:
        """Whether the means are too long; not known after a step or cell that was not recorded."""
        found: dict[str, Cells] = {view.var.name: [] for view, _ in self.views}
        for row, missing in enumerate(block.missing):
            for view, record in self.views:
                stamp = block.values[view.signal.name][row] if view.signal.name in block.values else None
                self._known = self._known and stamp is not None and not missing
                known = self._known and stamp is not None
                found[view.var.name].append(int(record.step(int(stamp or 0))) if known else None)
        return found


def _sample(sight: SignalView, _from_power_up: bool) -> See:
    return lambda block: block.values[sight.signal.name]


def _age(sight: SignalView, _from_power_up: bool) -> See:
    ages = _Ages(sight)

    def see(block: LogBlock) -> Cells:
        stamps, now = block.values[sight.signal.name], block.values[NOW]
        return [None if t is None or s is None else ages[t - s] for t, s in zip(now, stamps, strict=True)]

    return see


class _Ages(dict[Raw, Raw]):
    """Raw ages by the milliseconds from a stamp to the clock, which may have wrapped in between."""

    def __init__(self, sight: SignalView) -> None:
        self._sight = sight

    def __missing__(self, ms: Raw) -> Raw:
        self[ms] = age = self._sight.age(int(ms) % CLOCK, 0)
        return age


class _Advance:
    """By how much a stamp has advanced since the step before, in ms; ``update``: only whether it has."""

    def __init__(self, sight: SignalView, from_power_up: bool) -> None:
        self._name = sight.signal.name
        self._only_whether = sight.how is Carriage.UPDATE
        self._before: Raw | None = 0 if from_power_up else None

    def __call__(self, block: LogBlock) -> Cells:
        before, found = self._before, list[Raw | None]()
        for missing, stamp in zip(block.missing, block.values[self._name], strict=True):
            if stamp == before:
                found.append(None if stamp is None else 0)
            elif stamp is None or before is None or missing:
                found.append(None)
            else:
                found.append(1 if self._only_whether else int(stamp - before) % CLOCK)
            before = stamp
        self._before = before
        return found


class _Slow:
    """Whether the mean of the last ten intervals is too long; unknown until ten were seen without a gap."""

    def __init__(self, sight: SignalView, from_power_up: bool) -> None:
        self._name = sight.signal.name
        self._mean_ms = sight.mean_ms
        self._mean = MeanOfTen(self._mean_ms)
        self._before: Raw | None = 0
        self._slow: Raw | None = 0
        self._wanted = 0 if from_power_up else 11

    def __call__(self, block: LogBlock) -> Cells:
        rows = zip(block.missing, block.values[self._name], strict=True)
        return [
            self._slow if stamp == self._before and not missing and self._wanted <= 0
            else self._row(missing, stamp)
            for missing, stamp in rows
        ]  # fmt: skip

    def _row(self, missing: int, stamp: Raw | None) -> Raw | None:
        if missing or stamp is None:
            self._mean, self._wanted, self._slow = MeanOfTen(self._mean_ms), 11, None
        if stamp is not None and stamp != self._before:
            self._wanted -= 1
            slow = int(self._mean.step(int(stamp)))
            self._slow = None if self._wanted > 0 else slow
        self._before = stamp
        return self._slow if self._wanted <= 0 else None


_SEES: Mapping[Carriage, Callable[[SignalView, bool], See]] = {
    Carriage.SAMPLE: _sample,
    Carriage.AGE: _age,
    Carriage.UPDATE: _Advance,
    Carriage.ADVANCE: _Advance,
    Carriage.SLOW: _Slow,
}
