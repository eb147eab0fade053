"""An installation without extras decides everything, and says of what is missing how to get it."""

import json
import re
import shutil
from pathlib import Path

import pytest

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.engines import engines
from rovercheck.checker.extras import CERTIFICATES, EXTRAS, PARQUET, PLOT
from tests.packaging.builds import ROOT, pinned, project, run_in

INSTALLED = re.compile(r"pip install '(\S+)'")


@pytest.fixture(scope="module")
def work(core: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a model, and proofs of it that were written without the solver."""
    folder = tmp_path_factory.mktemp("work")
    said(core, folder, "init .")
    found = said(core, folder, "check --model heater.py --certificates proofs")
    assert "3 demands: 2 proved, 1 violated." in found
    return folder


def said(python: Path, at: Path, command: str, code: Exit = Exit.AS_EXPECTED) -> str:
    """What rovercheck says in the environment."""
    return " ".join(run_in(at, str(python), "-m", "rovercheck", *command.split(), code=code).split())


def test_the_table_names_the_extras_of_the_project_and_what_each_brings() -> None:
    optional = project()["optional-dependencies"]
    brought = {name: re.split(r"\[|[>=]", one)[0] for name, [one] in optional.items() if name != "all"}
    assert {one.name: one.package for one in EXTRAS.values()} == brought
    assert optional["all"] == [f"rovercheck[{','.join(EXTRAS)}]"]


def test_the_page_on_installation_says_what_each_extra_brings_and_takes() -> None:
    page = (ROOT / "docs" / "installation.md").read_text(encoding="utf-8")
    rows = re.findall(r"(?m)^\| `(\w+)` \| (.+?) \| .*? ?\| ([\d.]+) MB \|$", page)
    assert {name: brings for name, brings, _ in rows} == {
        **{one.name: one.package for one in EXTRAS.values()},
        "all": "these five",
    }
    *sizes, together = (float(takes) for _, _, takes in rows)
    assert together == sum(sizes)


def test_doctor_finds_every_engine_working_and_names_what_is_missing(core: Path, tmp_path: Path) -> None:
    found = json.loads(run_in(tmp_path, str(core), "-m", "rovercheck", "doctor", "--json"))
    packages = {one["name"]: one for one in found["findings"] if one["kind"] == "package"}
    missing = {name for name, one in packages.items() if not one["ok"]}
    assert {one.package for one in EXTRAS.values()} <= missing
    assert not any(packages[name]["required"] for name in missing)
    for one in EXTRAS.values():
        assert packages[one.package]["adds"].endswith(one.command) and packages[one.package]["bytes"] == 0
    trials = {one["name"] for one in found["findings"] if one["kind"] == "trial" and one["ok"]}
    assert trials == {f"engine {name}" for name in engines()}
    own = packages.pop("rovercheck")["bytes"]
    assert sum(one["bytes"] for one in packages.values()) < own, "it counts what they need, too"


def test_properties_of_the_rover_are_decided_without_extras(core: Path, tmp_path: Path) -> None:
    found = said(core, tmp_path, "check PB1-15 PB2-01 PB1-11 PB2-02b --strict --no-store")
    assert "Every verdict is as expected." in found


@pytest.mark.parametrize(
    ("command", "what"),
    [
        ("check --model heater.py --certify", "--certify"),
        ("report --model heater.py --certify -o page.html", "--certify"),
        ("certify --model heater.py proofs", "--solver both"),
        ("certify --model heater.py proofs --solver bitwuzla", "--solver bitwuzla"),
    ],
)
def test_what_checks_proofs_again_says_what_it_needs(command: str, what: str, core: Path, work: Path) -> None:
    found = said(core, work, command, Exit.USAGE)
    assert found.startswith(f"{what} needs bitwuzla, which is not installed: ")
    assert INSTALLED.findall(found) == ["rovercheck[certificates]"]
    assert not (work / "page.html").exists()


def test_proofs_are_checked_without_the_solver_where_that_is_asked_for_or_is_not_all(
    core: Path, work: Path
) -> None:
    found = said(core, work, "certify --model heater.py proofs --solver enumeration")
    assert "2 properties in 2 files: 2 accepted." in found
    assert "Every verdict is as expected." in said(core, work, "check --model heater.py --recheck")


def test_a_script_is_told_too(core: Path, work: Path) -> None:
    script = "import rovercheck; rovercheck.check('heater.py', certify=True)"
    found = run_in(work, str(core), "-c", script, code=Exit.FAILED)
    assert found.splitlines()[-1] == f"ModuleNotFoundError: {CERTIFICATES.needed('certify=True')}."


def test_plots_and_parquet_are_told(core: Path, work: Path) -> None:
    scenario = ROOT / "examples" / "scenarios" / "link_loss.toml"
    found = said(core, work, f"simulate {scenario} -o run.svg", Exit.USAGE)
    assert found == f"run.svg: {PLOT.needed('A plot')}. Or write --no-plot."
    (work / "log.parquet").write_bytes(b"PAR1 what only its first and last letters make a Parquet file PAR1")
    found = said(core, work, "check-log log.parquet", Exit.USAGE)
    assert PARQUET.needed("Reading it") in found


def test_what_installs_an_extra_asks_for_nothing_but_what_it_brings(core: Path) -> None:
    """The command of the message: rovercheck is there, so that pip takes it from no index."""
    pip = shutil.which("pip") or "pip"
    for one in EXTRAS.values():
        [asked] = INSTALLED.findall(one.command)
        options = ("--dry-run", "--no-index", "--disable-pip-version-check")
        found = run_in(core.parent, pip, "--python", str(core), "install", *options, asked, code=1)
        assert re.findall(r"No matching distribution found for ([^\s>=;[]+)", found) == [one.package]


def test_the_lists_agree_and_the_shorter_one_has_no_extra() -> None:
    some, whole = pinned("requirements-core.lock"), pinned("requirements.lock")
    assert some.items() < whole.items()
    assert {re.split("[>=]", one)[0] for one in project()["dependencies"]} <= some.keys()
    assert not some.keys() & {one.package for one in EXTRAS.values()}
    assert {one.package for one in EXTRAS.values()} <= whole.keys()


@pytest.mark.parametrize(
    ("target", "lists"),
    [
        ("check", ["requirements-core.lock"]),
        ("check-repairs", ["requirements-core.lock"]),
        ("check-full", ["requirements-core.lock", "requirements.lock"]),
        ("lint", ["requirements-core.lock", "requirements.lock"]),
        ("setup", ["requirements-core.lock", "requirements.lock"]),
    ],
)
def test_make_installs_only_what_a_target_needs(target: str, lists: list[str], tmp_path: Path) -> None:
    told = run_in(ROOT, "make", "--dry-run", target, f"VENV={tmp_path / 'env'}")
    assert re.findall(r"pip install .*--require-hashes -r (\S+)", told) == lists
    assert "-m pip install --disable-pip-version-check --require-hashes" in told, "it says how far it is"
