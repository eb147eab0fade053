"""``rovercheck import --write``: an ordinary model in Python, which is compared with what is drawn first."""

import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.import_ import written as verb
from rovercheck.checker.commands.import_.equality import Equality, equality_of
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.drawn.charts.system import DrawnCharts, charts_of_model
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.export.source.layout import Commented, Lines, call, laid_out, listed, quoted
from rovercheck.checker.export.source.names import SourceNames
from rovercheck.checker.export.source.properties import WrittenNames, rewritten
from rovercheck.checker.model.drawn import read_simulink
from rovercheck.checker.model.load import load
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, State
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import var
from tests.drawn.test_diagram_runs import enabled
from tests.drawn.test_simulink_functions import counting
from tests.drawn.test_simulink_functions import written as simulink_function
from tests.simulink.by_hand.calls import CALLS

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "examples" / "simulink"
MICROWAVE = SAMPLES / "2_microwave" / "microwave.slx"
WRITTEN = (
    "1_lamp/lamp",
    "2_microwave/microwave",
    "3_crossing/crossing",
    "4_smoother/smoother",
    "5_tank/tank",
)


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Without the search for a proof, which the tests of it make."""
    monkeypatch.setattr(verb, "equality_of", lambda written, drawn, outputs: Equality(how="not asked here"))
    yield


def files(path: Path) -> verb.WrittenModel:
    lowered = read_simulink(path).lowered
    return verb.written_model(path, charts_of_model(lowered, path.name))


def test_the_microwave_is_written_and_keeps_its_verdicts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "oven"
    assert run(["import", str(MICROWAVE), "--write", str(folder)]) == Exit.AS_EXPECTED
    assert "proved, all 47,659 reachable states" in " ".join(capsys.readouterr().out.split())
    assert sorted(one.name for one in folder.iterdir()) == ["microwave.py", "microwave_properties.py"]
    assert [one.name for one in tmp_path.iterdir()] == ["oven"]
    model = load(folder)
    assert list(model.properties) == [f"OVEN-{n}" for n in range(1, 6)]
    [chart] = model.systems["microwave"].charts
    assert [".".join(path) for path in chart.states if path] == [
        "Idle", "Cooking", "Cooking.Heat", "Cooking.Rest", "Paused"
    ]  # fmt: skip


def test_labels_are_the_engineers_own_where_they_say_the_same() -> None:
    text = files(MICROWAVE).files["microwave.py"]
    assert 'to("Junction7", "[start && ~door]")' in text
    assert 'to("Rest", "[after(0.5, sec)]")' in text
    assert "        # du: left = left - 1\n" in text
    assert 'to("Cooking", "[minutes > 0] {left = minutes*7; bell = false}")' in text


def test_a_function_of_the_chart_is_a_formula_with_its_call_as_name() -> None:
    text = files(SAMPLES / "5_tank" / "tank.slx").files["tank.py"]
    assert 'to("Lost", "[isLost(clock_ms, taken_ms)]")' in text
    assert '"isLost(clock_ms, taken_ms)",' in text


def test_what_is_written_is_as_formatters_lay_it_out(tmp_path: Path) -> None:
    for name in WRITTEN:
        for file, text in files(SAMPLES / f"{name}.slx").files.items():
            (tmp_path / file).write_text(text, encoding="utf-8")
    for own in ("crossing", "tank", "microwave"):  # laid out by the hand that wrote them
        (tmp_path / f"{own}_properties.py").unlink()
    for arguments in (["check", "--ignore", "I001"], ["format", "--check"]):
        command = [sys.executable, "-m", "ruff", *arguments, "--isolated", str(tmp_path)]
        found = subprocess.run(command, capture_output=True, text=True, check=False)
        assert found.returncode == 0, found.stdout + found.stderr


def test_properties_to_begin_with_are_written_where_there_are_none(quick: None, tmp_path: Path) -> None:
    folder = tmp_path / "lamp"
    assert run(["import", str(SAMPLES / "1_lamp" / "lamp.slx"), "--write", str(folder)]) == 0
    assert list(load(folder).properties) == ["Lamp-1", "Lamp-2", "Lamp-3"]


RECORD = '["OVEN-3"]\nverdict = "violated"\nbecause = "The door is opened in the last second."\n'
HAZARD = """[H-BURN]
text = "A hand is burnt."
severity = "critical"
because = "It is hot."
requirements = ["R-2"]
"""


@pytest.mark.parametrize("own", ["baseline.toml", "microwave.baseline.toml"])
def test_what_is_on_record_beside_a_model_is_so_beside_the_written_one(
    quick: None, tmp_path: Path, own: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A finding that was accepted was a new one there."""
    for one in MICROWAVE.parent.iterdir():
        shutil.copy(one, tmp_path)
    (tmp_path / own).write_text(RECORD, encoding="utf-8")
    (tmp_path / "hazards.toml").write_text(HAZARD, encoding="utf-8")
    domains = "[domains]\nminutes = { values = [0, 1, 9] }\n"
    (tmp_path / "microwave.domains.toml").write_text(domains, encoding="utf-8")
    folder = tmp_path / "oven"
    assert run(["import", str(tmp_path / "microwave.slx"), "--write", str(folder)]) == 0
    written = load(folder)
    assert written.on_record == load(tmp_path / "microwave.slx").on_record
    assert written.on_record["OVEN-3"].because == "The door is opened in the last second."
    assert written.hazards.keys() == {"H-BURN"}
    assert (folder / "microwave.domains.toml").read_text(encoding="utf-8") == domains
    assert "oven/baseline.toml" in capsys.readouterr().err


def test_a_record_of_properties_that_are_not_copied_stays_behind(
    quick: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copy(MICROWAVE, tmp_path)
    text = (MICROWAVE.parent / "microwave_properties.py").read_text(encoding="utf-8")
    (tmp_path / "microwave_properties.py").write_text(f"{text}\nmore = [oven]\n", encoding="utf-8")
    (tmp_path / "baseline.toml").write_text(RECORD, encoding="utf-8")
    assert run(["import", str(tmp_path / "microwave.slx"), "--write", str(tmp_path / "oven")]) == 0
    told = " ".join("".join(capsys.readouterr()).split())
    assert "baseline.toml is not copied: it speaks of properties that are not." in told
    assert not (tmp_path / "oven" / "baseline.toml").exists()


# --- what is refused ---------------------------------------------------------------------------------------


def test_a_model_without_words_leaves_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    press = SAMPLES / "6_press" / "press.slx"
    assert run(["import", str(press), "--write", str(tmp_path / "new" / "press")]) == Exit.USAGE
    told = " ".join(capsys.readouterr().err.split())
    assert "Press is entered before the first step" in told
    assert "keep the .slx as the model" in told
    assert not (tmp_path / "new" / "press").exists()


def test_a_chart_with_simulink_functions_has_no_words(tmp_path: Path) -> None:
    """What was written had nothing in their place, and was told as an error of rovercheck."""
    path = simulink_function("A\nen, du: r = f(u);", {"y = f(a)": counting}).save(tmp_path / "one.slx")
    with pytest.raises(NotLowered, match=r"C has the Simulink function f \(SSID 5\): write it as a MATLAB"):
        files(path)


def test_states_that_begin_anew_and_generated_calls_have_no_words(tmp_path: Path) -> None:
    anew = enabled(tmp_path, StatesWhenEnabling="reset").model
    with pytest.raises(NotLowered, match="the states of Sub begin anew when it is enabled: set that to held"):
        charts_of_model(lowered_model(anew, "one.slx"), "one.slx")
    [generator] = [one for one in CALLS if one.name == "generator"]
    with pytest.raises(NotLowered, match="it generates function calls: have what it calls executed in each"):
        files(generator.draw().save(tmp_path / "two.slx"))


def test_a_folder_with_something_in_it_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mine.txt").write_text("kept", encoding="utf-8")
    assert run(["import", str(MICROWAVE), "--write", str(tmp_path)]) == Exit.USAGE
    assert "is not empty. Nothing is overwritten" in " ".join(capsys.readouterr().err.split())
    assert [one.name for one in tmp_path.iterdir()] == ["mine.txt"]


def test_an_empty_folder_is_taken(quick: None, tmp_path: Path) -> None:
    assert run(["import", str(SAMPLES / "1_lamp" / "lamp.slx"), "--write", str(tmp_path)]) == 0
    assert (tmp_path / "lamp.py").exists()


def test_what_does_otherwise_than_drawn_is_told_and_not_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As if the writer had an error: a bell that is never rung."""
    own = verb.written_model

    def wrong(path: Path, drawn: DrawnCharts) -> verb.WrittenModel:
        made = own(path, drawn)
        changed = {name: text.replace("/bell = true;", "/bell = false;") for name, text in made.files.items()}
        assert changed != made.files
        return replace(made, files=changed)

    monkeypatch.setattr(verb, "written_model", wrong)
    assert run(["import", str(MICROWAVE), "--write", str(tmp_path / "oven")]) == Exit.USAGE
    told = " ".join(capsys.readouterr().err.split())
    assert "does otherwise than what is drawn" in told and "bell is 1 and 0" in told
    assert list(tmp_path.iterdir()) == []


def test_a_difference_of_states_alone_is_found() -> None:
    lowered = read_simulink(MICROWAVE).lowered
    system = charts_of_model(lowered, MICROWAVE.name).model.system
    [chart] = system.charts
    idle, cooking, paused = chart.root.states
    again = replace(chart.root, states=(idle, cooking, replace(paused, transitions=())))
    changed = replace(system, components=(chart.with_root(again),))
    assert "of a random run, in Oven" in equality_of(changed, lowered.system, {}, 5).difference


def test_a_proof_speaks_of_all_data_and_outputs_or_it_is_none() -> None:
    """It was called proved where data had no counterpart, or an output was a formula, too."""
    lowered = read_simulink(MICROWAVE).lowered
    system = charts_of_model(lowered, MICROWAVE.name).model.system
    assert equality_of(system, lowered.system, {}).proved
    new = var("new", integer(0, 3))
    other = replace(lowered.system, components=(*lowered.system.components, Block("B", [assign(new, 1)])))
    assert equality_of(system, other, {}).how == (
        "no proof speaks of new, which the written model has otherwise"
    )
    bell, heating = (lowered.outputs[name] for name in ("bell", "heating"))
    found = equality_of(system, lowered.system, {"bell": (bell & heating, bell)})
    assert "of a random run, in bell" in found.difference


def test_other_options_are_refused_beside_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["import", str(MICROWAVE), "--write", str(tmp_path / "a"), "--json"]) == Exit.USAGE
    assert "--write goes with --beside alone" in capsys.readouterr().err
    door = ROOT / "examples" / "scxml" / "door.scxml"
    assert run(["import", str(door), "--write", str(tmp_path / "a")]) == Exit.USAGE
    assert "--write" in capsys.readouterr().err and not (tmp_path / "a").exists()


# --- properties --------------------------------------------------------------------------------------------

NAMES = WrittenNames(
    "import heater", "heater", {"on": "on", "open": "open_", "Valve.level": "Valve_level"},
    {"Valve": ("valve", Chart("Valve", [State("A", states=[State("B")], default="B")], default="A"))},
)  # fmt: skip
HEAD = "from rovercheck import always, simulink_model\n\nmodel = simulink_model('a.slx')\n"


@pytest.mark.parametrize(
    ("text", "made"),
    [
        ("x = model['open'] & model.active('Valve/A/B')", 'x = model.open_ & model.valve.active("A.B")'),
        ("é = model['on']; y = model['Valve.level']", "é = model.on; y = model.Valve_level"),
        ("a, b = (model[n] for n in ('on', 'open'))", "a, b = (model.on, model.open_)"),
        ("[a] = [model[n] for n in ['on']]", "[a] = [model.on,]"),
        ("always(on=model.system)", "always(on=model.heater)"),
    ],
)
def test_properties_speak_of_the_written_model(text: str, made: str) -> None:
    wanted = f"import heater as model\n\nfrom rovercheck import always\n\n{made}\n"
    assert rewritten(f"{HEAD}{text}\n", NAMES) == wanted


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("x = model['opne']", "line 4: opne is no variable of the written model. Did you mean 'open'"),
        ("x = model.chart('Valve')", "line 4: `model` is used otherwise than as model[NAME]"),
        ("x = model.active('Q')", "line 4: no chart has one state 'Q'"),
        ("x = model.active(y)", "line 4: the names of its states are no plain texts"),
        ("x = (", "it is no Python"),
    ],
)
def test_properties_that_cannot_be_written_anew_are_told_with_their_line(text: str, told: str) -> None:
    with pytest.raises(ModelError) as error:
        rewritten(f"{HEAD}{text}\n", NAMES)
    assert told in str(error.value)


# --- source ------------------------------------------------------------------------------------------------


def test_calls_are_laid_out_as_formatters_do() -> None:
    short = call("to", quoted("On"), quoted("[a]"))
    assert laid_out(short, before="x = ", after=",") == ['x = to("On", "[a]"),']
    long = call("State", quoted("On"), Lines(("entry: a = 1", "b = 2")), listed([Commented(("why",), short)]))
    assert laid_out(long) == [
        "State(", '    "On",', '    """entry: a = 1', '       b = 2""",', "    [", "        # why",
        '        to("On", "[a]"),', "    ],", ")",
    ]  # fmt: skip


@pytest.mark.parametrize(("text", "shown"), [("a", '"a"'), ('a"b', "'a\"b'"), ("a'b", '"a\'b"')])
def test_a_text_stands_in_quotes(text: str, shown: str) -> None:
    assert quoted(text) == shown


def test_names_that_python_takes_for_one_are_apart() -> None:
    """A ligature is read as its letters."""
    names = SourceNames([])
    assert [names.variable(one) for one in ("fi", "\ufb01", "a\u00b2")] == ["fi", "fi_", "a2"]


@pytest.mark.parametrize("stem", ["test_lamp", "lamp_test", "conftest", "2 lamps", "class", "a_properties"])
def test_a_model_of_any_name_can_be_loaded(quick: None, tmp_path: Path, stem: str) -> None:
    """Files of pytest are no part of a model; they were written under such names."""
    copy = tmp_path / f"{stem}.slx"
    copy.write_bytes((SAMPLES / "1_lamp" / "lamp.slx").read_bytes())
    assert sorted(files(copy).files) != [f"{stem}.py"]
    folder = tmp_path / "written"
    assert run(["import", str(copy), "--write", str(folder)]) == Exit.AS_EXPECTED
    assert len(load(folder).properties) == 3


def test_each_thing_has_a_name_of_its_own() -> None:
    names = SourceNames(["to"])
    found = [names.variable(one) for one in ("probe.level", "probe_level", "open", "to", "1st", "class")]
    assert found == ["probe_level", "probe_level_", "open_", "to_", "_1st", "class_"]
    assert [names.constant("LampColour"), names.thing("TopLevel")] == ["LAMP_COLOUR", "top_level"]
