"""Random texts of charts in both languages: guards, actions, functions.

Whole numbers have types that end, and real numbers are multiples of 0.25 between two ends, so that a chart
has finitely many states.  ``log`` mixes in the number of every action, so that their order is seen in it.
"""

from dataclasses import dataclass, field
from random import Random
from re import sub
from typing import Literal

Language = Literal["MATLAB", "C", "C with bit operations"]
WHOLE = ("int8", "uint8", "int16", "uint16", "int32", "uint32")
INPUTS = {"u": "int8", "k": "uint8", "on": "boolean", "x": "double", "turn": "uint8"}
EVENTS = ("E", "F")
MEMBERS = ("Slow", "Fast", "Off")


@dataclass
class Texts:
    """Writes texts for one chart; ``states`` are names that ``in`` may ask for."""

    random: Random
    language: Language
    kinds: dict[str, str]
    """The types of whole numbers that are written, by name."""
    states: list[str] = field(default_factory=list)
    functions: list[str] = field(default_factory=list)
    input_events: list[str] = field(default_factory=list)
    pairs: bool = False
    """Whether there is a function of two results."""
    members: bool = False
    array: bool = False
    numbers: int = 0
    sends: int = 2
    """Actions that send an event, which are as many copies of the chart in its step."""

    @property
    def c(self) -> bool:
        return self.language != "MATLAB"

    def one(self, *some: str) -> str:
        return self.random.choice(some)

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def number(self, low: int, high: int) -> int:
        return self.random.randint(low, high)

    # --- values --------------------------------------------------------------------------------------------

    def whole(self, depth: int = 2) -> str:
        """A whole number of some type, or a literal."""
        name = self.random.choice([*self.kinds, "u", "k"])
        if depth == 0:
            return name
        literal, inner = self.number(0, 9), self.whole(depth - 1)
        some = [
            lambda: name, lambda: f"{inner} + {literal}", lambda: f"{inner} - {literal}",
            lambda: f"({inner}) * {self.number(2, 5)}", lambda: f"({inner}) / {self.number(1, 7)}",
            lambda: f"-({inner})", lambda: f"{self.one(*WHOLE)}({inner})", lambda: f"abs({inner})",
            lambda: f"{self.one('min', 'max')}({inner}, {literal})", lambda: self.remainder(inner),
            lambda: f"{self.one(*WHOLE)}({self.condition(1)})", self.element,
        ]  # fmt: skip
        if self.functions:
            some.append(lambda: f"{self.random.choice(self.functions)}({inner})")
        if self.language == "C with bit operations":
            some += [
                lambda: f"({inner} {self.one('&', '|', '^')} {literal})",
                lambda: f"(k {self.one('<<', '>>')} {self.number(0, 3)})", lambda: "~k",
            ]  # fmt: skip
        elif not self.c:
            some += [
                lambda: f"{self.one('bitand', 'bitor', 'bitxor')}(k, uint8({literal}))",
                lambda: f"bitshift(k, {self.number(-2, 3)})", lambda: f"({inner}) / {self.number(1, 7)}.5",
                lambda: f"({inner}) * 0.5", lambda: f"int16({self.real(1)})", lambda: "bitcmp(k)",
                lambda: f"sign({inner})", lambda: f"bitget(k, {self.number(1, 8)})",
            ]  # fmt: skip
        return self.random.choice(some)()

    def remainder(self, inner: str) -> str:
        """What a division leaves."""
        by = self.number(1, 9)
        if self.c:
            return f"(({inner}) %% {by})"
        return f"{self.one('mod', 'rem')}({inner}, {by})"

    def element(self) -> str:
        """An element of the array, at a constant or at a variable place."""
        if not self.array:
            return "k"
        if self.c:
            return self.one("list[0]", "list[2]", "list[k %% 3]")
        return self.one("list(1)", "list(end)", "list(mod(k, 3) + 1)", "sum(list)", "max(list)")

    def real(self, depth: int = 2) -> str:
        """A multiple of 0.25."""
        if depth == 0:
            return self.one("x", "y")
        inner = self.real(depth - 1)
        return self.one(
            "x", "y", f"{inner} + 0.25", f"{inner} - 1.5", f"-({inner})", f"abs({inner})", f"floor({inner})",
            f"2 * ({inner})", "double(u)", "1.75",
        )  # fmt: skip

    def condition(self, depth: int = 2) -> str:
        """A truth value that no time is in."""
        some = [
            lambda: "on", lambda: f"u {self.compare()} {self.number(-2, 2)}",
            lambda: f"k {self.compare()} {self.number(0, 4)}", lambda: f"x {self.compare()} 0.25",
            lambda: f"{self.whole(1)} {self.compare()} {self.number(0, 9)}", lambda: "flag",
        ]  # fmt: skip
        if self.states:
            some.append(lambda: f"in({self.random.choice(self.states)})")
        if self.members:
            some.append(lambda: f"mode == {self.one('Gear.', '')}{self.one(*MEMBERS)}")
        if depth:
            some += [
                lambda: f"({self.condition(depth - 1)} {self.one('&&', '||')} {self.condition(depth - 1)})",
                lambda: f"{'!' if self.c else '~'}({self.condition(depth - 1)})",
            ]  # fmt: skip
        return self.random.choice(some)()

    def compare(self) -> str:
        return self.one("<", ">", "<=", ">=", "==", "!=" if self.c else "~=")

    # --- guards --------------------------------------------------------------------------------------------

    def timed(self) -> str:
        """A condition on times, counts or changes."""
        n, unit = self.number(1, 4), self.one("tick", "sec")
        limit = str(n) if unit == "tick" else f"0.{n}"
        name = self.one("after", "before", "at", "every")
        return self.one(
            f"{name}({limit}, {unit})", f"after({n * 100}, msec)",
            f"temporalCount(tick) {self.compare()} {n}",
            f"elapsed(sec) {self.one('<', '>=', '>')} 0.{n}", f"count({self.condition(0)}) >= {n}",
            f"duration({self.condition(0)}) {self.one('>', '>=')} 0.{n}",
            f"duration({self.condition(0)}, msec) >= {n * 100}", f"temporalCount(E) > {self.number(0, 2)}",
            f"hasChanged({self.one('u', 'k', 'on', 'x', *self.kinds)})",
            f"hasChangedTo(u, {self.number(-1, 1)})",
            f"hasChangedFrom(k, {self.number(0, 2)})", f"{self.one('rising', 'falling', 'crossing')}(u)",
        )  # fmt: skip

    def event(self) -> str:
        """An event, or a time that is one."""
        n = self.number(1, 3)
        names = [*EVENTS, *self.input_events]
        return self.random.choice([
            *names, *names, "E | F", f"{self.one('after', 'before', 'at', 'every')}({n}, {self.one(*names)})",
            f"after({n}, tick)", f"every({n + 1}, tick)", f"after(0.{n}, sec)",
        ])  # fmt: skip

    def label(self, always: bool = False, timed: bool = True) -> str:
        """The label of a transition, with a guard unless it is always valid."""
        parts = []
        if not always:
            if timed and self.chance(0.35):
                parts.append(self.event())
            if not parts or self.chance(0.3):
                guard = self.timed() if timed and self.chance(0.4) else self.condition()
                parts.append(f"[{guard}]")
        if self.chance(0.45):
            parts.append(f"{{{self.actions(1)}}}")
        if self.chance(0.4):
            parts.append(f"/ {{{self.actions(1)}}}" if self.chance(0.5) else f"/ {self.actions(1)}")
        return " ".join(parts)

    # --- actions -------------------------------------------------------------------------------------------

    def note(self) -> str:
        """An action that is seen in ``log``, with a number of its own."""
        self.numbers += 1
        if self.c:
            return f"log = (log * 31 + {self.numbers}) %% 9973;"
        return f"log = mod(log * 31 + {self.numbers}, 9973);"

    def actions(self, most: int = 2, sends: bool = True) -> str:
        """Some actions, of which the first is seen."""
        found = [self.note()]
        for _ in range(self.number(0, most)):
            found.append(self.send() if sends and self.chance(0.12) and self.may_send() else self.action())
        if len(found) > 1 and self.chance(0.5):
            found.append(self.note())
        return " ".join(found)

    def action(self, depth: int = 1) -> str:
        """One action without events."""
        name = self.random.choice(list(self.kinds))
        some = [
            lambda: f"{name} = {self.whole()};",
            lambda: f"flag = {self.condition()};",
            self.note,
        ]
        if not self.c:
            some += [
                lambda: f"y = max(min({self.real()}, 4), -4);", lambda: f"{name} = {self.number(-300, 300)};",
                lambda: f"flag = {self.timed()};",
                lambda: f"{name} = {self.one('temporalCount(tick)', 'u')};",
            ]  # fmt: skip
        else:
            some += [
                lambda: f"{name}{self.one('++', '--', ' += 3', ' -= 2', ' *= 2')};",
                lambda: f"y = {self.one('x', 'x + 0.25', '-x', '1.5')};",
            ]  # fmt: skip
        if self.pairs:
            some.append(
                lambda: f"[{self.one('a', 'b', '~')}, {self.one('g', 'h')}] = pair({self.one('u', 'k')}, k);"
            )
        if self.members:
            some.append(lambda: f"mode = Gear.{self.one(*MEMBERS)};")
        if self.array:
            places = ("[1]", "[k %% 3]") if self.c else ("(2)", "(mod(k, 3) + 1)", "(end)")
            some.append(lambda: f"list{self.one(*places)} = {self.whole(1)};")
        if depth and not self.c:
            some += [lambda: self.branch(depth), lambda: self.loop(depth), lambda: self.switch(depth)]
        return self.random.choice(some)()

    def branch(self, depth: int) -> str:
        """``if``, with or without other branches."""
        other = f"elseif {self.condition()}, {self.action(depth - 1)} " if self.chance(0.4) else ""
        last = f"else, {self.action(depth - 1)} " if self.chance(0.5) else ""
        return f"if {self.condition()}, {self.action(depth - 1)} {other}{last}end;"

    def loop(self, depth: int) -> str:
        """A loop of a few turns, which may end early."""
        way = f"if {self.condition(1)}, {self.one('break', 'continue')}; end; " if self.chance(0.5) else ""
        turn = self.action(depth - 1)
        if self.chance(0.5):
            return f"for n = 1:{self.number(1, 4)}, {way}{turn} g = g + n; end;"
        other = sub(r"\bg = ", "h = ", turn)  # nothing else may change what is counted
        return f"g = {self.number(0, 3)}; while g < 5, g = g + 1; {way}{other} end;"

    def switch(self, depth: int) -> str:
        """``switch`` on a small number."""
        values = self.random.sample(range(5), 3)
        cases = (
            f"case {values[0]}\n {self.action(depth - 1)}\n"
            f"case {{{values[1]}, {values[2]}}}\n {self.action(depth - 1)}\n"
        )
        last = f"otherwise\n {self.action(depth - 1)}\n" if self.chance(0.6) else ""
        return f"\nswitch k\n{cases}{last}end\n"

    def may_send(self) -> bool:
        """Whether one more action may send an event."""
        self.sends -= 1
        return self.sends >= 0

    def send(self) -> str:
        """An event that is sent once in a step at most: ``turn`` is another one in each step."""
        event = self.one(*EVENTS)
        seen = f"seen_{event}"
        to = self.random.choice(self.states) if self.states and self.chance(0.4) else ""
        way = (
            self.one(f"send({event}, {to});", f"{to}.{event};")
            if to
            else self.one(f"{event};", f"send({event});")
        )
        if self.c:
            return self.note()
        return f"if turn ~= {seen}, {seen} = turn; {way} {self.note()} end;"

    def sending_label(self) -> str:
        """A transition that sends an event once in a step at most, in its condition or in its action."""
        event = self.one(*EVENTS)
        seen, differs = f"seen_{event}", "!=" if self.c else "~="
        to = self.random.choice(self.states) if self.states and self.chance(0.4) else ""
        way = (
            self.one(f"send({event}, {to});", f"{to}.{event};")
            if to
            else self.one(f"{event};", f"send({event});")
        )
        if self.chance(0.5):
            return (
                f"[turn {differs} {seen}]{{{seen} = turn; {self.note()} {way} {self.note()}}}/{self.note()}"
            )
        return f"[turn {differs} {seen}]{{{seen} = turn;}}/{self.note()} {way} {self.note()}"


__all__ = ["EVENTS", "INPUTS", "MEMBERS", "WHOLE", "Language", "Texts"]
