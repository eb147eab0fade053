"""``rovercheck import`` tells what a package has and what of it has no meaning, at any width and as JSON."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.drawn.refused import BLOCKS, CALLS, DrawingNote, notes_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenJunction
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.cli.test_widths import at_terminal, too_long
from tests.schemas import published
from tests.simulink.samples import SAMPLES, package_of

DRAWN = Draft202012Validator(published("import-1"))


def everything() -> WrittenModel:
    """A model with all that has no meaning here, each once."""
    model = WrittenModel("everything", machine={"SHARED": {"scope": "LOCAL_DATA", "dataType": "double"}})
    for kind in BLOCKS:
        model.root.block(kind, f"a/{kind}\nblock")
    _, below = model.root.subsystem("Upper", 1, 1)
    _, chart = below.chart("Odd/one", more={
        "enableNonTerminalStates": 1, "updateMethod": "CONTINUOUS",
    })  # fmt: skip
    outer = chart.state("Outer")
    inner = chart.state("Inner", outer)
    chart.state("Leaf", inner)
    chart.state("Region", inner, order=1)
    chart.transition(inner, None, "E [x]\n{y = 1;}")
    chart.state("Part", outer, inside={"simulink": {"isComponent": 1, "blockName": "Part"}})
    chart.state("Act", outer, inside={"simulink": {"isActionSubsystem": 1, "blockName": "Act"}})
    chart.data("queue", "local", "uint8", inside={"message": {"isMessage": 1}})
    chart.data("scaled", "local", "fixdt(1,16,4)", holder=inner)
    chart.data("old", "local", "sfix16_En4")
    chart.data("text", "output", "string")
    chart.data("long", "output", "stringtype(20)")
    return model


@pytest.fixture
def odd(tmp_path: Path) -> Path:
    return everything().save(tmp_path / "everything.slx")


# --- what has no meaning here ------------------------------------------------------------------------------

CHART = "Upper/Odd//one"
FREELY = " Or name it under `free` in the file of domains, to have any value."
EXPECTED = [
    (CHART, "the chart", None, "it has super step semantics. Switch it off in the properties of the chart."),
    (CHART, "the chart", None, "it has an update in continuous time. Make it discrete, or inherited."),
    (CHART, "the datum queue", 8, "it is a message, with a queue. Use an event, or a datum and a counter."),
    (
        f"{CHART}/Outer/Inner", "its states", 2,
        "exclusive and parallel states in one level. Draw one kind of them.",
    ),
    (
        f"{CHART}/Outer/Inner", "the datum scaled", 9,
        "fixdt(1,16,4) is a fixed-point type. Use a type of integers, and scale in the chart.",
    ),
    (
        CHART, "the datum old", 10,
        "sfix16_En4 is a fixed-point type. Use a type of integers, and scale in the chart.",
    ),
    (CHART, "the datum text", 11, "it is a string. Use an enumeration."),
    (CHART, "the datum long", 12, "it is a string. Use an enumeration."),
    (
        f"{CHART}/Outer", "the state Part", 6,
        "it is an atomic subchart: it is a link to a library, or is not in the file. Break the link, and "
        "save the model again.",
    ),
    (
        f"{CHART}/Outer", "the state Act", 7,
        "its action is a Simulink subsystem. Call a Simulink function in place of it.",
    ),
    (
        "everything", "the datum SHARED", None,
        "it is of all charts together. Give each chart its own, and connect them.",
    ),
    *(
        (f"a//{kind} block", f"{kind} block {number}", None, f"it is {way}.{'' if kind in CALLS else FREELY}")
        for number, (kind, way) in enumerate(BLOCKS.items(), 1)
    ),
]  # fmt: skip


def told(note: DrawingNote) -> tuple[str, str, int | None, str]:
    number = None if note.what == "the datum SHARED" else note.ssid
    return note.where, note.what, number, note.text


def test_all_that_has_no_meaning_is_told_with_its_place_and_a_way_around_it(odd: Path) -> None:
    notes = list(notes_of(read_model(odd)))
    refused = [note for note in notes if note.kind == "refused"]
    assert sorted(map(told, refused), key=str) == sorted(EXPECTED, key=str)
    (dangling,) = [note for note in notes if note.kind == "otherwise"]
    assert told(dangling) == (
        f"{CHART}/Outer", "the transition `E [x] {y = 1;}`", 5, "it leads nowhere, and is left out."
    )  # fmt: skip
    assert all(note.line > 0 for note in notes if note.what != "the chart")
    assert all(note.part.startswith("simulink/") for note in notes if note.what != "the datum SHARED")


def test_a_transition_to_what_is_no_state_and_no_junction_is_refused(tmp_path: Path) -> None:
    model = WrittenModel("ends")
    chart = model.root.chart("Ends")[1]
    state = chart.state("S")
    chart.transition(state, WrittenJunction(99, chart), "[x]")
    (note,) = notes_of(read_model(model.save(tmp_path / "ends.slx")))
    assert str(note) == (
        "Ends, the transition `[x]` (SSID 2): SSID 99 at an end of it is no state and no junction. Draw it "
        "to one of them."
    )
    assert note.kind == "refused"


def test_every_note_is_in_the_text_and_the_exit_code_is_two(
    odd: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["import", str(odd)]) is Exit.INCONCLUSIVE
    said = " ".join(capsys.readouterr().out.split())
    refused, _, otherwise = said.partition("Read otherwise than drawn:")
    for where, what, number, text in EXPECTED:
        ssid = f" (SSID {number})" if number is not None else ""
        assert f"✗ {where}, {what}" in refused and f"{ssid}: {text}" in refused
    assert f"• {CHART}/Outer, the transition `E [x] {{y = 1;}}` (SSID 5): it leads nowhere" in otherwise


# --- JSON --------------------------------------------------------------------------------------------------


def as_json(path: Path, capsys: pytest.CaptureFixture[str]) -> Any:
    code = run(["import", str(path), "--json"])
    document = json.loads(capsys.readouterr().out)
    DRAWN.validate(document)
    assert document["exit"] == code
    return document


@pytest.mark.parametrize("sample", SAMPLES)
def test_an_example_is_a_document_of_the_published_schema(
    sample: str, capsys: pytest.CaptureFixture[str]
) -> None:
    document = as_json(package_of(sample), capsys)
    assert (document["exit"], document["notes"]) == (0, [])
    model = read_model(package_of(sample))
    assert [chart["path"] for chart in document["model"]["charts"]] == [chart.path for chart in model.charts]


def test_what_has_no_meaning_is_in_the_document_too(odd: Path, capsys: pytest.CaptureFixture[str]) -> None:
    document = as_json(odd, capsys)
    assert document["exit"] == Exit.INCONCLUSIVE
    texts = [note["text"] for note in document["notes"]]
    drawn = [note.text for note in notes_of(read_model(odd))]
    assert texts[: len(drawn)] == drawn
    assert [text.partition(" is no")[0] for text in texts[len(drawn) :]] == ["E", "x", "y"], "unknown names"


def _far(model: WrittenModel) -> None:
    model.root.block("Gain", "g", Position="[1e999, -9e99, 1, 2, 3, 4, 5]")


def _long(model: WrittenModel) -> None:
    chart = model.root.chart("C")[1]
    chart.state("S", more={"position": "[1 2 3 4 5 6 7]"})
    junction = chart.junction()
    junction.more = {"position": "[1 2 3 4]"}
    chart.transition(None, junction, more={"midPoint": "[1 2 3]"})


@pytest.mark.parametrize("draw", [_far, _long])
def test_numbers_of_drawings_that_are_none_or_too_many_are_in_no_document(
    draw: Callable[[WrittenModel], None], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = WrittenModel("numbers")
    draw(model)
    as_json(model.save(tmp_path / "numbers.slx"), capsys)


# --- terminals ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("columns", [60, 80, 120])
def test_nothing_is_cut_at_a_terminal(columns: int, odd: Path) -> None:
    seen = at_terminal(columns, "import", str(odd)).seen
    assert too_long(seen, columns) == []
    words = set(re.sub(r"\s+", " ", seen).split())
    for where, what, _, text in EXPECTED:
        assert {*where.split(), *what.split(), *text.split()} <= {*words, *(w.strip(",:") for w in words)}


@pytest.mark.parametrize("columns", [60, 80, 120])
def test_an_example_is_told_without_a_word_cut(columns: int) -> None:
    seen = at_terminal(columns, "import", str(package_of("5_tank"))).seen
    assert too_long(seen, columns) == []
    assert {"Actuation/Valve", "LEVEL_LOST", "taken_ms", "(uint32).", "transitions"} <= {
        word.strip(":,") for word in seen.split()
    }


def test_strictly_nothing_is_read_with_a_note_or_without_its_domain(tmp_path: Path) -> None:
    package = str(package_of("2_microwave"))
    assert run(["import", package, "--strict"]) == Exit.AS_EXPECTED
    for file in package_of("5_tank").parent.iterdir():
        if file.is_file() and not file.name.endswith(".domains.toml"):
            (tmp_path / file.name).write_bytes(file.read_bytes())
    tank = tmp_path / "tank.slx"
    assert run(["import", str(tank)]) == Exit.AS_EXPECTED
    assert run(["import", str(tank), "--strict"]) == Exit.INCONCLUSIVE
    model = WrittenModel("one", step="0.1")
    _, chart = model.root.chart("C")
    chart.data("y", "output", "double")
    a, b = chart.state("A"), chart.state("B")
    chart.transition(None, a)
    chart.transition(a, b, "after(0.25, sec)")
    told = str(model.save(tmp_path / "one.slx"))
    assert run(["import", told]) == Exit.AS_EXPECTED
    assert run(["import", told, "--strict"]) == Exit.INCONCLUSIVE
