"""What must hold of an implementation whatever it is given: a small TOML file, and what holds without one."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any

from rovercheck.checker.adapters.implementation import Value, Values
from rovercheck.spec_model.abstraction import Board, BoardSignal
from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

KEYS = ("step_seconds", "finite", "in_range", "ranges", "nonsense")
NONSENSE_KEYS = ("inputs", "steps", "required")
SLACK = 1e-6
"""By which a number may exceed its range: firmware computes in single precision."""


@dataclass(frozen=True)
class NonsenseRule:
    """Once an input of these has been nonsense in so many steps in a row, an output is as required."""

    inputs: tuple[str, ...]
    steps: int
    required: tuple[tuple[str, Value], ...]

    def __str__(self) -> str:
        wanted = " or ".join(f"{name} = {value:g}" for name, value in self.required)
        return f"{wanted} after {self.steps} steps of nonsense"


@dataclass(frozen=True)
class RobustnessRules:
    """No crash and an answer in time always; numbers, ranges and what nonsense leads to, as far as asked."""

    step_seconds: float = 2.0
    finite: bool = True
    in_range: bool = True
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    nonsense: tuple[NonsenseRule, ...] = ()


@dataclass(frozen=True)
class RuleBreach:
    """What does not hold, after a step (from 1): what is of one ``kind`` and ``where`` is one finding."""

    kind: str
    where: str
    says: str
    step: int


def is_nonsense(signal: BoardSignal, value: Value) -> bool:
    """Whether no sensor and no sender that works gives such a value."""
    if not isfinite(value):
        return True
    if isinstance(signal.domain.sort, Bool | Enum):
        return value != int(value) or int(value) not in signal.domain
    return not signal.low <= value <= signal.high


def breaches(
    board: Board, rules: RobustnessRules, inputs: Sequence[Values], outputs: Sequence[Values]
) -> Iterator[RuleBreach]:
    """What does not hold in the steps that were answered."""
    given = {s.name: s for s in board.inputs}
    held = [0] * len(rules.nonsense)
    for step, (at, answered) in enumerate(zip(inputs, outputs, strict=False), 1):
        for output in board.outputs:
            if output.name in answered:
                yield from _of_output(output.signal, answered[output.name], rules, step)
        for number, rule in enumerate(rules.nonsense):
            odd = any(is_nonsense(given[name], at[name]) for name in rule.inputs)
            held[number] = held[number] + 1 if odd else 0
            met = any(answered.get(name) == value for name, value in rule.required)
            if held[number] >= rule.steps and not met:
                yield RuleBreach("nonsense", str(rule), f"not {rule}", step)


def _of_output(signal: BoardSignal, value: Value, rules: RobustnessRules, step: int) -> Iterator[RuleBreach]:
    name = signal.name
    if not isfinite(value):
        if rules.finite:
            yield RuleBreach("no number", name, f"{name} is {value}", step)
        return
    if name in rules.ranges:
        low, high = rules.ranges[name]
        fits = low <= value <= high
    elif not rules.in_range:
        return
    elif isinstance(signal.domain.sort, Bool | Enum):
        fits = value == int(value) and int(value) in signal.domain
    else:
        fits = signal.low - SLACK <= value <= signal.high + SLACK
    if not fits:
        low, high = rules.ranges.get(name, (signal.low, signal.high))
        room = f"{low:g} to {high:g}" if high > low else str(signal.domain)
        yield RuleBreach("out of range", name, f"{name} is {value:g}, outside {room}", step)


def read_rules(file: Path, board: Board) -> RobustnessRules:
    """The rules of a file.  Raises ``ModelError`` for one that cannot be read or has no meaning."""
    try:
        found = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise ModelError(f"{file}: the rules cannot be read: {error.strerror}.") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ModelError(f"{file}: the rules are no TOML: {error}") from None
    return _RulesReader(file, board).rules(found)


@dataclass(frozen=True)
class _RulesReader:
    file: Path
    board: Board

    def rules(self, found: Mapping[str, Any]) -> RobustnessRules:
        self._known(found, KEYS)
        plain = RobustnessRules()
        ranges = {
            name: self._range(name, pair) for name, pair in self._table(found.get("ranges", {})).items()
        }
        written = found.get("nonsense", [])
        if not isinstance(written, list):
            raise self._wrong("nonsense is written [[nonsense]], once for each rule")
        return RobustnessRules(
            self._positive("step_seconds", found.get("step_seconds", plain.step_seconds)),
            self._truth("finite", found.get("finite", True)),
            self._truth("in_range", found.get("in_range", True)),
            ranges,
            tuple(self._nonsense(one) for one in written),
        )

    def _nonsense(self, written: object) -> NonsenseRule:
        table = self._table(written)
        self._known(table, NONSENSE_KEYS)
        inputs = [s.name for s in self.board.inputs]
        named = table.get("inputs", [])
        if not isinstance(named, list) or not named:
            raise self._wrong(f"nonsense: inputs = {named!r}; write the names of inputs in brackets")
        for name in named:
            if name not in inputs:
                raise self._wrong(
                    f"nonsense: {self.board.name} has no input {name!r}. {did_you_mean(name, inputs)}"
                )
        required = table.get("required", [])
        if not isinstance(required, list) or not required:
            raise self._wrong(
                'nonsense: required is missing; write ["OUTPUT = VALUE"], one of which must hold'
            )
        steps = int(self._positive("nonsense: steps", table.get("steps", 1)))
        return NonsenseRule(tuple(named), max(1, steps), tuple(self._equation(one) for one in required))

    def _equation(self, text: object) -> tuple[str, Value]:
        name, _, value = (part.strip() for part in str(text).partition("="))
        outputs = {o.name: o.signal for o in self.board.outputs}
        if name not in outputs:
            raise self._wrong(
                f"{text!r}: {self.board.name} has no output {name!r}. {did_you_mean(name, outputs)}"
            )
        try:
            raw = outputs[name].domain.raw(value)
        except (ModelError, ValueError):
            raise self._wrong(f"{text!r}: {value!r} is no value of {name}; write OUTPUT = VALUE") from None
        return name, raw

    def _range(self, name: str, pair: object) -> tuple[float, float]:
        outputs = [o.name for o in self.board.outputs]
        if name not in outputs:
            raise self._wrong(
                f"[ranges] {self.board.name} has no output {name!r}. {did_you_mean(name, outputs)}"
            )
        if not isinstance(pair, list) or len(pair) != 2 or not all(isinstance(v, int | float) for v in pair):
            raise self._wrong(f"[ranges] {name} = {pair!r}; write [LOWEST, HIGHEST]")
        return float(pair[0]), float(pair[1])

    def _known(self, table: Mapping[str, Any], keys: Sequence[str]) -> None:
        for key in table:
            if key not in keys:
                raise self._wrong(f"{key!r} has no meaning here. {did_you_mean(key, keys)}")

    def _table(self, written: object) -> Mapping[str, Any]:
        if not isinstance(written, dict):
            raise self._wrong(f"{written!r} has no meaning here; write a table")
        return written

    def _positive(self, key: str, written: object) -> float:
        if isinstance(written, bool) or not isinstance(written, int | float) or not written > 0:
            raise self._wrong(f"{key} = {written!r} is no number above 0")
        return float(written)

    def _truth(self, key: str, written: object) -> bool:
        if not isinstance(written, bool):
            raise self._wrong(f"{key} = {written!r}; write true or false")
        return written

    def _wrong(self, what: str) -> ModelError:
        return ModelError(f"{self.file}: {what if what[-1] in '.?' else what + '.'}")
