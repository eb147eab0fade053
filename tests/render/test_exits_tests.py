"""Exits that run: a trace as a pytest file and as a C program, against lamps with and without a fault."""

import ast
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from rovercheck.checker.board_tests.c_program import interface
from rovercheck.checker.board_tests.rows import rows
from rovercheck.checker.render import trace_c, trace_pytest
from rovercheck.checker.results.format import Need
from tests.render.conformance import Suite
from tests.render.exits_zoo import CONCRETE, LAMP

LAMP_C = """
#include <stdbool.h>
#include <stdint.h>
struct inputs { uint32_t now_ms; uint32_t seen_ms; double level; bool on; };
struct outputs { bool lit; int32_t age; };
static struct inputs now;
void reset(void) {}
void set_inputs(const struct inputs *in) { now = *in; }
void step(void) {}
void get_outputs(struct outputs *out)
{
    out->lit = now.on && now.level > LEAST;
    out->age = (int32_t)(now.now_ms - now.seen_ms);
}
"""

FAKES = """
class Board:
    def __init__(self, name):
        self.name, self.inputs = name, [Signal("now_ms", True), Signal("seen_ms", True)]

    def at_power_up(self):
        return {"now_ms": 0, "seen_ms": 0, "level": 0.0, "on": False}


class Signal:
    def __init__(self, name, stamp):
        self.name, self.stamp = name, stamp


class Lamp:
    def __init__(self, least):
        self.least = least

    def reset(self):
        pass

    def step(self, given):
        lit, age = given["on"] and given["level"] > self.least, (given["now_ms"] - given["seen_ms"]) % 2**32
        return {"lit": lit, "age": age} if age < self.stops else self.then

    stops, then = 2**32, {}

    def close(self):
        pass


def start(address, board):
    what = address.rpartition(":")[2]
    lamp = Lamp(0.3 if what in ("Lamp", "silent", "odd") else float(what))
    if what in ("silent", "odd"):
        lamp.stops, lamp.then = 25, {} if what == "silent" else {"lit": True, "age": float("nan")}
    return lamp


def boards():
    return {name: Board(name) for name in ("toy", "other")}
"""


def replaced(text: str) -> str:
    """The file with the lamp of this module in place of the adapters and boards of the rover."""
    left = text.replace("from rovercheck.checker.adapters import start\n", "")
    return left.replace("from rovercheck.spec_model.abstraction import boards\n", FAKES)


class Exits(Suite):
    KIND = "trace"
    REFUSED = frozenset({"unknown"})


class TestPytest(Exits):
    NAME = "pytest"
    ZOO = CONCRETE

    def parse(self, document: str) -> None:
        ast.parse(document)
        assert max(map(len, document.splitlines())) <= 110

    def test_the_file_passes_and_finds_a_fault(self, tmp_path: Path) -> None:
        (tmp_path / "test_it.py").write_text(replaced(self.shown("two")), encoding="utf-8")
        assert "2 passed" in self.run(tmp_path, {})
        said = self.run(tmp_path, {"ROVERCHECK_IMPL": "lamp:0.6"})
        assert "2 failed" in said
        assert "step 1 (20 ms), output: (required, actual) {'lit': (True, False)}" in said

    def test_a_clock_that_begins_again(self, tmp_path: Path) -> None:
        (tmp_path / "test_it.py").write_text(replaced(self.shown("late")), encoding="utf-8")
        assert "2 passed" in self.run(tmp_path, {})
        said = self.run(tmp_path, {"ROVERCHECK_IMPL": "lamp:0.6"})
        assert "step 1 (20 ms)" in said and "step 1 (4294967256 ms)" in said

    @pytest.mark.parametrize("fault", ["silent", "odd"])
    def test_an_output_that_is_given_no_longer_and_one_that_is_no_number_are_faults(
        self, fault: str, tmp_path: Path
    ) -> None:
        (tmp_path / "test_it.py").write_text(replaced(self.shown("one")), encoding="utf-8")
        said = self.run(tmp_path, {"ROVERCHECK_IMPL": f"lamp:{fault}"})
        assert "1 failed" in said and "step 3 (60 ms)" in said

    def run(self, folder: Path, environment: Mapping[str, str]) -> str:
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-c", os.devnull]
        found = subprocess.run(
            [*command, str(folder)],
            capture_output=True,
            text=True,
            check=False,
            cwd=folder,
            env={"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", **environment},
        )
        return found.stdout

    def test_says_that_the_charts_break_the_property(self) -> None:
        assert "although they break the property" in " ".join(self.shown("one").split())


class TestC(Exits):
    NAME = "c"
    ZOO = CONCRETE

    def parse(self, document: str) -> None:
        checked = ["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-xc", "-"]
        for board in range(1, 1 + document.count("#if BOARD ==")) or [1]:
            subprocess.run([*checked, f"-DBOARD={board}"], input=document, text=True, check=True)

    @pytest.mark.parametrize("board", [1, 2])
    def test_the_program_passes_and_finds_a_fault(self, board: int, tmp_path: Path) -> None:
        (tmp_path / "run.c").write_text(self.shown("two"), encoding="utf-8")
        (tmp_path / "lamp.c").write_text(LAMP_C, encoding="utf-8")
        for least, code in (("0.3", 0), ("0.6", 1)):
            flags = [f"-DBOARD={board}", f"-DLEAST={least}", "-std=c99"]
            built = ["cc", *flags, "run.c", "lamp.c", "-o", "run", "-lm"]
            subprocess.run(built, cwd=tmp_path, check=True)
            found = subprocess.run([str(tmp_path / "run")], capture_output=True, text=True, check=False)
            assert found.returncode == code
            expected = "lit: required 1, actual 0\n  in TOY-1 at 20 ms" if code else "1 of 1 tests passed"
            assert expected in found.stdout

    def test_a_clock_that_begins_again(self, tmp_path: Path) -> None:
        (tmp_path / "run.c").write_text(self.shown("late"), encoding="utf-8")
        (tmp_path / "lamp.c").write_text(LAMP_C, encoding="utf-8")
        for least, said in (("0.3", "2 of 2 tests passed"), ("0.6", "in TOY-2 at 4294967256 ms")):
            built = ["cc", f"-DLEAST={least}", "-std=c99", "run.c", "lamp.c", "-o", "run", "-lm"]
            subprocess.run(built, cwd=tmp_path, check=True)
            found = subprocess.run([str(tmp_path / "run")], capture_output=True, text=True, check=False)
            assert said in found.stdout


def test_equal_steps_are_one_row() -> None:
    assert [count for count, _, _ in rows(LAMP)] == [2, 1, 1, 1]
    _, _, (_, given, wanted), (_, last, _) = rows(LAMP)
    assert given == {"level": 0.25} and wanted == {"lit": None, "age": 45}
    assert last == {"seen_ms": 0, "on": False}


def test_a_run_of_the_model_fits_the_functions_written_for_generated_tests() -> None:
    """The structures are the same, so that a user writes the four functions once."""
    assert interface(LAMP.board) in trace_c.render(CONCRETE["one"])


def test_both_know_that_they_need_the_concrete_run() -> None:
    assert all(Need.BOARD_STEPS in one.FORMAT.needs for one in (trace_c, trace_pytest))
