"""Elements of arrays, and what functions of MATLAB end and keep: the same in both readings."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.errors import ModelError
from tests.drawn.charts import logged, running

TABLE = "m = uint8([1 2 3; 4 5 6]);"


def matrix(folder: Path, during: str) -> ModelRunner:
    """A chart with a matrix of two rows, and an action."""

    def draw(c: WrittenChart) -> None:
        c.data("m", "local", "uint8", size="[2 3]")
        c.transition(None, c.state(f"A\nen: {TABLE} {during}\ndu: {during}"))

    return running(folder, draw)


def test_elements_are_counted_by_columns(tmp_path: Path) -> None:
    found = logged(matrix(tmp_path, "log = double(m(u));"), [1, 2, 3, 4, 5, 6])
    assert found == [1, 4, 2, 5, 3, 6]


def test_elements_are_written_by_columns(tmp_path: Path) -> None:
    found = logged(matrix(tmp_path, "m(u) = uint8(9); log = double(m(1, 2));"), [2, 3])
    assert found == [2, 9]


def test_a_whole_array_is_computed_before_it_is_written(tmp_path: Path) -> None:
    found = logged(
        matrix(tmp_path, "m = [m(2, :); m(1, :)]; log = double(m(1, 1)) * 10 + double(m(2, 1));"), [0, 0]
    )
    assert found == [41, 14]


@pytest.mark.parametrize("index", [0, 7])
def test_an_index_that_names_nothing_is_a_step_without_a_meaning(tmp_path: Path, index: int) -> None:
    runner = matrix(tmp_path, "log = double(m(u));")
    lowered = lowered_model(runner.model, "one.slx", {"u": fixed(0, 7, 1), "log": fixed(0, 9, 1)})
    with pytest.raises(ModelError):
        LoweredRun(lowered).step({"u": index})
    with pytest.raises(DrawnFault):
        runner.step({"u": index})


def test_a_matrix_has_the_type_of_its_integers(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state("A\nen: log = double(max([100 uint8(200)] + 100));"))

    assert logged(running(tmp_path, draw), [0]) == [255]


@pytest.mark.parametrize(("kind", "value"), [("int8", -6), ("uint8", 250)])
def test_all_bits_are_turned(tmp_path: Path, kind: str, value: int) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state(f"A\nen: log = double(bitcmp({kind}(5)));"))

    assert logged(running(tmp_path, draw), [0]) == [value]


def test_a_return_ends_its_function_and_not_what_called_it(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.function("y = f(x)", script="function y = f(x)\ny = 1;\nif x > 0\n return\nend\ny = 2;\nend\n")
        c.transition(None, c.state("A\nen, du: log = f(u); log = log * 10 + 3;"))

    assert logged(running(tmp_path, draw), [0, 1]) == [23, 13]


def test_persistent_variables_are_those_of_the_function_whoever_calls_it(tmp_path: Path) -> None:
    script = "function r = f()\npersistent p\nif isempty(p)\n p = 0;\nend\np = min(p + 1, 9);\nr = p;\nend\n"

    def draw(c: WrittenChart) -> None:
        c.function("r = f()", script=script)
        a, b = c.state("A\nen: log = f();"), c.state("B\nen: log = f();")
        c.transition(None, a)
        c.transition(a, b)
        c.transition(b, a)

    assert logged(running(tmp_path, draw), [0, 0, 0]) == [1, 2, 3]


def test_the_left_side_is_read_before_a_function_on_the_right_writes_it(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.data("n", "local", "uint8", 1)
        bump = c.function("y = bump()")
        c.data("y", "output", "uint8", holder=bump)
        c.transition(None, c.junction(bump), "{n = n + uint8(4); y = n;}")
        c.transition(None, c.state("A\nen: log = double(n + bump());"))

    assert logged(running(tmp_path, draw), [0]) == [6]
