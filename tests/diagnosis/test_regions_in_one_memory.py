"""Two regions of a chart in one memory, against instances of one structure that are executed in turn."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from random import Random

import pytest

from rovercheck.checker.conformance.cones import cone_groups
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.diagnosis.evidence import EvidenceCollector
from rovercheck.checker.diagnosis.hypotheses import region_changes
from rovercheck.checker.diagnosis.influence import ChangeInfluence
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.variant import WrittenChange, with_change
from rovercheck.checker.mutate.regions import regions_in_one_memory
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Var, flag, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, duration
from tests.diagnosis.planted import recorded

LEVEL = integer(0, 2)
Steps = Iterator[dict[str, int]]


def lamp(name: str, wait: int, limit: int) -> tuple[State, Var, Var, Var]:
    """A region that counts presses, and forgets them a while after the last one."""
    press, count, lit = flag(f"{name}_press"), var(f"{name}_count", integer(0, 5)), var(f"{name}_lit", LEVEL)
    return (
        State(name, default="Off", states=[
            State("Off", entry=[assign(lit, 0), assign(count, 0)], transitions=[to("On", when=press)]),
            State("On", entry=[assign(lit, 1)], transitions=[
                to("Off", when=duration(~press) >= wait * ticks),
                to("Bright", when=press & (count >= limit)),
                to("On", when=press, then=[assign(count, count + 1)]),
            ]),
            State("Bright", entry=[assign(lit, 2)], transitions=[to("Off", when=after(3 * ticks))]),
        ]),
        press, count, lit,
    )  # fmt: skip


@dataclass
class OneLamp:
    """The structure that two lamps are by mistake."""

    state: str = ""
    count: int = 0
    pause: int = 0
    since: int = 0

    def execute(self, press: bool, wait: int, limit: int) -> int:
        """One call of the function, which counts its steps itself."""
        entered = ""
        if not self.state:
            entered = "Off"
        elif self.state == "Off":
            entered = "On" if press else ""
        elif self.state == "On":
            self.pause = 0 if press else self.pause
            if self.pause >= wait:
                entered = "Off"
            elif press and self.count >= limit:
                entered = "Bright"
            elif press:
                self.count, entered = self.count + 1, "On"
        else:
            self.since = min(self.since + 1, 3)
            entered = "Off" if self.since >= 3 else ""
        if entered:
            self.state, self.pause, self.since = entered, 0, 0
            self.count = 0 if entered == "Off" else self.count
        if self.state == "On":
            self.pause = 0 if press else self.pause + 1
        return ("Off", "On", "Bright").index(self.state)


def lamps(*waits: tuple[int, int]) -> tuple[System, list[tuple[Var, Var, Var]]]:
    made = [lamp(f"Lamp{n}", *wait) for n, wait in enumerate(waits)]
    chart = Chart("Lamps", [region for region, *_ in made], parallel=True)
    return in_order("lamps", chart), [(press, count, lit) for _, press, count, lit in made]


@pytest.mark.parametrize("seed", range(20))
def test_lamps_are_one_structure(seed: int) -> None:
    """State, times of unlike length and data are shared, each region has its own limits."""
    random = Random(seed)
    waits = [(random.randint(1, 6), random.randint(0, 3)) for _ in range(3)]
    system, names = lamps(*waits)
    first, second = sorted(random.sample(range(3), 2))
    [one] = [
        r for r in regions_in_one_memory(system)
        if (r.first.name, r.second.name) == (f"Lamp{first}", f"Lamp{second}")
    ]  # fmt: skip
    run, shared, alone = Interpreter(one.system(system)), OneLamp(), OneLamp()
    for _ in range(200):
        pressed = [random.random() < 0.4 for _ in waits]
        run.step({press.name: int(down) for (press, *_), down in zip(names, pressed, strict=True)})
        for n in range(3):
            lit = (shared if n in (first, second) else alone).execute(pressed[n], *waits[n])
            assert run.data[names[n][2].name] == lit


def test_regions_that_differ_in_more_than_numbers_are_not_one() -> None:
    system, _ = lamps((2, 1), (2, 1))
    region, *_ = lamp("Other", 2, 1)
    fewer = State("Other", default="Off", states=[region.states[0], region.states[1]])
    chart = Chart("Lamps", [system.charts[0].root.states[0], fewer], parallel=True)
    assert not list(regions_in_one_memory(in_order("lamps", chart)))
    assert len(list(regions_in_one_memory(system))) == 1


# --- the monitors of Board 2 as C firmware has them ----------------------------------------------------


@dataclass
class Monitor:
    """One structure for two sources: stamps, gaps, level and steps [spec §3.1]."""

    bits: int
    level: int = -1
    slow: bool = False
    stamp: int | None = None
    gaps: list[int] = field(default_factory=list)
    fine: int = 0

    def _slow(self, stamp: int, mean: int) -> bool:
        kept = (lambda ms: ms % (1 << self.bits)) if self.bits else (lambda ms: ms)
        if self.stamp is None:
            self.stamp = stamp
        if stamp != self.stamp:
            self.gaps = [kept(stamp - self.stamp), *self.gaps][:10]
            self.stamp = stamp
        return bool(self.gaps) and kept(sum(self.gaps)) > len(self.gaps) * mean

    def execute(self, now: int, stamp: int, mean: int, limit: int, rest: int) -> int:
        """One call of the function for one of the sources."""
        entered = -1
        self.fine = 0 if self.slow else self.fine
        if self.level < 0:
            entered = 0
        elif self.level == 2:
            entered = 0 if self.fine > rest else -1
        elif self.level == 0 and self.slow:
            entered = 1
        elif self.level == 1 and self.fine > 50:
            entered = 0
        elif now - stamp > limit:
            entered = 2
        if entered >= 0:
            self.level, self.fine = entered, 0
        else:
            self.slow = self._slow(stamp, mean)
        self.fine = 0 if self.slow else self.fine + 1
        return self.level


SOURCES = {
    "Board1Supervisor": ("last_valid_b1_ms", "b1_sup_status", 60, 150, 100),
    "BLE": ("ble_last_valid_ms", "esp_status", 40, 120, 50),
    "IMU": ("imu_last_valid_ms", "imu_status", 100, 200, 50),
    "Rx": ("b1_data_last_valid_ms", "rx_status", 40, 120, 50),
}


def stamps(random: Random, steps: int) -> Iterator[tuple[int, dict[str, int]]]:
    """The time of each step, and stamps that come often, seldom, or not at all for a while."""
    at = dict.fromkeys((name for name, *_ in SOURCES.values()), 0)
    often = dict.fromkeys(at, 0.8)
    for number in range(1, steps + 1):
        for name in at:
            if random.random() < 0.01:
                often[name] = random.choice((0.0, 0.1, 0.4, 0.8, 1.0))
            if random.random() < often[name]:
                at[name] = 20 * number - random.choice((0, 0, 3, 20))
        yield 20 * number, dict(at)


@pytest.mark.parametrize("bits", [0, 32])
@pytest.mark.parametrize(("first", "second"), [("BLE", "Rx"), ("Board1Supervisor", "Rx"), ("BLE", "IMU")])
def test_monitors_are_one_structure(first: str, second: str, bits: int) -> None:
    board = boards()["board2"]
    changed = with_change(
        board, WrittenChange("shared", "Monitors_2", f"regions/{bits}" if bits else "regions", second, first)
    )
    seen = frozenset(v.var.name for v in board.interface.views)
    status = {name: told for name, (_, told, *_) in SOURCES.items()}
    every = [g.cone() for g in cone_groups(changed, seen, frozenset(o.name for o in board.outputs))]
    cones = [cone for cone in every if any(o.name in status.values() for o in cone.outputs)]
    random, levels = Random(bits), set[tuple[object, ...]]()
    for _ in range(6):
        reader = changed.reader()
        states: list[Known] = [tuple(v.init for v in cone.system.variables) for cone in cones]
        own = {name: Monitor(bits) for name in SOURCES}
        own[second] = own[first]
        for now, given in stamps(random, 500):
            at, told = reader.step({**board.at_power_up(), **given, "now_ms": now}), dict[str, object]()
            for n, cone in enumerate(cones):
                states[n], out = cone.step(states[n], tuple(at[v.name] for v in cone.system.inputs))
                told |= zip((o.name for o in cone.outputs), out, strict=True)
            for name, (stamp, _, *numbers) in SOURCES.items():
                assert told[status[name]] == own[name].execute(now, given[stamp], *numbers), (now, name)
            levels.add(tuple(told[one] for one in status.values()))
    assert len(levels) > 8


def test_what_has_gone_by_may_be_negative() -> None:
    """`compare --variant` ended with a message about a domain that such a gap leaves."""
    board = boards()["board2"]
    changed = with_change(board, WrittenChange("shared", "Monitors_2", "regions/32", "Rx", "BLE"))
    reader, run, random = changed.reader(), Interpreter(changed.system, measured=True), Random(2)
    least = 0
    for now, given in stamps(random, 300):
        at = reader.step({**board.at_power_up(), **given, "now_ms": now})
        run.step({name: at[name] for name in changed.system.inputs})
        least = min(least, *(value for name, value in run.data.items() if name.endswith("_pending_ms")))
    assert least < 0


def test_it_explains_what_it_does_and_no_other_pair_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """Such firmware was told as nine findings, none of them with its cause."""
    board, random = boards()["board2"], Random(1)
    every = list(region_changes(board.system, frozenset({"Monitors_2"})))
    [change] = [c for c in every if (c.old, c.new, c.at) == ("Rx", "BLE", "regions/32")]
    collector, made = EvidenceCollector(board), change.make()
    for number in range(3):
        rows = [{**board.at_power_up(), **given, "now_ms": now} for now, given in stamps(random, 400)]
        collector.add(recorded("board2", made, rows, f"run {number}"))
    [part] = [one for one in collector.evidence().parts if one.name == "Monitors_2"]
    bench, cones = TrialBench(part), {c.key: part.group.cone(c.make()) for c in every}
    assert {key[3:] for key, cone in cones.items() if bench.trial(cone).full} == {("Rx", "BLE")}
    assert ChangeInfluence(board.system, part.cone.outputs).outputs(change) == {"esp_status", "rx_status"}
    # with it all rows are decided, also those behind a loss of the drawn chart, which speak for it alone
    whole, wrong = bench.going_on(cones[change.key])
    assert set(whole.ends) == {0, 1, 2} == set(wrong) and set(whole.ends.values()) == {400}
    assert not any(wrong.values())
    assert [key for key, cone in cones.items() if whole.trial(cone).full] == [change.key]

    # a run in which a number has no meaning to a change stays as it is, as a mask of 5/2 has no bits
    def no_bits(*_: object) -> Iterator[object]:
        raise TypeError
        yield

    monkeypatch.setattr(TrialBench, "mismatches", no_bits)
    same, wrong = bench.going_on(cones[change.key])
    assert same.ends == bench.ends and not wrong
