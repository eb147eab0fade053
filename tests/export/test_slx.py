"""Charts that are written as models of Simulink: what is read of the files does the same, step by step."""

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.drawn.lower.domains import read_domains
from rovercheck.checker.export.slx import simulink_of
from rovercheck.checker.model.drawn import read_simulink
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, State, Transition
from rovercheck.spec_model.lang.domain import fixed, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Operand, Var, flag, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.transition import to
from rovercheck.spec_model.lang.words import after, duration, minimum
from tests.export.slx_runs import ROWS, differences, random_system
from tests.profiles import full

SYSTEMS = 120 if full() else 12


@pytest.mark.parametrize("part", range(2))
def test_a_random_system_read_again_does_the_same(tmp_path: Path, part: int) -> None:
    alike = 0
    for seed in range(part, SYSTEMS, 2):
        try:
            assert differences(random_system(seed), tmp_path, seed) == ROWS
            alike += 1
        except ModelError as error:
            assert "enters it again" in str(error)
    assert alike * 10 >= SYSTEMS // 2 * 8


def count(name: str, data: Var, transitions: Sequence[Transition] = ()) -> Chart:
    """A chart that counts its executions up to 9."""
    do = [assign(data, minimum(data + 1, 9))]
    return Chart(
        name, [State(f"On{name}", entry=do, during=do, transitions=transitions)], default=f"On{name}"
    )


def put(data: Var, value: Operand) -> Block:
    return Block(f"{data.name} becomes {value}", [assign(data, value)])


A, B, C = (var(name, integer(0, 9)) for name in "abc")
GO, ON = flag("go"), flag("on")


@pytest.mark.parametrize(
    "components",
    [
        pytest.param([Enabled(GO, count("F", A)), count("G", B)], id="first"),
        pytest.param([Enabled(GO & (B < 5), count("F", A)), count("G", B)], id="by what is executed later"),
        pytest.param([count("G", B), Enabled(B > 3, Enabled(GO | ON, count("F", A)))], id="nested"),
        pytest.param([count("F", A), Enabled(GO, put(A, 0))], id="written before"),
        pytest.param([Enabled(GO, count("F", A)), put(B, A)], id="read after"),
        pytest.param(
            [
                Enabled(GO, put(A, 1)),
                Enabled(ON, put(A, 2)),
                count("F", C),
            ],
            id="two write",
        ),
        pytest.param(
            [
                Enabled(GO, Enabled(ON, put(A, 1)), put(B, A)),
                count("F", A),
            ],
            id="written in two and after",
        ),
        pytest.param(
            [
                count("G", B, transitions=[to("OnG", after(3 * ticks))]),
                Enabled(count("G", B).active("OnG") & GO, count("F", A)),
            ],
            id="by a state",
        ),
    ],
)
def test_enabled_subsystems_do_the_same_in_simulink(tmp_path: Path, components: list[Component]) -> None:
    system = in_order("Room", *components)
    assert differences(system, tmp_path, 1) == ROWS
    [*subsystems] = (one for one in simulink_of(system).model.root.blocks if "enable" in one.ports)
    assert len(subsystems) == sum(isinstance(one, Enabled) for one in components)


def test_timers_count_the_steps_of_an_enabled_subsystem(tmp_path: Path) -> None:
    """Its steps are longer than those of the model, so that seconds would be others."""
    states = [
        State("Off", transitions=[to("On", after(40 * ms))]),
        State("On", transitions=[to("Off", duration(ON) > 60 * ms)]),
    ]
    system = in_order(
        "Room", Enabled(GO, Chart("Lamp", states, default="Off")), count("F", A), tick_ms=5, step_ms=20
    )
    assert differences(system, tmp_path, 1) == ROWS


def test_steps_that_are_no_decimals_are_written_as_fractions(tmp_path: Path) -> None:
    axis = var("axis", fixed(-1, 1, Fraction(1, 3)))
    assert differences(in_order("Room", put(axis, -axis)), tmp_path, 1) == ROWS
    assert read_domains(tmp_path / "random.domains.toml").domains["axis"] == axis.domain


@pytest.mark.parametrize("seed", [3, 5, 7, 12])
def test_a_random_system_written_in_python_again_does_the_same(tmp_path: Path, seed: int) -> None:
    """Out of the charts into a file of Simulink, and out of that into charts again."""
    assert differences(random_system(seed), tmp_path, seed, written=True) == ROWS


def test_the_verb_writes_a_model_that_can_be_read(tmp_path: Path) -> None:
    assert run(["export", "--system", "receiver", "--format", "slx", "-o", str(tmp_path)]) == 0
    assert read_simulink(tmp_path / "receiver.slx")["sender_position"] is not None


def test_the_verb_takes_one_system(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "PB1-15", "--format", "slx"]) == 4
    assert "write --system NAME" in capsys.readouterr().err
