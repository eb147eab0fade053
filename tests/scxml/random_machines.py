"""Random machines in SCXML in which the features overlap, and runs of both readings beside each other."""

from collections.abc import Iterator, Sequence
from random import Random

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import machine_of
from rovercheck.checker.scxml.system import LoweredMachine, lowered_machine
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.interpret import Interpreter

EVENTS = ("a", "a.b", "c", "d")
OWN = ("i", "i.j", "k")
CARRIED_CONDITIONS = (' cond="_event.data.n &gt; x"', ' cond="_event.data.t"', ' cond="1 == _event.data.n"')
CARRIED_ACTIONS = (
    '<assign location="x" expr="_event.data.n"/>', '<assign location="b" expr="b ? _event.data.t : !b"/>',
    '<if cond="_event.data.n &lt; 2"><assign location="b" expr="_event.data.t != b"/></if>',
)  # fmt: skip


class _Writer:
    def __init__(self, random: Random, timed: bool, carrying: bool) -> None:
        self.random, self.timed, self.carrying = random, timed, carrying
        self.ids, self.shape = list[str](), dict[str, list[str]]()
        self.kinds: dict[str, str] = {}
        self.parents: dict[str, str] = {}
        self.sends = 0

    def plan(self, parent: str, depth: int) -> None:
        inside = self.shape[parent] = list[str]()
        kinds = ["state"] * self.random.choice((2, 2, 3))
        if self.kinds.get(parent) != "parallel":
            kinds += ["final"] * (parent != "" and self.random.random() < 0.4)
            kinds += ["parallel"] * (depth < 2 and self.random.random() < 0.5)
        if parent and self.random.random() < 0.4:
            kinds.append(self.random.choice(("history", "deep")))
        for kind in kinds:
            id = f"s{len(self.ids) + 1}"
            self.ids.append(id)
            self.kinds[id], self.parents[id] = kind, parent
            inside.append(id)
            if kind == "parallel" or (kind == "state" and depth < 3 and self.random.random() < 0.4):
                self.plan(id, depth + 1)

    def condition(self) -> str:
        plain = [one for one in self.ids if self.kinds[one] not in ("history", "deep")]
        r = self.random.random()
        if r < 0.55:
            return ""
        words = (f"In('{self.random.choice(plain)}')", "x == 1", "x &lt; 2", "!b", "b || x &gt;= 2")
        return f' cond="{self.random.choice(words)}"'

    def actions(self, most: int = 2) -> str:
        return "".join(self.action() for _ in range(self.random.choice((0, 1, most))))

    def action(self) -> str:
        r = self.random.random()
        if r < 0.3:
            return f'<raise event="{self.random.choice(OWN)}"/>'
        if r < 0.5:
            value = self.random.choice(("0", "1", "x == 3 ? 0 : x + 1", "3 - x"))
            return f'<assign location="x" expr="{value}"/>'
        if r < 0.65:
            value = self.random.choice(("!b", "x == 1", "true"))
            return f'<assign location="b" expr="{value}"/>'
        if r < 0.75 and self.timed:
            self.sends += 1
            delay = self.random.choice(("0s", "10ms", "30ms"))
            event, id = self.random.choice(OWN), f"t{self.sends}"
            return f'<cancel sendid="{id}"/><send id="{id}" event="{event}" delay="{delay}"/>'
        inner = self.random.choice(("<log/>", "<raise event='k'/>", "<assign location='x' expr='2'/>"))
        condition = self.condition() or " cond='b'"
        return f"<if{condition}>{inner}<else/><assign location='b' expr='!b'/></if>"

    def transition(self, id: str) -> str:
        inside = [one for one in self.ids if one.startswith("s")]
        done = f"done.state.{self.random.choice(self.ids)}"
        event = self.random.choice((*EVENTS, *EVENTS, *OWN, "*", "a.*", "a c", done))
        condition = self.condition()
        eventless = condition and self.random.random() < 0.15
        target = "" if self.random.random() < 0.15 else f' target="{self.random.choice(inside)}"'
        parallels = [one for one in self.ids if self.kinds[one] == "parallel"]
        if parallels and self.random.random() < 0.15:
            regions = [r for r in self.shape[self.random.choice(parallels)] if self.kinds[r] == "state"]
            picked = [self.random.choice(self.shape.get(r, [r])) for r in regions[:2]]
            target = f' target="{" ".join(picked)}"'
        internal = ' type="internal"' if self.random.random() < 0.3 else ""
        word = "" if eventless else f' event="{event}"'
        actions = self.actions()
        if self.carrying and not eventless and event in (*EVENTS, "a.*", "a c"):
            condition = self.random.choice((condition, *CARRIED_CONDITIONS))
            actions += self.random.choice(("", *CARRIED_ACTIONS))
        return f"<transition{word}{condition}{target}{internal}>{actions}</transition>"

    def state(self, id: str) -> str:
        kind = self.kinds[id]
        if kind in ("history", "deep"):
            beside = [one for one in self.shape[self.parents[id]] if self.kinds[one] in ("state", "parallel")]
            if self.kinds[self.parents[id]] == "parallel":
                beside = beside[:1]
            word = "deep" if kind == "deep" else "shallow"
            begin = f'<transition target="{self.random.choice(beside)}">{self.actions(1)}</transition>'
            return f'<history id="{id}" type="{word}">{begin}</history>'
        handlers = f"<onentry>{self.actions(1)}</onentry><onexit>{self.actions(1)}</onexit>"
        if kind == "final":
            return f'<final id="{id}">{handlers}</final>'
        inside = self.shape.get(id, [])
        moves = "".join(self.transition(id) for _ in range(self.random.choice((1, 2, 3))))
        body = "".join(map(self.state, inside))
        return f'<{kind} id="{id}">{handlers}{moves}{body}</{kind}>'


def random_machine(seed: int, timed: bool = True, *, carrying: bool = False) -> str:
    """A machine of up to some twenty states, of which the events from outside may carry data."""
    while True:
        made = _Writer(Random(seed), timed, carrying)
        made.plan("", 0)
        if len(made.ids) <= 24:
            break
        seed += 1_000_003
    body = "".join(map(made.state, made.shape[""]))
    data = '<datamodel><data id="x" expr="0"/><data id="b" expr="false"/></datamodel>'
    space = 'xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript"'
    return f"<scxml {space}>{data}{body}</scxml>"


def lowered(text: str) -> LoweredMachine:
    """A random machine as a system."""
    domains = {"x": integer(0, 3), "event.n": integer(0, 3)}
    return lowered_machine(machine_of(text.encode(), "random.scxml"), "random.scxml", domains)


def inputs(found: Sequence[str], random: Random, steps: int) -> Iterator[str]:
    """Events, and steps without."""
    for _ in range(steps):
        yield random.choice(("", *found))


def differences(one: LoweredMachine, events: Sequence[str]) -> str:
    """Where the two readings differ first; empty where they agree."""
    [chart] = one.system.charts
    direct, system, random = MachineRunner(one.machine), Interpreter(one.system), Random(len(events))
    for number, event in enumerate(events, start=1):
        said, carried = ["", ""], {"n": random.randrange(4), "t": random.random() < 0.5}
        try:
            direct.step(event, carried=carried)
        except DrawnFault as fault:
            said[0] = str(fault)
        try:
            given = {f"event.{name}": int(value) for name, value in carried.items()}
            given["event"] = one.event.domain.raw(event or "none")
            system.step({name: raw for name, raw in given.items() if name in one.system.inputs})
        except ModelError as error:
            said[1] = str(error)
        if said[0] and said[1]:
            return ""
        if said[0] or said[1]:
            return f"step {number}: {said}"
        at = system.valuation()
        active = {
            s.id for s, path in one.view.paths.items()
            if s.parent is not None and s.kind != "history" and evaluate(chart.active_path(path), at)
        }  # fmt: skip
        values = {name: at[name] for name in one.data}
        if active != {s.id for s in direct.active} or values != direct.data:
            return f"step {number}: {sorted(active)} {values}, {[s.id for s in direct.active]} {direct.data}"
    return ""
