"""``--variant``: charts with the changes of a file, wherever charts are looked at; how it is written."""

import json
import shutil
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check.chain_status import Chains
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.variant import pick_variant
from tests.model_files.files import CRITICAL_AT_59_5

CHANGE = (
    """board = "board1"
evidence = "compare, c:firmware: the changes explain 41 of 41 deviations."
"""
    + CRITICAL_AT_59_5
)
ELSEWHERE = """board = "board1"

[[change]]
kind = "signal"
chart = "Monitor_wheel_RL"
at = "arrow/decide.1"
from = "hasNoFeedback_RL"
to = "rx_slow"
"""
STAMP = """
[[change]]
kind = "stamp"
chart = "Monitor_reception"
at = "stamp/b2_data_last_valid_ms"
from = "as it is given"
to = "in 16 bits"
"""
OVEN = """from rovercheck import *

warm = var("warm", chosen([0, 59, 60, 61, 90], "°C"), 0)
loud = flag("loud")
oven = Chart("Oven", [
    State("Quiet", entry=[assign(loud, False)], transitions=[to("Loud", when=warm >= 60)]),
    State("Loud", entry=[assign(loud, True)], transitions=[to("Quiet", when=warm < 60)]),
], default="Quiet")
kitchen = System("kitchen", (oven,))
LOUD = always(
    "LOUD", "It is loud at 60 °C.", that=implies(warm >= 60, loud), covers=("R1",), on=kitchen, from_tick=2
)
"""


@pytest.fixture
def variant(tmp_path: Path) -> Path:
    file = tmp_path / "variant.toml"
    file.write_text(CHANGE, encoding="utf-8")
    return file


def shown(capfd: pytest.CaptureFixture[str]) -> str:
    found = capfd.readouterr()
    return " ".join((found.out + found.err).split())


def test_what_flies_is_checked(variant: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-01b", "PB1-01a", "--variant", str(variant)]) == Exit.FAILED
    told = shown(capfd)
    assert "variant.toml: compare, c:firmware: the changes explain 41 of 41 deviations." in told
    assert "✗ PB1-01b violated 201 ticks" in told
    assert "with variant.toml; as specified it is proved" in told
    assert "✓ PB1-01a proved" in told
    assert f"trace PB1-01b --variant {variant}" in told


def test_only_what_the_changes_concern_is_checked(variant: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "--system", "battery", "--variant", str(variant)]) == Exit.NOTHING
    shown(capfd)


def test_the_run_meets_the_new_limit_between_two_measured_values(
    variant: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["trace", "PB1-01b", "--variant", str(variant)]) == Exit.AS_EXPECTED
    told = shown(capfd)
    assert "temp_reading = 59.5 °C" in told
    assert "temperature_degC >= 59.5" in told
    assert "[60;+inf[ ||" not in told  # a formula that was changed has lost its name


def test_its_run_is_given_to_firmware_with_what_the_changed_charts_require(
    variant: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["trace", "PB1-01b", "--variant", str(variant), "--format", "pytest"]) == Exit.AS_EXPECTED
    assert '"temperature_degC": 59.5' in shown(capfd)


def test_its_certificates_are_checked_without_the_file(
    variant: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "proofs"
    asked = ["check", "PB1-01a", "--variant", str(variant), "--certificates", str(folder)]
    assert run(asked) == Exit.AS_EXPECTED
    variant.unlink()
    assert run(["certify", str(folder)]) == Exit.AS_EXPECTED
    assert "1 accepted" in shown(capfd)
    capfd.readouterr()
    [file] = folder.iterdir()
    document = json.loads(file.read_text(encoding="utf-8"))
    document["origin"]["changes"][1][4] = "temperature_degC >= 62"
    file.write_text(json.dumps(document), encoding="utf-8")
    assert run(["certify", str(folder)]) != Exit.AS_EXPECTED
    document["origin"]["changes"][1][3] = "temperature_degC >= 61"
    file.write_text(json.dumps(document), encoding="utf-8")
    assert run(["certify", str(folder)]) != Exit.AS_EXPECTED
    assert "its changes do not fit the charts" in shown(capfd)


def test_links_of_chains_are_asked_of_the_changed_charts(variant: Path) -> None:
    """All of `check --variant` was refused: a link was asked of a system with finer steps than its own."""
    chains = Chains(pick_variant([], None, [], None, variant))
    assert {p.on for p in chains.links.values()} & {"temperature", "board1_ms"}
    variant.write_text(ELSEWHERE, encoding="utf-8")
    assert Chains(pick_variant([], None, [], None, variant)).links is not None


def test_a_certificate_with_a_change_that_its_system_has_not_got_is_rejected(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "proofs"
    assert run(["check", "PB1-06a-RL", "--certificates", str(folder)]) == Exit.AS_EXPECTED
    [file] = folder.iterdir()
    document = json.loads(file.read_text(encoding="utf-8"))
    change = ["signal", "Monitor_wheel_RL", "arrow/decide.1", "hasNoFeedback_RL", "rx_slow"]
    document["origin"]["changes"] = [["board1"], change]
    file.write_text(json.dumps(document), encoding="utf-8")
    capfd.readouterr()
    assert run(["certify", str(folder)]) == Exit.FAILED
    assert "it reads rx_slow, which the system does not have" in shown(capfd)


def test_a_number_without_end_is_refused_at_once(variant: Path, capfd: pytest.CaptureFixture[str]) -> None:
    variant.write_text(CHANGE.replace("59.5", "1e999999999"), encoding="utf-8")
    assert run(["check", "PB1-01a", "--variant", str(variant)]) == Exit.USAGE
    assert "variant.toml, change 1 (limit in Monitor_temperature)" in shown(capfd)


def test_a_chart_is_drawn_with_its_changes(variant: Path, tmp_path: Path) -> None:
    picture = tmp_path / "chart.svg"
    assert run(["graph", "Monitor_temperature", "--variant", str(variant), "-o", str(picture)]) == 0
    assert "59.5" in picture.read_text(encoding="utf-8")


def test_what_no_system_shows_is_said(variant: Path, capfd: pytest.CaptureFixture[str]) -> None:
    variant.write_text(CHANGE + STAMP, encoding="utf-8")
    assert run(["check", "PB1-01a", "PB1-01b", "--variant", str(variant)]) == Exit.FAILED
    told = shown(capfd)
    assert (
        "variant.toml, change 2 (a time stamp taken otherwise of b2_data_last_valid_ms): verdicts leave"
        in told
    )
    assert "with variant.toml but for change 2; as specified it is proved" in told


def test_what_a_change_leaves_out_is_not_as_expected(
    variant: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """A wheel monitor that reads another signal than its own slice has."""
    variant.write_text(ELSEWHERE, encoding="utf-8")
    assert run(["check", "PB1-06a-RL", "PB1-04c", "--variant", str(variant)]) == Exit.INCONCLUSIVE
    told = shown(capfd)
    assert (
        "PB1-06a-RL is left out: variant.toml, change 1 (signal in Monitor_wheel_RL) cannot be made" in told
    )
    assert "it reads rx_slow, which the system does not have." in told
    assert "✓ PB1-04c proved" in told


def test_a_model_of_ones_own_has_variants(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    model, file = tmp_path / "oven.py", tmp_path / "variant.toml"
    model.write_text(OVEN, encoding="utf-8")
    text = CHANGE.replace("board1", "kitchen").replace("Monitor_temperature", "Oven")
    file.write_text(text.replace("temperature_degC", "warm"), encoding="utf-8")
    assert run(["check", "--model", str(model)]) == Exit.AS_EXPECTED
    assert run(["check", "--model", str(model), "--variant", str(file)]) == Exit.AS_EXPECTED
    file.write_text(file.read_text(encoding="utf-8").replace("59.5", "60.5"), encoding="utf-8")
    assert run(["check", "--model", str(model), "--variant", str(file)]) == Exit.FAILED
    assert run(["trace", "LOUD", "--model", str(model), "--variant", str(file)]) == Exit.AS_EXPECTED
    assert "warm = 60 °C" in shown(capfd)


def test_a_firmware_conforms_to_the_variant_that_is_written_of_it(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    examples = Path(__file__).parents[2] / "examples"
    shutil.copytree(examples / "board1_c", tmp_path / "fw")
    shutil.copy(examples / "board1_c_faulty" / "sup_b1.c", tmp_path / "fw")
    file = tmp_path / "fw.toml"
    asked = ["compare", "--system", "board1", "--impl", f"c:{tmp_path / 'fw'}", "--examples", "20"]
    assert run([*asked, "-o", str(tmp_path), "--write-variant", str(file)]) == Exit.FAILED
    assert f"The variant is in {file}." in shown(capfd)
    text = file.read_text(encoding="utf-8")
    assert 'kind = "interpretation"' in text
    assert "# Monitor_temperature behaves as under the interpretation S02=GT-STEP" in text
    assert run([*asked, "--variant", str(file)]) == Exit.AS_EXPECTED
    assert "✓ board1 conforms" in shown(capfd)


WRONG = [
    (["check", "--variant", "none.toml"], "none.toml: No such file or directory. Write a file as"),
    (["check", "--variant", "other.toml"], "other.toml: there is no board 'kitchen'. Known: board1"),
    (
        ["check", "--variant", "unfit.toml"],
        "unfit.toml, change 1 (limit in Monitor_temperature): at 'everywhere' is",
    ),
    (["trace", "PB1-01b", "--variant", "odd.toml"], "odd.toml: a variant holds board = "),
    (["compare", "--system", "board1", "--variant", "unfit.toml"], "unfit.toml, change 1"),
    (["check-log", ".", "--variant", "unfit.toml"], "unfit.toml, change 1"),
    (
        ["generate-tests", "--kept", "--variant", "variant.toml"],
        "and not with variant.toml; leave --kept out",
    ),
]


@pytest.mark.parametrize(("arguments", "message"), WRONG, ids=[" ".join(a) for a, _ in WRONG])
def test_a_variant_without_meaning_gets_one_message(
    arguments: list[str],
    message: str,
    variant: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(variant.parent)
    Path("other.toml").write_text(CHANGE.replace("board1", "kitchen"), encoding="utf-8")
    Path("unfit.toml").write_text(CHANGE.replace('C >= 60"', 'C >= 61"'), encoding="utf-8")
    Path("odd.toml").write_text(CHANGE.replace("evidence", "evidences"), encoding="utf-8")
    assert run(arguments) == Exit.USAGE
    assert message in shown(capfd)
