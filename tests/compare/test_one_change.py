"""One change of a firmware in several places is one finding that names them all."""

import json
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.diagnosis.causes import together
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.hypotheses import rewrite_changes
from rovercheck.checker.diagnosis.part_causes import DeviationCause
from rovercheck.checker.diagnosis.sentences import behaves_like
from rovercheck.checker.diagnosis.variant import read_variant
from rovercheck.spec_model.abstraction import boards

GREENHOUSE = '''
"""A lamp and a fan that follow one limit of the temperature."""

from rovercheck import Chart, State, assign, flag, in_order, integer, to, var

temperature = var("temperature", integer(-20, 60, "°C"))
lamp, fan = flag("lamp"), flag("fan")


def follows(name, output):
    return Chart(
        name,
        [
            State("Off", entry=[assign(output, False)], transitions=[to("On", when=temperature > 25)]),
            State("On", entry=[assign(output, True)], transitions=[to("Off", when=~(temperature > 25))]),
        ],
        default="Off",
        text=f"{name} is on above 25 °C.",
    )


greenhouse = in_order("greenhouse", follows("Lamp", lamp), follows("Fan", fan), text="Both.")
'''

FIRMWARE = """
class Both:
    lamp, fan = 30, 30

    def __init__(self):
        self.on = None

    def step(self, given):
        warm = given["temperature"]
        first, self.on = self.on is None, (warm > self.lamp, warm > self.fan)
        if first:
            self.on = False, False
        lamp, fan = self.on
        return {"lamp": lamp, "fan": fan, "Lamp": 1 + lamp, "Fan": 1 + fan}


class Each(Both):
    lamp, fan = 30, 35
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "greenhouse.py").write_text(GREENHOUSE, encoding="utf-8")
    (tmp_path / "baseline.toml").write_text("", encoding="utf-8")
    (tmp_path / "firmware.py").write_text(FIRMWARE, encoding="utf-8")
    return tmp_path


def compared(folder: Path, firmware: str, capsys: pytest.CaptureFixture[str], *more: str) -> tuple[int, Any]:
    asked = ["compare", "--model", str(folder / "greenhouse.py"), "--examples", "10", "--mismatches", "0"]
    asked += ["--impl", f"python:{folder / 'firmware.py'}:{firmware}", "--causes", *more]
    code = run([*asked, "--json"])
    document = json.loads(capsys.readouterr().out)
    return code, document


def test_a_limit_of_two_charts_is_one_cause_that_names_both(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One constant of the firmware was told as two findings."""
    variant, known = folder / "variant.toml", folder / "known.toml"
    files = "--write-variant", str(variant), "--write-known", str(known)
    code, document = compared(folder, "Both", capsys, *files)
    [result] = document["results"]
    [cause] = result["causes"]
    assert code == 1 and cause["says"].startswith(("Lamp and Fan behave as", "Fan and Lamp behave as"))
    [other] = cause["other_places"]
    assert {cause["change"]["chart"], other["chart"]} == {"Lamp", "Fan"}
    assert (cause["change"]["kind"], cause["change"]["new"]) == (other["kind"], other["new"])
    assert sorted(cause["deviations"]) == sorted(one["id"] for one in result["mismatches"])
    [finding] = document["campaign"]["findings"]
    assert finding["cause"] == cause["says"]
    assert all(finding[key] == cause[key] for key in ("change", "other_places", "rivals"))
    assert sorted(change.chart for change in read_variant(variant).changes) == ["Fan", "Lamp"]
    code, document = compared(folder, "Both", capsys, "--known", str(known))
    assert code == 0 and {one["known"] for one in document["results"][0]["mismatches"]} == {"known"}


def test_other_limits_stay_two_causes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, document = compared(folder, "Each", capsys)
    causes = document["results"][0]["causes"]
    assert sorted(one["change"]["chart"] for one in causes) == ["Fan", "Lamp"]
    assert not any(one["other_places"] for one in causes)


def roundings(part: str) -> list[ChartChange]:
    found = rewrite_changes(boards()["board2"].system, {}, frozenset({part}))
    return [one for one in found if one.kind == "rounded" and one.at.startswith("everywhere")]


def test_two_outputs_rounded_alike_are_one_cause_and_otherwise_two() -> None:
    """The wanted speeds of both sides are rounded by one function: they were two findings."""
    changes = roundings("Actuation")
    left, right = ([c for c in changes if c.old == f"B2.{side}_rpm"] for side in ("left", "right"))
    alike = DeviationCause("Actuation", left[0], ()), DeviationCause("Actuation", right[0], ())
    [one] = together(alike)
    assert one.change is left[0] and one.other_places == (right[0],)
    assert one.change.new == right[0].new
    said = behaves_like(left[0], right[0])
    assert said.startswith("Actuation behaves as if ") and "left_rpm" in said and "right_rpm" in said
    other = next(c for c in right if c.new != left[0].new)
    assert len(list(together((alike[0], DeviationCause("Actuation", other, ()))))) == 2
