"""Tests as files: the pytest file and the C program really run, and fail for a fault."""

import csv
import subprocess
import sys
from dataclasses import replace
from io import StringIO
from pathlib import Path
from random import Random
from typing import Any

import pytest

from rovercheck.checker.board_tests.rows import rows
from rovercheck.checker.results.board_test import BoardTest
from rovercheck.checker.testgen import kept_text
from rovercheck.checker.testgen.expected_outputs import expected
from rovercheck.checker.testgen.formats import FORMATS
from rovercheck.checker.testgen.keep import kept_of
from rovercheck.checker.testgen.scripts import Script, script, steps, unfolded
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW
from tests.testgen.cover_toys import TOY

LAMP = """
#include "cover_toy.h"
static struct inputs now;
static int lit, before, age;
void reset(void) { lit = 0; before = 1; age = -1; }
void set_inputs(const struct inputs *in) { now = *in; }
void step(void)
{
    if (age < 0) { age = 0; }
    else if (lit) { if (++age >= LEAST && !now.press) lit = 0; }
    else if (now.press && !before && now.light_lx < 10) { lit = 1; age = 0; }
    before = now.press;
}
void get_outputs(struct outputs *out) { out->lit = lit; }
"""


def toy_test(name: str, presses: str) -> BoardTest:
    moments: Script = tuple({"press": c == "1", "light_lx": 9} for c in presses)
    return expected(TOY, name, steps(TOY, moments), ["a goal"])


def kept_test(board: Board, number: int, most: int | None = None) -> BoardTest:
    """A test of those kept with the project, or its first steps."""
    name, goals, moments = kept_of(board, kept_text(board.name)).tests[number]
    return expected(board, name, steps(board, moments[:most]), goals)


TESTS = [toy_test("toy_001", "0111000"), toy_test("toy_002", "01000011101000")]


def written(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")


def ran(*command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=300, check=False)


def test_rows_stand_for_inputs_and_outputs_of_every_step() -> None:
    for test in TESTS:
        found = rows(test)
        moments = unfolded(TOY, [(held, given) for held, given, _ in found])
        assert moments == script(TOY, [step.inputs for step in test.steps])
        lit, outputs = None, []
        for held, _, required in found:
            lit = required.get("lit", lit)
            outputs += [{"lit": lit}] * held
        assert outputs == [step.outputs for step in test.steps]


def test_a_csv_file_has_a_row_for_each_step() -> None:
    files = FORMATS["csv"]("toy", TESTS)
    assert sorted(files) == ["toy_001.csv", "toy_002.csv", "toy_goals.csv"]
    table = list(csv.DictReader(StringIO(files["toy_001.csv"])))
    assert [row["time_ms"] for row in table] == ["20", "40", "60", "80", "100", "120", "140"]
    assert [row["lit"] for row in table] == ["0", "1", "1", "1", "0", "0", "0"]
    assert {row["light_lx"] for row in table} == {"9"}


def test_an_output_left_open_is_an_empty_cell() -> None:
    test = kept_test(boards()["board1"], 0)
    first = next(csv.DictReader(StringIO(FORMATS["csv"]("board1", [test])[f"{test.name}.csv"])))
    assert first["targetAngle180"] == "" and first["v_ref"] != ""


def late_test(board: Board) -> BoardTest:
    """With stamps between the steps, and a clock that begins again."""
    random = Random(1)
    signals = [s for s in board.inputs if s.name != NOW]
    moments = [
        {s.name: random.choice((None, None, 0, 13)) if s.stamp else s.initial for s in signals}
        for _ in range(30)
    ]
    return expected(board, "late", steps(board, moments, CLOCK - 200))


@pytest.mark.parametrize("name", ["board1", "board2"])
def test_the_pytest_file_gives_the_inputs_of_the_test(name: str) -> None:
    test, module = late_test(boards()[name]), dict[str, Any]()
    exec(FORMATS["pytest"](name, [test])[f"test_cover_{name}.py"], module)
    played = module["played"](boards()[name], *module["TESTS"][name]["late"])
    assert list(played) == [(step.inputs, step.outputs) for step in test.steps]


@pytest.mark.parametrize("name", ["board1", "board2"])
def test_the_c_program_gives_the_inputs_of_the_test(tmp_path: Path, cc: str, name: str) -> None:
    test = late_test(boards()[name])
    required = replace(test, steps=tuple(replace(step, outputs={}) for step in test.steps))
    names = list(test.steps[0].inputs)
    shown = "".join(f'    printf("%.10g ", (double)in->{n});\n' for n in names)
    echo = (
        f'#include <stdio.h>\n#include "cover_{name}.h"\nvoid reset(void) {{}}\nvoid step(void) {{}}\n'
        "void get_outputs(struct outputs *out) { (void)out; }\n"
        f'void set_inputs(const struct inputs *in)\n{{\n{shown}    printf("\\n");\n}}\n'
    )
    written(tmp_path, dict(FORMATS["c"](name, [required])) | {"echo.c": echo})
    made = ran(cc, "-std=c99", f"cover_{name}.c", "echo.c", "-lm", "-o", "cover", cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    *lines, last = ran("./cover", cwd=tmp_path).stdout.splitlines()
    given = [dict(zip(names, map(float, line.split()), strict=True)) for line in lines]
    assert given == [step.inputs for step in test.steps]
    assert last == f"{name}: 1 of 1 tests passed"


@pytest.mark.parametrize(("least", "code", "said"), [(3, 0, "2 of 2 tests passed"), (4, 1, "in toy_001 at")])
def test_the_c_program_runs(tmp_path: Path, cc: str, least: int, code: int, said: str) -> None:
    written(tmp_path, dict(FORMATS["c"]("toy", TESTS)) | {"lamp.c": LAMP})
    strict = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", f"-DLEAST={least}")
    made = ran(cc, *strict, "cover_toy.c", "lamp.c", "-lm", "-o", "cover", cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    done = ran("./cover", cwd=tmp_path)
    assert done.returncode == code and said in done.stdout, done.stdout


@pytest.mark.parametrize("name", ["board1", "board2"])
def test_the_c_program_of_a_board_compiles(tmp_path: Path, cc: str, name: str) -> None:
    written(tmp_path, dict(FORMATS["c"](name, [kept_test(boards()[name], 0, most=5)])))
    made = ran(cc, "-std=c99", "-pedantic", "-Wall", "-Werror", "-c", f"cover_{name}.c", cwd=tmp_path)
    assert made.returncode == 0, made.stderr


def test_the_pytest_file_runs_against_our_supervisor_and_fails_for_another(tmp_path: Path) -> None:
    board = boards()["board1"]
    kept = kept_of(board, kept_text("board1")).tests
    test = kept_test(board, min(range(len(kept)), key=lambda k: len(kept[k][2])))
    wrong = tuple(replace(step, outputs={**step.outputs, "critical_mask": 255}) for step in test.steps)
    faulty = replace(test, name="faulty", steps=wrong)
    written(tmp_path, dict(FORMATS["pytest"]("board1", [test, faulty])))
    done = ran(sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path), cwd=tmp_path)
    assert "1 failed, 1 passed" in done.stdout, done.stdout + done.stderr
    assert "step 1 (20 ms)" in done.stdout and "critical_mask" in done.stdout
