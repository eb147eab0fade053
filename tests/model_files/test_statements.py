"""A file that cannot be run: what is wrong with it is told at once, each fault with its place."""

from pathlib import Path

import pytest

from docs.reference.listings import listings
from rovercheck.checker.model.load import load
from rovercheck.spec_model.lang.errors import ModelError

ROOT = Path(__file__).parents[2]

HEAD = """from rovercheck import *
minutes = var("minutes", integer(0, 9, "min"))
hot, on = flag("hot"), flag("on")
"""
CHART = (
    HEAD
    + """C = Chart("C", [
    State("A", entry=[assign(on, 5)], transitions=[
        to("B", when=minutes > 0 & hot),
        to("B", when=minutes > 3),
        to("B", "[hto]"),
    ]),
    State("B", transitions=[to("A", when=hot == 3), to("A", when=hot)]),
], default="A", data=[hot])
P1 = always("P1", "x", that=minutes > hot, covers=["R"], on="C")
P2 = always("P2", "x", that=C.active("Bb"), covers=["R"], on="C")
P3 = always("P3", "x", that=C.active("B") & minutes > 0, covers=["R"], on=C)
P4 = always("P4", "x", that=C.active("B"), covers=["R"], on=C)
"""
)


DATA = "from dataclasses import dataclass\n@dataclass\nclass A:\n    x: int\n"


def told(folder: Path, **files: str) -> list[str]:
    for name, text in files.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as error:
        load(folder)
    return [line for line in str(error.value).splitlines() if not line.startswith(" ")]


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def lines(faults: list[str]) -> list[int]:
    return [int(fault.split(":")[1]) for fault in faults]


def test_every_formula_every_label_and_every_property(here: Path) -> None:
    faults = told(here, m=CHART)
    assert lines(faults) == [5, 6, 10, 12, 13, 14, 8]
    assert "Python reads `x > 0 & a` as `x > (0 & a)`, and `|` alike: write `(x > 0) & a`." in faults[1]
    assert "Python reads `a & x > 0` as `(a & x) > 0`" in faults[5]
    assert faults[6].startswith("m.py:8:19: C, transition 3 of A: `hto` is unknown here.")


def test_what_needs_a_faulty_name_is_not_told(here: Path) -> None:
    faults = told(here, m=HEAD + "cold = hot & 3\nice = ~cold\nD = undefined\nwarm = cold | (hot & 4)\n")
    assert lines(faults) == [4, 6]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("x = 1 / 0\ny = [].pop()\n", [1, 2]),
        ("def f():\n    return 1 / 0\nx = f()\ny = 1 / 0\n", [2, 4]),
        ("for n in range(3):\n    x = 1 / 0\ny = 1 / 0\n", [2, 3]),
        ("import nothing_such\nx = nothing_such.y\ny = 1 / 0\n", [1, 3]),
        (f"{DATA}a = A(1)\nb = A()\nc = A()\n", [6, 7]),
        ("raise SystemExit(3)\n", [1]),
        ("raise GeneratorExit\n", [1]),
        ("x = (\n", [1]),
        ("def f(n):\n    return f(n)\nx = f(1)\ny = 1 / 0\n", [2, 4]),
    ],
)
def test_files_that_are_no_models(text: str, found: list[int], here: Path) -> None:
    assert lines(told(here, m=text)) == found


def test_a_fault_of_a_neighbour_is_told_once(here: Path) -> None:
    faults = told(here, a=f"{HEAD}cold = hot & 3\n", b="from a import cold\nx = ~cold\ny = 1 / 0\n")
    assert [fault.split(": ")[0] for fault in faults] == ["a.py:4", "b.py:3"]


def test_a_chart_without_data_is_one_fault_with_all_names(here: Path) -> None:
    """Each label was a fault of its own: 20 messages for one forgotten list."""
    labels = 'to("B", "[door && level > 3] / heat = true"), to("B", "[!door]")'
    b = 'State("B", "entry: level = 0", transitions=[to("A", "[start)")])'
    text = f'{HEAD}C = Chart("C", [State("A", transitions=[{labels}]), {b}], default="A")\n'
    first, other = told(here, m=text)
    assert "the chart has no data, and its labels use door, heat, level." in first
    assert "Write data=[door, heat, level]" in first
    assert "transition 1 of B" in other


def test_labels_of_several_charts(here: Path) -> None:
    text = HEAD + "".join(
        f'C{n} = Chart("C{n}", [State("A", "en: on = {n}", transitions=[to("A", "[hoot]")])], default="A")\n'
        for n in (2, 3)
    )
    faults = told(here, m=text)
    assert lines(faults) == [4, 5]
    assert all("its labels use hoot, on. Write data=[hoot, on]" in fault for fault in faults)
    named = text.replace('default="A"', 'default="A", data=[hot]')
    assert lines(told(here, m=named)) == [4, 4, 5, 5], "which name is meant is another question at each place"


def test_what_the_page_about_labels_shows(here: Path) -> None:
    """The file of the page, and what is told of it."""
    page = list(listings(ROOT / "docs/labels.md", "docs/labels.md"))
    wrong = next(one for one in page if one.title == "wrong.py")
    shown = next(one for one in page if one.first.startswith("wrong.py:"))
    (here / "wrong.py").write_text(wrong.text, encoding="utf-8")
    with pytest.raises(ModelError) as error:
        load(Path("wrong.py"))
    assert str(error.value).rstrip() == shown.text.rstrip()


TWO = (
    HEAD
    + """
A = Chart("A", [State("X", entry=[assign(on, hot)])], default="X")
B = Chart("B", [State("Y", transitions=[to("Y", when=on)])], default="Y")
S = in_order("S", A, B)
"""
)
FORMS = {
    "always": "that=A.active('X')",
    "never": "that=on & ~on",
    "responds": "trigger=hot, response=on, within=1 * sec",
    "holds_after": "premise=hot, for_=1 * sec, then=A.active('X')",
    "holds_for": "start=hot, that=A.active('X'), for_=1 * sec",
    "leaves_only_if": "leaving=on, only_if=TRUE",
    "enters_only_if": "entering=on, only_if=TRUE",
    "precedes": "first=TRUE, then=on",
    "until": "start=on, holds=TRUE, release=on",
    "reachable": "that=on",
    "leads_to": "trigger=on, response=TRUE",
    "settles": "premise=on, then=TRUE",
    "recoverable": "to=TRUE",
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("on", ["A", "'A'", "S", "'S'", "B", "'B'"])
def test_a_property_about_a_chart_is_about_its_system(form: str, on: str, here: Path) -> None:
    (here / "m.py").write_text(f'{TWO}P = {form}("P", "t.", {FORMS[form]}, covers=["R"], on={on})\n')
    assert load(here).properties["P"].on == "S"


def test_a_chart_of_two_systems(here: Path) -> None:
    text = f'{TWO}T = in_order("T", A)\nP = always("P", "t.", that=on, covers=["R"], on=A)\n'
    [fault] = told(here, m=text)
    assert "It is a chart of S, T: write on='S'." in fault
