"""Python classes: what they may ask for and give, and what is said of those that cannot be run."""

from contextlib import closing
from math import isinf

import pytest

from rovercheck.checker.adapters import AdapterLimits, start
from rovercheck.checker.adapters.firmware import places
from rovercheck.checker.adapters.implementation import ImplementationError, run
from rovercheck.checker.adapters.python import start as start_python
from rovercheck.checker.adapters.records import builder, reader
from rovercheck.spec_model.abstraction import boards
from rovercheck.supervisor import Board1, Board1Inputs, Board1Outputs, Board2, Board2Inputs, Board2Outputs
from rovercheck.supervisor.board2.actuation import Actuated, MotorCommand

BOARDS = boards()
LIMITS = AdapterLimits(step=60, start=120)
FIRMWARE = {
    "board1": (Board1, Board1Inputs, Board1Outputs),
    "board2": (Board2, Board2Inputs, Board2Outputs),
}
OPTIONAL = {"left_rpm", "right_rpm"}


@pytest.mark.parametrize("name", FIRMWARE)
def test_every_signal_has_its_place_in_our_firmware(name):
    board, (_, inputs, outputs) = BOARDS[name], FIRMWARE[name]
    assert set(places(board).inputs_of(inputs)) == {s.name for s in board.inputs}
    assert set(places(board).outputs_of(outputs)) == {o.name for o in board.outputs}
    assert builder(inputs, places(board).inputs_of(inputs))(board.at_power_up()) == inputs()
    given = reader(places(board).outputs_of(outputs))(outputs())
    assert set(given) == {o.name for o in board.outputs} - OPTIONAL
    held = list(places(board).inputs_of(inputs).values())
    assert len(set(held)) == len(held)


@pytest.mark.parametrize("name", FIRMWARE)
def test_every_input_reaches_its_own_place(name):
    """Set alone, each changes the record in one field, and another than all the others."""
    board, (_, inputs, _) = BOARDS[name], FIRMWARE[name]
    build, at_rest = builder(inputs, places(board).inputs_of(inputs)), board.at_power_up()
    built = {
        build({**at_rest, s.name: (not s.initial) if s.initial in (True, False) else 1}) for s in board.inputs
    }
    assert len(built) == len(board.inputs) and inputs() not in built


def test_what_is_not_sent_is_left_out():
    read = reader(places(BOARDS["board2"]).outputs_of(Board2Outputs))
    silent = read(Board2Outputs())
    sending = read(Board2Outputs(actuated=Actuated(False, motors=MotorCommand(4.0, -4.0))))
    assert not silent["sends_speeds"] and not OPTIONAL & set(silent)
    assert sending["sends_speeds"] and (sending["left_rpm"], sending["right_rpm"]) == (4.0, -4.0)


@pytest.mark.parametrize("name", FIRMWARE)
def test_our_firmware_runs_alike_here_and_apart(name):
    board, (made, _, _) = BOARDS[name], FIRMWARE[name]
    steps = [{**board.at_power_up(), "now_ms": 20 * k} for k in range(1, 400)]
    here = start_python(f"supervisor:{made.__name__}", board, isolated=False)
    with closing(start(f"python:supervisor:{made.__name__}", board, LIMITS)) as apart:
        assert run(apart, steps) == run(here, steps)


def opened(tmp_path, source, *, isolated=True):
    """A class ``S`` of the user's in a file, started."""
    file = tmp_path / "mine.py"
    file.write_text(source, encoding="utf-8")
    return closing(start_python(f"{file}:S", BOARDS["board1"], LIMITS, isolated=isolated))


def test_a_flat_dataclass_is_filled_by_name(tmp_path):
    source = """
from dataclasses import dataclass
from enum import Enum
class Cmd(Enum):
    NORMAL = 0
    ESTOP = 7
@dataclass
class In:
    x_norm: float
    cmd: Cmd
@dataclass
class Out:
    v_ref: float
    current_action: Cmd
class S:
    def step(self, inputs: In) -> Out:
        return Out(inputs.x_norm, inputs.cmd)
"""
    at_rest = BOARDS["board1"].at_power_up()
    with opened(tmp_path, source) as started:
        assert started.step({**at_rest, "x_norm": 0.5, "cmd": 7}) == {"v_ref": 0.5, "current_action": 7}
        with pytest.raises(ImplementationError, match="step 2: cmd = 6 is no Cmd"):
            started.step({**at_rest, "cmd": 6})


def test_numbers_of_numpy_are_numbers(tmp_path):
    source = """
import numpy as np
class S:
    def step(self, inputs):
        return {"v_ref": np.float32(0.5), "critical_mask": np.int8(3), "btn1": np.bool_(True)} | {
            "omega_ref": np.float64("inf")}
""".replace('"btn1"', '"invert_y"')
    with opened(tmp_path, source) as started:
        found = started.step({})
        assert isinf(found.pop("omega_ref"))
        assert found == {"v_ref": 0.5, "critical_mask": 3, "invert_y": True}
        assert {type(value) for value in found.values()} == {float, int, bool}


def test_what_a_class_leaves_in_its_module_ends_with_a_reset(tmp_path):
    """A power-up is one, whatever a class forgets to reset."""
    source = """
SEEN = []
class S:
    def step(self, inputs):
        SEEN.append(1)
        return {"critical_mask": len(SEEN)}
"""
    with opened(tmp_path, source) as started:
        assert [started.step({})["critical_mask"] for _ in range(2)] == [1, 2]
        started.reset()
        assert started.step({})["critical_mask"] == 1


def test_printing_does_no_harm_and_is_shown_when_it_fails(tmp_path):
    source = """
class S:
    def step(self, inputs):
        print("stepping")
        return {"v_ref": 1 / inputs["x_norm"]}
"""
    with opened(tmp_path, source) as started:
        assert started.step({"x_norm": 1.0}) == {"v_ref": 1.0}
        with pytest.raises(ImplementationError) as caught:
            started.step({"x_norm": 0.0})
    what, _, said = str(caught.value).partition("\n")
    assert what.endswith("step 2: ZeroDivisionError: float division by zero (mine.py, line 5).")
    assert said == "Its standard error ends with\n  stepping\n  stepping"


def test_there_is_nothing_to_read(tmp_path):
    """What we write to its process is not for the class."""
    source = "class S:\n  def step(self, i): return {'v_ref': len(open(0, closefd=False).read())}"
    with opened(tmp_path, source) as started:
        assert run(started, [{}, {}]) == [{"v_ref": 0}] * 2


@pytest.mark.parametrize("isolated", [True, False])
@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("class T: pass", "has no 'S'. Known: T."),
        ("S = 3", "S is no class; it is 3"),
        ("class S: pass", "has no method 'step'; write step(self, inputs) -> outputs"),
        ("class S:\n  def step(self): pass", "step takes no argument"),
        ("class S:\n  def __init__(self, n): pass\n  def step(self, i): pass", "missing 1 required"),
        ("import nix", "ModuleNotFoundError: No module named 'nix' (mine.py, line 1)"),
        ("class S(", "SyntaxError"),
        ("class S:\n  def step(self, i): return 3", "step 1: step returned 3; return a dict"),
        ("class S:\n  def step(self, i): return {}", "step 1: no output was answered"),
        ("class S:\n  def step(self, i): return {'v': 1}", "step 1: the board has no output 'v'"),
        ("class S:\n  def step(self, i): return {'v_ref': 'x'}", "step 1: v_ref = 'x', which is neither"),
        ("class S:\n  def step(self, i): return i['nix']", "step 1: KeyError: 'nix' (mine.py, line 2)"),
        ("class S:\n  def step(self, i: Unknown): return i", "NameError"),
    ],
)  # fmt: skip
def test_a_class_that_cannot_be_run(tmp_path, source, said, isolated):
    with pytest.raises(ImplementationError) as caught, opened(tmp_path, source, isolated=isolated) as started:
        started.step({})
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("python:supervisor", "names no class; write module:Class"),
        ("python:supervisr.board1:Board1", "there is no module 'supervisr'"),
        ("python:supervisor.bord1:Board1", "there is no module 'supervisor.bord1'"),
        ("python:supervisor:Bord1", "Did you mean 'Board1'?"),
        ("python:nowhere/mine.py:S", "there is no file nowhere/mine.py"),
    ],
)
def test_no_class(address, said):
    with pytest.raises(ImplementationError) as caught:
        start(address, BOARDS["board1"], LIMITS)
    assert said in str(caught.value)
