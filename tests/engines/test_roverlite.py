"""RoverLite, the model of the benchmarks, against a plain reference of its description."""

import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks import rivals
from benchmarks.explicit import ours
from benchmarks.peers.unrolling import induct, unroll
from benchmarks.roverlite import question, roverlite
from benchmarks.targets import agrees
from rovercheck.checker.engines import Limits, explicit, quiet
from rovercheck.checker.results.verdict import Reached
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.profiles import examples

ALL = 127
Inputs = Mapping[str, int]


# --- the reference -----------------------------------------------------------------------------------


@dataclass
class Class:
    """A monitored quantity: CRITICAL after ``limit`` critical steps in a row, until it is fine again."""

    limit: int
    status: str = "OK"
    streak: int = 0

    def read(self, critical: bool, fine: bool) -> None:
        self.streak = min(self.streak + 1, self.limit) if critical else 0
        if self.status == "CRITICAL":
            self.status = "OK" if fine else "CRITICAL"
        elif critical and self.streak == self.limit:
            self.status = "CRITICAL"
        else:
            self.status = "OK" if fine else "DEGRADED"
        if self.status == "CRITICAL":
            self.streak = 0


@dataclass
class Link:
    """Messages that arrive or not: CRITICAL when older than 6 steps, OK again after ``limit`` good ones."""

    limit: int
    status: str = "OK"
    age: int = 0
    good: int = 0

    def read(self, new: bool) -> None:
        self.age = 0 if new else min(self.age + 1, 7)
        self.good = min(self.good + 1, self.limit) if self.age <= 2 else 0
        if self.age > 6:
            self.status = "CRITICAL"
        elif self.good == self.limit:
            self.status = "OK"
        elif self.status == "OK" and self.age > 2:
            self.status = "DEGRADED"
        if self.status == "OK":
            self.good = 0


@dataclass
class Rover:
    """The whole model with timers divided by ``k``; ``read`` is one step and says what is broken after it."""

    k: int
    far: list[bool] = field(default_factory=lambda: [False] * 3)
    windows: dict[str, int] = field(default_factory=lambda: dict.fromkeys(("12", "21", "23", "32"), 0))
    command: str = "NONE"
    relay: bool = False
    hold: int = 0
    observed: bool = False
    near: bool = False
    output: str = "NONE"
    moving: bool = True

    def __post_init__(self) -> None:
        self.temperature, self.battery = Class(self.steps(200)), Class(self.steps(250))
        self.rx, self.beat = Link(self.steps(50)), Link(self.steps(50))
        self.since = self.steps(150)

    def steps(self, n: int) -> int:
        return max(1, n // self.k)

    def read(self, at: Mapping[str, object]) -> dict[str, bool]:
        self.temperature.read(
            at["temperature"] in ("COLD_CRITICAL", "HOT_CRITICAL"), at["temperature"] == "FINE"
        )
        self.battery.read(at["charge"] in ("CRITICAL_LOW", "OVER"), at["charge"] == "FINE")
        self.rx.read(bool(at["rx_new"]))
        self.beat.read(bool(at["beat_new"]))
        lost = "CRITICAL" in (self.rx.status, self.beat.status)
        released = self._relay(lost)
        self.since = 0 if lost else min(self.since + 1, self.steps(150))
        sonars = [at[f"sonar{i}"] for i in (1, 2, 3)]
        self._deviate([s == "FAR" for s in sonars], bool(at["turned"]))
        hot = self.temperature.status == "CRITICAL"
        self.near = "NEAR" in sonars
        self.output = "STOP" if self.near else self.command
        critical = lost or hot or self.battery.status == "CRITICAL"
        self.moving = not critical and self.output != "STOP"
        self.observed |= released and self.temperature.status == "OK"
        return {
            "P1": self.near and self.output != "STOP",
            "P2": critical and self.moving,
            "P3": not self.relay and lost,
            "P3h": not self.relay and self.since < self.steps(150),
            "P4": hot,
            "P5": self.observed and hot,
        }

    def _relay(self, lost: bool) -> bool:
        """Whether the relay is released in this step."""
        before = self.relay
        if lost:
            self.relay, self.hold = True, 0
        elif self.relay:
            self.hold += 1
            if self.hold == self.steps(150):
                self.relay, self.hold = False, 0
        return before and not self.relay

    def _deviate(self, far: list[bool], turned: bool) -> None:
        open_ = [p for p, left in self.windows.items() if left and far[int(p[1]) - 1]]
        lost = [was and not now for was, now in zip(self.far, far, strict=True)]
        if self.command != "NONE" or open_:
            if self.command == "NONE":
                self.command = {"12": "LEFT", "23": "LEFT", "21": "RIGHT", "32": "RIGHT"}[open_[0]]
            elif turned:
                self.command = "NONE"
            self.windows = dict.fromkeys(self.windows, 0)
        else:
            for pair, left in self.windows.items():
                self.windows[pair] = self.steps(150) if lost[int(pair[0]) - 1] else max(0, left - 1)
        self.far = far

    @property
    def valuation(self) -> dict[str, object]:
        return {
            "temperature_status": self.temperature.status,
            "temperature_count": self.temperature.streak,
            "battery_status": self.battery.status,
            "battery_count": self.battery.streak,
            "rx_status": self.rx.status,
            "rx_age": self.rx.age,
            "rx_good": self.rx.good,
            "beat_status": self.beat.status,
            "beat_age": self.beat.age,
            "beat_good": self.beat.good,
            "relay_on": self.relay,
            "relay_hold": self.hold,
            "since_critical": self.since,
            "command": self.command,
            "observed": self.observed,
            "near": self.near,
            "output": self.output,
            "moving": self.moving,
            **{f"window{p}": left for p, left in self.windows.items()},
            **{f"was_far{i}": f for i, f in enumerate(self.far, 1)},
        }


# --- our model beside it -----------------------------------------------------------------------------


def shown(system: TransitionSystem, at: Inputs) -> dict[str, object]:
    """Raw values with the members of enumerations by name."""
    sorts = {v.name: v.domain.sort for v in (*system.variables, *system.inputs)}
    return {n: s.member(raw) if isinstance(s := sorts[n], Enum) else raw for n, raw in at.items()}


SYSTEM, GOALS = roverlite(ALL)
ONE_TICK = st.fixed_dictionaries({v.name: st.sampled_from(list(v.domain.values)) for v in SYSTEM.inputs})
HELD_RUNS = st.lists(st.tuples(ONE_TICK, st.integers(1, 30)), min_size=1, max_size=12)


@examples(40)
@given(k=st.sampled_from([1, 10, 25, 100]), held=HELD_RUNS)
def test_a_step_is_that_of_the_reference(k: int, held: list[tuple[dict[str, int], int]]) -> None:
    system, goals = roverlite(ALL, k)
    at, rover = system.init, Rover(k)
    for inputs, times in held:
        for _ in range(times):
            at = step(system, at, inputs)
            broken = rover.read(shown(system, inputs))
            named = shown(system, at)
            assert {n: named[n] for n in rover.valuation} == rover.valuation
            assert {g.name: bool(at[g.name]) for g in goals} == {**broken, "broken": False}


def test_full_timing_is_that_of_the_reference() -> None:
    """Every timer runs out once: hold each input that starts one for longer than it takes."""
    calm = {v.name: 1 for v in SYSTEM.inputs} | {"temperature": 2, "charge": 2, "turned": 0}
    held = [
        (calm, 3), ({**calm, "rx_new": 0}, 8), (calm, 202), ({**calm, "temperature": 0, "charge": 3}, 260),
        ({**calm, "sonar1": 2}, 1), (calm, 120), ({**calm, "sonar2": 2}, 2), ({**calm, "turned": 1}, 2),
        ({**calm, "sonar2": 2}, 1), (calm, 3), ({**calm, "sonar3": 2}, 2), ({**calm, "turned": 1}, 2),
        ({**calm, "sonar3": 2}, 1), (calm, 152), ({**calm, "sonar2": 2}, 1), ({**calm, "sonar3": 0}, 2),
    ]  # fmt: skip
    at, rover, seen = SYSTEM.init, Rover(1), set()
    for inputs, times in held:
        for _ in range(times):
            at = step(SYSTEM, at, inputs)
            broken = rover.read(shown(SYSTEM, inputs))
            assert {n: shown(SYSTEM, at)[n] for n in rover.valuation} == rover.valuation
            assert {n: bool(at[n]) for n in broken} == broken
            seen |= {n for n, b in broken.items() if b}
    assert seen == {"P4", "P5"}


def test_as_a_system_of_one_block_it_has_the_same_steps() -> None:
    lowered = lower(question(ALL, 25)[0])
    system, _ = roverlite(ALL, 25)
    assert lowered.checks == () and lowered.init == system.init
    at = system.init
    for raw in (0, 1, 0, 1, 1):
        inputs = {v.name: raw for v in system.inputs}
        assert step(lowered, at, inputs) == (at := step(system, at, inputs))


def test_its_properties_get_the_known_verdicts() -> None:
    system, properties = question(85, 10)
    results = decide(Task(system, tuple(properties)), {system.name: system}, "explicit", Limits())
    words = {r.property.id: r.verdict.word for r in results}
    assert words == {
        "RL-P1": "proved",
        "RL-P2": "proved",
        "RL-P3": "proved",
        "RL-P3h": "proved",
        "RL-P4": "violated",
        "RL-P5": "violated",
    }


def test_the_observer_needs_what_it_observes() -> None:
    with pytest.raises(ValueError, match="add 1 and 16"):
        roverlite(64)


# --- the encodings for other tools -------------------------------------------------------------------


def needs(*tools: str) -> pytest.MarkDecorator:
    missing = [t for t in tools if shutil.which(t) is None]
    return pytest.mark.skipif(bool(missing), reason=f"{', '.join(missing)} not installed")


@needs("gcc")
@pytest.mark.parametrize("factored", [False, True])
def test_c_searches_the_same_valuations(factored: bool, tmp_path: Path) -> None:
    tool = rivals.c_search(31, 25, factored, tmp_path)
    assert tool is not None and tool().states == 40_560


@needs("gcc", "spin")
@pytest.mark.parametrize(("parts", "k"), [(31, 50), (32, 50), (85, 50)])
def test_spin_searches_the_same_valuations(parts: int, k: int, tmp_path: Path) -> None:
    tool = rivals.spin_search(parts, k, tmp_path, 60)
    system, goals = roverlite(parts, k)
    wanted = [g for g in goals if g.name in ("P5", "broken")]
    assert tool is not None and tool().states == ours(system, wanted).states


@needs(rivals.ABC)
@pytest.mark.parametrize("goal", ["P1", "P2", "P3", "P4"])
def test_abc_gives_the_known_answers(goal: str) -> None:
    tool = rivals.abc("pdr", goal, 60)
    assert tool is not None and agrees(goal, tool())


def test_z3_by_hand_gives_the_known_answers() -> None:
    assert [induct(name, 1) for name in ("P1", "P2", "P3", "P3h")] == [True, True, True, False]
    system, goals = roverlite(85, 25)
    answers = explicit.check(system, goals, Limits(), quiet)
    for name in ("P4", "P5"):
        answer = answers[name]
        assert isinstance(answer, Reached) and unroll(name, 25) == len(answer.run)
    assert unroll("P3h", 50, most=20) is None
