"""Names and sentences of a user's model that no screen, shell or test runner could take."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.model.load import load
from rovercheck.checker.model.texts import HIDDEN
from rovercheck.spec_model.lang.errors import ModelError

MODEL = """
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import flag

go = flag({input!r})
chart = Chart("C", [State({state!r}, transitions=[to("B", when=go)]), State("B")], default={state!r})
P = always({id!r}, {text!r}, that=~chart.active("B"), covers={covers!r}, on="C")
"""
GOOD = {"input": "go", "state": "A", "id": "P-1", "text": "It stays.", "covers": ["R1"]}

REFUSED: dict[str, tuple[dict[str, object], str]] = {
    "an id with a blank": ({"id": "P 1"}, "m.py:8: 'P 1' can be no id of a property"),
    "an id for the shell": ({"id": "P>x"}, "'P>x' can be no id of a property"),
    "an option": ({"id": "-P"}, "'-P' can be no id of a property"),
    "no id": ({"id": ""}, "'' can be no id of a property"),
    "no sentence": ({"text": " \n"}, "m.py:8: P-1 has no sentence. Write in words what is meant."),
    "none": ({"text": None}, "P-1: text is None, nothing; write a text."),
    "a control sign": ({"text": "It \x1b[31mstays."}, "has signs that cannot be shown"),
    "right to left": ({"text": "It \u202estays."}, "has signs that cannot be shown"),
    "no character": ({"text": "It \ufdd0stays."}, "has signs that cannot be shown"),
    "no character of another plane": ({"state": "A\U0010ffff"}, "has signs that cannot be shown"),
    "a line in an input": ({"input": "g\no"}, "'C': 'g\\no' has signs that cannot be shown"),
    "a bell in a state": ({"state": "A\x07"}, "has signs that cannot be shown"),
    "requirements as one text": ({"covers": "R1"}, "P-1: covers='R1' is one text; write covers=['R1']."),
}


def model(folder: Path, **changes: object) -> Path:
    file = folder / "m.py"
    file.write_text(MODEL.format(**{**GOOD, **changes}), encoding="utf-8")
    return file


@pytest.mark.parametrize("wrong", REFUSED)
def test_what_cannot_be_shown_is_refused(
    wrong: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    changes, said = REFUSED[wrong]
    file = model(tmp_path, **changes)
    with pytest.raises(ModelError) as refused:
        load(file)
    assert said in str(refused.value)
    assert run(["list", "properties", "--model", str(file)]) == Exit.USAGE
    assert "Traceback" not in capfd.readouterr().err


def test_a_sentence_in_several_lines_is_put_on_one(tmp_path: Path) -> None:
    found = load(model(tmp_path, text="It stays\n::error::\r\n   where it is.\n")).properties["P-1"]
    assert found.text == "It stays ::error:: where it is."


def test_other_scripts_and_markup_are_names_as_well(tmp_path: Path) -> None:
    found = load(model(tmp_path, id="温度-1", input="ünï</script>", text='<b>🚒</b> "it\'s" ]]> --> $end */'))
    assert "温度-1" in found.properties


def test_every_noncharacter_is_hidden_and_its_neighbours_are_not() -> None:
    """U+FDD0 to U+FDEF, and the last two signs of every plane (Unicode 23.7): of these only two were."""
    ends = {plane << 16 | last for plane in range(17) for last in (0xFFFE, 0xFFFF)}
    none = {*range(0xFDD0, 0xFDF0), *ends}
    assert len(none) == 66 and all(HIDDEN.fullmatch(chr(n)) for n in none)
    beside = {n + by for n in none for by in (-1, 1) if n + by <= 0x10FFFF} - none
    assert not any(HIDDEN.fullmatch(chr(n)) for n in beside)
