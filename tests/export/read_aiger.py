"""A reader of AIGER 1.9, ASCII and binary, written from the report on the format."""

import re
from dataclasses import dataclass, field

from tests.export.reading import Values


@dataclass
class Circuit:
    """Literals as in the file; ``state`` holds the value of each latch, by literal."""

    inputs: list[int]
    latches: list[tuple[int, int, int]]
    ands: list[tuple[int, int, int]]
    bads: list[int]
    constraints: list[int]
    names: dict[str, str]
    comment: list[str]
    state: dict[int, int] = field(default_factory=dict)
    frozen: Values = field(default_factory=dict)

    @property
    def bad(self) -> tuple[str, ...]:
        return tuple(self.names[f"b{n}"] for n in range(len(self.bads)))

    def start(self, frozen: Values) -> None:
        self.state = {own: init for own, _, init in self.latches}
        self.frozen = {f"{name} at the start": value for name, value in frozen.items()}

    def tick(self, inputs: Values) -> tuple[bool, dict[str, bool]]:
        at = {0: 0, **self.state}
        for n, literal in enumerate(self.inputs):
            at[literal] = _bit(self.names[f"i{n}"], inputs, self.frozen)

        def value(literal: int) -> int:
            return at[literal & ~1] ^ literal & 1

        for own, a, b in self.ands:
            at[own] = value(a) & value(b)
        bad = {name: bool(value(b)) for name, b in zip(self.bad, self.bads, strict=True)}
        allowed = all(value(c) for c in self.constraints)
        if allowed:
            self.state = {own: value(following) for own, following, _ in self.latches}
        return allowed, bad


def _bit(name: str, inputs: Values, frozen: Values) -> int:
    """A bit of a variable named as in ``speed[3]`` or ``speed[3] at the start``."""
    var, number, at_start = re.fullmatch(r"(.*)\[(\d+)\]( at the start)?", name).groups("")  # type: ignore[union-attr]
    value = frozen[f"{var} at the start"] if at_start else inputs[var]
    return value >> int(number) & 1


class _Lines:
    def __init__(self, data: bytes) -> None:
        self.data, self.at = data, 0

    def line(self) -> str:
        end = self.data.index(b"\n", self.at)
        text, self.at = self.data[self.at : end].decode(), end + 1
        return text

    def numbers(self) -> list[int]:
        return [int(word) for word in self.line().split()]

    def delta(self) -> int:
        value = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value


def read(data: bytes) -> Circuit:
    """The circuit of a file.  Raises ``AssertionError`` for what the format forbids."""
    lines = _Lines(data)
    kind, *counts = lines.line().split()
    most, inputs, latches, outputs, ands, bads, constraints = map(int, counts)
    assert kind in ("aag", "aig") and outputs == 0 and most == inputs + latches + ands
    binary = kind == "aig"
    ins = [2 * n + 2 if binary else lines.numbers()[0] for n in range(inputs)]
    registers = []
    for n in range(latches):
        own = [2 * (inputs + n) + 2] if binary else []
        literal, following, *init = own + lines.numbers()
        assert init in ([], [0], [1])
        registers.append((literal, following, init[0] if init else 0))
    bad = [lines.numbers()[0] for _ in range(bads)]
    held = [lines.numbers()[0] for _ in range(constraints)]
    gates = []
    for n in range(ands):
        if binary:
            own_literal = 2 * (inputs + latches + n) + 2
            high = own_literal - lines.delta()
            gates.append((own_literal, high, high - lines.delta()))
        else:
            own_literal, high, low = lines.numbers()
            gates.append((own_literal, high, low))
    assert all(own > high >= low >= 0 for own, high, low in gates)
    names, comment = _rest(lines)
    return Circuit(ins, registers, gates, bad, held, names, comment)


def _rest(lines: _Lines) -> tuple[dict[str, str], list[str]]:
    rest = lines.data[lines.at :].decode().splitlines()
    split = rest.index("c")
    names = dict(line.split(" ", 1) for line in rest[:split])
    assert len(names) == split
    return names, rest[split + 1 :]
