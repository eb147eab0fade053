"""Blocks, functions and expressions without an exact meaning are free inputs, where a person agrees."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.drawn.free import freed
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.model.drawn import read_simulink
from rovercheck.checker.model.two_readings import compared_readings
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from tests.simulink.known.packages import ChartText

HEATER = """
free = ["Plant/Lag"]

[domains]
"Plant/Lag" = { low = 0, high = 40, resolution = 5 }
"""
PROPERTIES = """
from rovercheck import always, implies, reachable, simulink_model

oven = simulink_model("oven.slx")
heat, over = oven["heat"], oven["over"]

PROPERTIES = [
    always("H-1", "It does not heat above 30 degrees.", that=implies(over, ~heat), covers=["R"],
           on=oven.system),
    always("H-2", "It is never above 30 degrees.", that=~over, covers=["R"], on=oven.system),
    reachable("H-3", "It heats.", that=heat, covers=["R"], on=oven.system),
]
REQUIREMENTS = {"R": "It heats."}
"""


def heater(folder: Path) -> Path:
    """A chart that heats what a transfer function, in a subsystem, stands for."""
    model = WrittenModel("oven")
    plant, inside = model.root.subsystem("Plant", 1, 1)
    lag = inside.block("TransferFcn", "Lag", {"in": 1, "out": 1}, {}, Denominator="[1 1]")
    inside.line(inside.inport("power", 1), lag)
    inside.line(lag, inside.outport("temperature", 1))
    block, chart = model.root.chart("Guard")
    cold = chart.state("Cold\nen: heat = true; over = false;")
    hot = chart.state("Hot\nen: heat = false; over = true;")
    for name, scope, kind in (
        ("t", "input", "double"),
        ("heat", "output", "boolean"),
        ("over", "output", "boolean"),
    ):
        chart.data(name, scope, kind)
    chart.transition(None, cold)
    chart.transition(cold, hot, "[t > 30]")
    chart.transition(hot, cold, "[t < 20]")
    model.root.line(model.root.inport("power", 1, OutDataTypeStr="boolean"), plant)
    model.root.line(plant, block)
    for number, name in enumerate(("heat", "over"), 1):
        model.root.line(f"{block}/{number}", model.root.outport(name, number))
    return model.save(folder / "oven.slx")


def said(capsys: pytest.CaptureFixture[str]) -> str:
    return " ".join(capsys.readouterr().out.split())


def test_a_block_is_refused_until_it_is_free(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = heater(tmp_path)
    assert run(["import", str(path)]) is Exit.INCONCLUSIVE
    assert "name it under `free` in the file of domains" in said(capsys)
    (tmp_path / "oven.domains.toml").write_text(HEATER, encoding="utf-8")
    assert run(["import", str(path)]) is Exit.AS_EXPECTED
    told = said(capsys)
    assert "Plant/Lag is a free input: wherever it is computed it has any value of its domain" in told
    assert "the direct interpreter gives the same" in told
    assert run(["import", str(path), "--strict"]) is Exit.INCONCLUSIVE
    assert "it is continuous time" in said(capsys)


def test_verdicts_say_that_they_rest_on_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A proof is for all values, and a run may be none of the model."""
    path = heater(tmp_path)
    (tmp_path / "oven.domains.toml").write_text(HEATER, encoding="utf-8")
    (tmp_path / "oven_properties.py").write_text(PROPERTIES, encoding="utf-8")
    run(["check", "--model", str(path), "--verbose", "--no-premises"])
    told = said(capsys)
    assert "reachable states of oven, for all values of Plant/Lag" in told
    assert told.count("Plant/Lag may have a value that the model does not give") == 2
    assert run(["trace", "H-2", "--model", str(path)]) is Exit.AS_EXPECTED
    shown = capsys.readouterr()
    assert "Plant/Lag = 35" in shown.out
    assert "Note: Plant/Lag may have a value that the model does not give." in " ".join(shown.err.split())


def test_its_domain_is_asked_for_and_proposed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = heater(tmp_path)
    domains = tmp_path / "oven.domains.toml"
    domains.write_text('free = ["Plant/Lag"]\n', encoding="utf-8")
    assert run(["import", str(path)]) is Exit.AS_EXPECTED
    assert "no domain is given for Plant/Lag" in said(capsys)
    assert run(["import", str(path), "--propose-domains", "--force"]) is Exit.AS_EXPECTED
    text = domains.read_text(encoding="utf-8")
    assert 'free = ["Plant/Lag"]' in text
    assert '"Plant/Lag" = { values = [19, 20, 21, 29, 30, 31] }  # only compared, with 20, 30' in text
    assert run(["import", str(path)]) is Exit.AS_EXPECTED
    assert "It can be checked, as a system with 1 input" in said(capsys)


def drawn(text: ChartText, folder: Path, *free: str) -> DrawnModel:
    return freed(text.read(folder), free)


SINES = ChartText(
    "sines",
    """
    in x int8
    out y double
    out n int8
    out same boolean
    local k int8
    -> A
    state A: du: y = 0; n = int8(0); same = sin(x) == sin(x);\\nfor k = 1:2\\ny = y + sin(x * k);\\nend
    state B: en: n = int8(round(10 * sqrt(x / 3)));
    A -> B: [x > 3 && sin(x) > 0.5]
    B -> A: [x < 3]
    """,
    "MATLAB",
)


def test_each_call_of_a_function_is_a_value_of_its_own(tmp_path: Path) -> None:
    """Two of one step need not be alike, as their arguments are not; the readings agree where they are."""
    domains = {"sin": fixed(-1, 1, "0.5"), "sqrt": fixed(0, 10, "0.5"), "y": fixed(-2, 2, "0.5")}
    made = lowered_model(drawn(SINES, tmp_path, "sin", "sqrt"), "sines.slx", domains)
    sines = {name: of for name, of in made.free.items() if name.startswith("sin")}
    assert sines == dict.fromkeys(
        ("sin", "sin 2", "sin 3", "sin 4", "sin 5"), "sin"
    )  # that of the guard, too
    assert [name for name in made.inputs if name.startswith("sqrt")] == ["sqrt"]
    found = compared_readings(made, 1.0)
    assert found.difference is None and found.steps == 1000
    assert [note for note in made.notes if "sqrt is a free input" in note]


def test_a_function_is_refused_until_it_is_free_and_its_range_is_proposed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = SINES.save(tmp_path, "R2024a")
    assert run(["import", str(path)]) is Exit.INCONCLUSIVE
    assert "A function of MATLAB may be named under `free` in the file of domains" in said(capsys)
    domains = tmp_path / "sines.domains.toml"
    domains.write_text('free = ["sin", "sqrt"]\n[domains]\ny = { low = -4, high = 4 }\n', encoding="utf-8")
    assert run(["import", str(path), "--propose-domains", "--force"]) is Exit.AS_EXPECTED
    assert "sin = { low = -1, high = 1, resolution = 0.125 }" in domains.read_text(encoding="utf-8")


def test_two_values_of_one_step_may_differ(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = SINES.save(tmp_path, "R2024a")
    (tmp_path / "sines.domains.toml").write_text(
        'free = ["sin", "sqrt"]\n[domains]\nsin = { low = -1, high = 1, resolution = 0.5 }\n'
        "sqrt = { low = 0, high = 10, resolution = 0.5 }\ny = { low = -4, high = 4, resolution = 0.5 }\n",
        encoding="utf-8",
    )
    (tmp_path / "sines_properties.py").write_text(
        "from rovercheck import reachable, simulink_model\n"
        'm = simulink_model("sines.slx")\n'
        'PROPERTIES = [\n    reachable("S-1", "Big.", that=m["y"] >= 2, covers=["R"], on=m.system),\n'
        '    reachable("S-2", "Too big.", that=m["y"] > 2, covers=["R"], on=m.system),\n'
        '    reachable("S-3", "Unlike.", that=~m["same"] & (m["y"] == 1), covers=["R"], on=m.system),\n]\n'
        'REQUIREMENTS = {"R": "Sums."}\n',
        encoding="utf-8",
    )
    run(["check", "--model", str(path), "--verbose", "--no-premises"])
    told = said(capsys)
    assert "S-1 proved reached in" in told and "S-3 proved reached in" in told
    assert "S-2 violated never" in told


DIVIDED = """
    in a int16
    in b int16
    out y int8
    -> A
    state A: du: y = int8({});
"""


@pytest.mark.parametrize(
    ("language", "written"), [("MATLAB", "double(a)/double(b)"), ("C bits", "power(a, b)")]
)
def test_an_expression_is_free_as_it_is_written(tmp_path: Path, language: str, written: str) -> None:
    chart = ChartText("one", DIVIDED.format(written), language)
    spaced = written.replace("/", " / ").replace(",", " ,")
    made = lowered_model(drawn(chart, tmp_path, spaced), "one.slx", {spaced: fixed(-4, 4, "0.5")})
    assert len(made.inputs) == 3
    assert compared_readings(made, 0.5).difference is None


@pytest.mark.parametrize(
    ("free", "message"),
    [
        ("Plant/Leg", "free: nothing that is executed computes"),
        ("Guard/", "it is no expression"),
        ("t", "is not computed"),
        ("power", "gives no value of its own"),
        ("sin", "nothing that is executed computes sin"),
        ("Plant/power", "gives no value of its own"),
    ],
)
def test_what_cannot_be_free_is_told(tmp_path: Path, free: str, message: str) -> None:
    path = heater(tmp_path)
    text = f'free = ["Plant/Lag", "{free}"]\n{HEATER.partition("]")[2]}\n"{free}" = {{ low = 0, high = 1 }}\n'
    (tmp_path / "oven.domains.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=message):
        read_simulink(path)


def test_a_whole_matlab_function_is_free_with_its_types(tmp_path: Path) -> None:
    """Its script, which cannot be read, does not matter any more."""
    model = WrittenModel("fit")
    block, script = model.root.chart(
        "Fit", "MATLAB Function", "function [ok, level] = fit(u)\n ok = svd(u) {\n"
    )
    script.data("u", "input")
    script.data("ok", "output", "boolean")
    script.data("level", "output", "uint8")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    model.root.line(f"{block}/1", model.root.outport("ok", 1))
    model.root.line(f"{block}/2", model.root.outport("level", 2))
    path = model.save(tmp_path / "fit.slx")
    with pytest.raises(ModelError, match="Fit"):
        read_simulink(path)
    (tmp_path / "fit.domains.toml").write_text('free = ["Fit"]\n', encoding="utf-8")
    inputs = read_simulink(path).lowered.inputs
    assert {str(one.domain) for name, one in inputs.items() if name != "u" and isinstance(one, Var)} == {
        "boolean", "integer in 0..255"
    }  # fmt: skip


def test_what_a_chart_calls_is_not_free(tmp_path: Path) -> None:
    """It may be executed several times in a step, each time with another value."""
    model = WrittenModel("calls")
    block, chart = model.root.chart("Caller")
    inside = model.root.simulink_function(chart, "y = f(u)")
    sine = inside.block("Trigonometry", "Sine", {"in": 1, "out": 1})
    inside.line(inside.block("ArgIn", "u", {"out": 1}), sine)
    chart.data("y", "output", "double")
    chart.transition(None, chart.state("A\ndu: y = f(1);"))
    model.root.line(block, model.root.outport("y", 1))
    read_path = model.save(tmp_path / "calls.slx")
    (tmp_path / "calls.domains.toml").write_text('free = ["Caller/f/Sine"]\n', encoding="utf-8")
    with pytest.raises(ModelError, match="perhaps several times in a step"):
        read_simulink(read_path)
