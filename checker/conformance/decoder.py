"""What the charts see of a log: their inputs, step by step, as far as what they are made of is logged."""

from collections.abc import Callable, Mapping
from fractions import Fraction

from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.spec_model.abstraction.interface import Carriage, SignalView
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW, MeanOfTen
from rovercheck.spec_model.lang.system import TICK_MS

See = Callable[[LogBlock], Cells]


class InputDecoder:
    """Reads the inputs of the charts off the blocks of one log, from its first."""

    def __init__(self, vocabulary: Vocabulary, signals: frozenset[str], from_power_up: bool) -> None:
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
        return {name: see(block) for name, see in self._see.items()}


def _sample(sight: SignalView, _from_power_up: bool) -> See:
    return lambda block: block.values[sight.signal.name]


def _age(sight: SignalView, _from_power_up: bool) -> See:
    ages = _Ages()

    def see(block: LogBlock) -> Cells:
        stamps, now = block.values[sight.signal.name], block.values[NOW]
        return [None if t is None or s is None else ages[t - s] for t, s in zip(now, stamps, strict=True)]

    return see


class _Ages(dict[Raw, Raw]):
    """Raw ages by the milliseconds from a stamp to the clock, which may have wrapped in between."""

    def __missing__(self, ms: Raw) -> Raw:
        whole, rest = divmod(int(ms) % CLOCK, TICK_MS)
        self[ms] = age = Fraction(int(ms) % CLOCK, TICK_MS) if rest else whole
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
