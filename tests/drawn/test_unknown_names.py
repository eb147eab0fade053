"""Names that mean nothing in a chart are told with their element, and no others."""

import json
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.drawn.parsed import parsed_chart
from rovercheck.checker.drawn.unknown import unknown_names
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.samples import EXAMPLES

KNOWN = """function y = f(x)
persistent k
for i = 1:3
    k(i) = x;
end
coder.inline('never');
y = helper(k(1)) + u;
end
function z = helper(a)
z = abs(a);
end
"""


def written(folder: Path, action: str, label: str = "", script: str = KNOWN) -> Path:
    model = WrittenModel("one")
    _, chart = model.root.chart("C")
    chart.data("u", "input", "double")
    chart.data("speed", "output", "double")
    chart.event("GO")
    chart.function("y = f(x)", script=script)
    a, b = chart.state(f"A\nen: {action}"), chart.state("B")
    chart.transition(None, a)
    chart.transition(a, b, label)
    return model.save(folder / "one.slx")


def told(path: Path) -> list[tuple[str, str]]:
    model = read_model(path)
    notes = (
        note for chart in model.charts for note in unknown_names(parsed_chart(chart), model.enumerations)
    )
    return [(note.what, note.text.partition(" is no")[0]) for note in notes]


def test_the_examples_have_none() -> None:
    for package in sorted(EXAMPLES.glob("*/*.slx")):
        assert told(package) == [], package


@pytest.mark.parametrize(
    ("action", "label"),
    [
        ("speed = f(u); GO; send(GO, B);", "GO[after(3, sec) && in(A)]{speed = temporalCount(tick);}"),
        ("for n = 1:2, speed = speed + n; end", "after(2, GO)[hasChanged(u) || duration(u > 1, msec) > 5]"),
        ("speed = max([1 2]);", "tick | wakeup"),
    ],
)
def test_what_is_known_is_not_told(tmp_path: Path, action: str, label: str) -> None:
    assert told(written(tmp_path, action, label)) == []


@pytest.mark.parametrize(
    ("action", "label", "script", "what", "name"),
    [
        ("sped = 1;", "", KNOWN, "the state A", "sped"),
        ("speed = sped + sped;", "", KNOWN, "the state A", "sped"),
        ("g(1);", "", KNOWN, "the state A", "g"),
        ("", "[door]", KNOWN, "the transition `[door]`", "door"),
        ("", "STOP", KNOWN, "the transition `STOP`", "STOP"),
        ("", "[after(2, STOP)]", KNOWN, "the transition `[after(2, STOP)]`", "STOP"),
        ("", "", "function y = f(x)\ny = x + w;\nend\n", "the function f", "w"),
    ],
)
def test_a_name_without_a_meaning_is_told_once_with_its_element(
    tmp_path: Path, action: str, label: str, script: str, what: str, name: str
) -> None:
    assert told(written(tmp_path, action, label, script)) == [(what, name)]


@pytest.mark.parametrize("label", ["enter(B)", "exit(A)", "change(speed)"])
def test_an_implicit_event_is_refused_by_its_name(tmp_path: Path, label: str) -> None:
    """Its name was taken for known, and the check of the model ended at what is neither event nor time."""
    [(what, text)] = told(written(tmp_path, "", label))
    assert what == f"the transition `{label}`"
    assert text.startswith(f"{label.partition('(')[0]}(...) is an implicit event, which has no meaning here")


def test_the_time_of_a_simulation_is_refused_by_its_name(tmp_path: Path) -> None:
    assert told(written(tmp_path, "", "[t > 5]")) == [
        (
            "the transition `[t > 5]`",
            "t is the time since the beginning, which has no end. Use after or elapsed.",
        )
    ]


def test_it_is_refused_with_what_may_be_meant(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["import", str(written(tmp_path, "sped = 1;")), "--json"]) is Exit.INCONCLUSIVE
    [note] = json.loads(capsys.readouterr().out)["notes"]
    assert (note["where"], note["kind"], note["what"]) == ("C/A", "refused", "the state A")
    assert note["text"].endswith("Did you mean 'speed'?") and note["ssid"] and note["line"]
