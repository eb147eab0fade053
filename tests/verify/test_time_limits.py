"""A limit of time holds wherever the time goes: in lowering, slicing, compiling, searching, certifying."""

import time
from dataclasses import fields, replace
from importlib import import_module
from typing import Any

import pytest

from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.certificates import Certification
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchEnd, SearchSettings, searches
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Always, Property
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import System, in_order

SECONDS = 4.0
"""Long enough for a child to come to the stage that is slow, on a machine that is busy."""
go, lamp = flag("go"), flag("lamp")
LAMP = Chart(
    "Lamp",
    [
        State("Off", entry=[assign(lamp, False)], transitions=[to("On", when=go)]),
        State("On", entry=[assign(lamp, True)], transitions=[to("Off", when=~go)]),
    ],
    default="Off",
)


class Slow(System):
    """A system that makes a function slow in the process that it is sent to."""

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, (self.notes, {f.name: getattr(self, f.name) for f in fields(self)})


def _made(functions: tuple[str, ...], parts: dict[str, Any]) -> System:
    for function in functions:
        module, _, name = function.rpartition(".")
        setattr(import_module(module), name, _sleep)
    return System(**parts)


def _sleep(*_: object) -> None:
    time.sleep(60)


def heard(*functions: str, certify: bool = False) -> tuple[Result, float]:
    """What is found of a small system with slow functions, and after how many seconds."""
    plain = in_order("lamp", LAMP, notes=functions)
    system = Slow(**{f.name: getattr(plain, f.name) for f in fields(plain)})
    prop = Property("LAMP", "", Always(lamp | ~lamp), (), "lamp")
    certifying = Certification(again=True) if certify else None
    began = time.monotonic()
    settings = SearchSettings(AUTO, Limits(seconds=SECONDS), 1, certifying=certifying)
    work = searches([Task(system, (prop,))], {"lamp": system}, settings)
    found = list(work)
    took = time.monotonic() - began
    [result] = [one for one in found if isinstance(one, Result)]
    assert isinstance(found[-1], SearchEnd)
    return result, took


@pytest.mark.parametrize(
    ("function", "stage"),
    [
        ("rovercheck.checker.system.lowering_cache.lower", "while lowering lamp"),
        ("rovercheck.checker.verify.decide.require_initial_tick", "while lowering lamp"),
        ("rovercheck.checker.verify.portfolio.shape.sliced", "while slicing lamp"),
        (
            "rovercheck.checker.encode.native.search.partitions",
            "while compiling 2 variables in 3 bits (explicit)",
        ),
        ("rovercheck.checker.encode.native.object_code", "while compiling 2 variables in 3 bits (explicit)"),
        ("rovercheck.checker.engines.explicit.answers.sliced", "while searching (explicit)"),
    ],
)
def test_what_looks_at_no_clock_is_ended_and_named(function: str, stage: str) -> None:
    result, took = heard(function)
    assert result.verdict == Unknown(f"time: 4 s ended {stage}", 0, "none")
    assert took < 30  # 4 s, a tenth more, 2 s, and what a busy machine adds


def test_a_proof_that_cannot_be_certified_in_time_stays_a_proof_without_certificate() -> None:
    result, took = heard("rovercheck.checker.verify.certificates.check", certify=True)
    assert result.verdict.word == "proved"
    assert "time: 4 s ended while certifying 1 verdict" in str(result.certificate)
    assert took < 30


def test_without_a_slow_stage_the_question_is_decided() -> None:
    result, _ = heard()
    assert result.verdict.word == "proved"


def test_no_engine_is_asked_when_the_time_is_over() -> None:
    from rovercheck.checker.verify.decide import decide

    system = in_order("lamp", LAMP)
    prop = Property("LAMP", "", Always(lamp | ~lamp), (), "lamp")
    limits = replace(Limits(), seconds=0.0)
    [result] = decide(Task(system, (prop,)), {"lamp": system}, AUTO, limits)
    assert result.verdict == Unknown("time: 0 s ended before an engine was asked", 0, "none")
