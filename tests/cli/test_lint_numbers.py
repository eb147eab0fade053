"""``rovercheck lint`` about numbers: domains that are left, divisions by 0, indices, integers too large."""

import json
import re
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.lint.document import LintRow
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.schemas import published
from tests.simulink.by_hand.diagrams import Diagram
from tests.simulink.known.packages import ChartText

COUNTER = """from rovercheck import Chart, State, assign, flag, integer, to, var

go = flag("go")
n, m = var("n", integer(0, 3)), var("m", integer(0, 3))
counter = Chart(
    "Counter",
    [
        State("Off", transitions=[to("On", when=go{guard}, do=[assign(n, n + 1)])]),
        State("On", transitions=[to("Off", when=(m < {limit}) & ~go, do=[assign(m, m + 1)])]),
    ],
    default="Off",
)
"""


def rows_of(path: Path, capsys: pytest.CaptureFixture[str]) -> tuple[Exit, dict[str, LintRow]]:
    """The exit code, and the rows about numbers by what they say."""
    code = run(["lint", "--model", str(path), "--json"])
    told = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("lint-1")).validate(told)
    kinds = ("range", "step", "overflow")
    return code, {row["what"]: row for row in told["findings"] if row["kind"] in kinds}


def test_a_datum_that_leaves_its_domain_is_told_with_a_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The other one does not, which its formula does not say, and a proof does."""
    path = tmp_path / "counter.py"
    path.write_text(COUNTER.format(guard="", limit=3), encoding="utf-8")
    code, rows = rows_of(path, capsys)
    assert code == Exit.FAILED
    one = rows["n gets a value outside integer in 0..3"]
    assert (one["kind"], one["found"], one["chart"]) == ("range", "happens", "Counter")
    assert one["run"] and one["run"][-1] == "tick 8: go = true"
    other = rows["m gets a value outside integer in 0..3"]
    assert (other["found"], other["run"]) == ("never", [])
    run(["lint", "--model", str(path)])
    said = " ".join(capsys.readouterr().out.split())
    assert "✗ Counter, Counter: n gets a value outside integer in 0..3: this happens." in said
    assert "✓ Counter, Counter: m gets a value outside integer in 0..3: this never happens." in said
    assert "2 states, 3 transitions, not asked about as long as a run has no meaning" in said


def test_where_nothing_leaves_its_domain_the_rest_is_asked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "counter.py"
    path.write_text(COUNTER.format(guard=" & (n < 3)", limit=3), encoding="utf-8")
    code, rows = rows_of(path, capsys)
    assert code == Exit.AS_EXPECTED
    assert [row["found"] for row in rows.values()] == ["never", "never"]
    run(["lint", "--model", str(path)])
    assert "✓ Counter: 2 states, 3 transitions, all of them can happen." in capsys.readouterr().out
    assert run(["lint", "--model", str(path), "--seconds", "1e-9"]) == Exit.INCONCLUSIVE
    assert "whether this happens was not decided" in " ".join(capsys.readouterr().out.split())


DIVIDING = """
    in a int8
    in b double
    out y double
    out sure boolean
    -> A
    state A: en: y = 0; sure = false;
    state B: du: {};
    A -> B: [a > 0]
    B -> A: [b ~= 0 && a > 100 / b]{{sure = true;}}
"""
DOMAINS = """
[domains]
b = {{ values = [0, 1, 2, 4] }}
y = {{ low = -{high}, high = {high}, resolution = 0.25 }}
"""


def dividing(folder: Path, action: str, high: int = 200) -> Path:
    (folder / "one.domains.toml").write_text(DOMAINS.format(high=high), encoding="utf-8")
    return ChartText("one", DIVIDING.format(action), "MATLAB").save(folder, "R2024a")


def test_a_division_by_0_is_told_with_a_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It was refused when the model was read; the one behind `&&` is looked at only where it has a value."""
    path = dividing(tmp_path, "y = double(a) / b")
    assert run(["import", str(path)]) == Exit.AS_EXPECTED  # after the division MATLAB goes on with Inf
    assert "the direct interpreter gives the same" in capsys.readouterr().out
    code, rows = rows_of(path, capsys)
    assert code == Exit.FAILED
    one = rows["`double(a) / b` divides by 0"]
    assert (one["kind"], one["found"], one["chart"]) == ("step", "happens", "C")
    assert re.fullmatch(r"tick 3: (.*, )?b = 0(, .*)?", one["run"][-1])
    assert rows["`100 / b` divides by 0"]["found"] == "never"
    assert rows.keys() == {
        "`double(a) / b` divides by 0",
        "`100 / b` divides by 0",
    }  # y cannot leave its domain


def test_a_division_that_is_guarded_is_proved(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = dividing(tmp_path, "if b > 0\\ny = double(a) / b;\\nend")
    code, rows = rows_of(path, capsys)
    assert {one["found"] for one in rows.values()} == {"never"} and len(rows) >= 2
    assert code == Exit.AS_EXPECTED


def dividing_blocks(folder: Path) -> Path:
    """A Product block that divides, and a MATLAB function that does."""
    model = WrittenModel("blocks")
    a, b = (model.root.inport(name, n, OutDataTypeStr="double") for n, name in enumerate("ab", 1))
    ratio = model.root.block("Product", "Ratio", {"in": 2, "out": 1}, {}, Inputs="*/")
    script = "function y = fit(a, b)\ny = int8(0);\nif a / (b + 1) > 3\n y = int8(a / b);\nend\n"
    fit, data = model.root.chart("Fit", "MATLAB Function", script)
    for name, scope, kind in (("a", "input", ""), ("b", "input", ""), ("y", "output", "int8")):
        data.data(name, scope, kind or "Inherit: Same as Simulink")
    for block in (ratio, fit):
        model.root.line(a, f"{block}/1")
        model.root.line(b, f"{block}/2")
    whole = model.root.block("DataTypeConversion", "Whole", {"in": 1, "out": 1}, {}, OutDataTypeStr="int16")
    model.root.line(ratio, whole)
    model.root.line(whole, model.root.outport("r", 1))
    model.root.line(fit, model.root.outport("y", 2))
    (folder / "blocks.domains.toml").write_text(
        "[domains]\na = { low = 0, high = 60 }\nb = { low = 0, high = 4 }\n", encoding="utf-8"
    )
    return model.save(folder / "blocks.slx")


def test_divisions_of_blocks_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of two in one step the first is met; where `b` is 0 the second always comes after it."""
    path = dividing_blocks(tmp_path)
    assert run(["import", str(path)]) == Exit.AS_EXPECTED
    assert "the direct interpreter gives the same" in capsys.readouterr().out
    code, rows = rows_of(path, capsys)
    assert code == Exit.FAILED
    found = {what: row["found"] for what, row in rows.items()}
    assert sorted(found.values()) == ["happens", "never"]
    [other] = [row for row in rows.values() if row["found"] == "never"]
    assert "unless something of the other rows has happened before" in other["evidence"]


def test_a_datum_of_a_chart_that_leaves_its_domain(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, rows = rows_of(dividing(tmp_path, "y = 2 * double(a)"), capsys)
    [what] = [what for what, row in rows.items() if row["found"] == "happens"]
    assert code == Exit.FAILED and what.startswith("y gets a value outside")


INDEXED = ChartText(
    "one",
    """
    in i int8
    out y int8
    out z int8
    local v[3] int8
    -> A
    state A: du: if i > 0\\ny = v(i);\\nend\\nif i > 0 && i < 4\\nz = v(i) + i;\\nv(i) = z;\\nend
    """,
    "MATLAB",
)


def test_an_index_that_names_no_element_and_an_integer_that_stops(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, rows = rows_of(INDEXED.save(tmp_path, "R2024a"), capsys)
    assert code == Exit.FAILED
    found = {row["found"] for what, row in rows.items() if "may name no element of 3" in what}
    assert found == {"happens"}


SUMS = ChartText(
    "one",
    """
    in u uint8
    in on boolean
    out y uint8
    out z uint8
    -> A
    state A: du: if u < 200 && on\\ny = u + 55;\\nend\\nif y + u == 300\\nz = u - 1;\\nend
    A -> A: [u > 0 && u * 3 > 250]
    """,
    "MATLAB",
)


ASSIGNED = ChartText(
    "one",
    """
    in w int16
    out y int8
    out z uint8
    -> A
    state A: en: y = w;
    A -> A: [w > 200]{z = w; z += 100; y = abs(y);}
    A -> A: [w < 5]{z = z ^ 2 + 1;}
    """,
    "C",
)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            SUMS,
            {
                "`u + 55` wraps around the ends of uint8 in C/A": "never",
                "`y + u` wraps around the ends of uint8 in C/A": "happens",
                "`u * 3` wraps around the ends of uint8 in C/A": "happens",
            },
        ),
        (
            ASSIGNED,
            {
                "`y = w` wraps around the ends of int8 in C/A": "happens",
                "`z = w` wraps around the ends of uint8 in C/A": "happens",
                "`z + 100` wraps around the ends of uint8 in C/A": "happens",
                "`abs(y)` wraps around the ends of int8 in C/A": "happens",
                "`z^2` wraps around the ends of uint8 in C/A": "happens",
                "`z^2 + 1` wraps around the ends of uint8 in C/A": "never",
            },
        ),
    ],
)
def test_integers_that_are_more_than_their_types_hold_are_told(
    text: ChartText, told: dict[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """They stop at the ends of their types or wrap, which may be meant; a power in a sum was an error."""
    code, rows = rows_of(text.save(tmp_path, "R2024a"), capsys)
    assert {what: row["found"] for what, row in rows.items() if row["kind"] == "overflow"} == told
    assert code == Exit.AS_EXPECTED


def test_integers_of_blocks_that_are_more_than_their_types_hold_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of MATLAB functions and of Sum, Gain, Abs and conversion blocks nothing was told."""
    d = Diagram()
    three = d.constant("int8(3)")
    blocks = [
        d.add("Sum", d.u, three),
        d.add("Gain", d.u, Gain="3", SaturateOnIntegerOverflow="on"),
        d.add("Abs", d.u),
        d.add("DataTypeConversion", d.u, OutDataTypeStr="uint8"),
        d.add("Product", d.u, three, Inputs="*/"),
        d.add("MinMax", d.u, three, Inputs="2"),
    ]
    script = (
        "function y = f(x)\ny = x * 2;\nif x < 100\n y = x + 20;\nend\nif uint8(x) > 7\n y = -x;\nend\nend\n"
    )
    function, made = d.root.chart("F", "MATLAB Function", script)
    made.data("x", "input", "int8")
    made.data("y", "output", "int8")
    d.root.line(d.u, function)
    path = d.given(*blocks, function).save(tmp_path / "one.slx")
    code, rows = rows_of(path, capsys)
    over = {what: row["found"] for what, row in rows.items() if row["kind"] == "overflow"}
    assert over == {
        "Sum 2 wraps around the ends of int8": "happens",
        "Gain 3 stops at an end of int8": "happens",
        "Abs 4 wraps around the ends of int8": "happens",
        "DataTypeConversion 5 wraps around the ends of uint8": "happens",
        "`x * 2` stops at an end of int8 in F": "happens",
        "`x + 20` stops at an end of int8 in F": "never",
        "`uint8(x)` stops at an end of uint8 in F": "happens",
        "`-x` stops at an end of int8 in F": "never",
    }
    assert code == Exit.AS_EXPECTED
