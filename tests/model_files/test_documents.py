"""What the documents and the files for CI say is so: commands, listings, forms."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from shlex import split

import click
import pytest
from ruamel.yaml import YAML

from rovercheck.checker.cli import app, run
from rovercheck.checker.commands.shared.codes import Exit
from tests.model_files.files import START

ROOT = Path(__file__).parents[2]
CI = ROOT / "examples" / "ci"
PAGES = [
    ROOT / "docs" / "models.md", ROOT / "docs" / "ci.md", ROOT / "examples" / "models" / "lift" / "README.md",
    START / "README.md",
]  # fmt: skip
FILES = [CI / "github-actions.yml", CI / "gitlab-ci.yml", START / "workflow.yml"]
COMMAND = re.compile(r"(?:^ {4}|run: |- |`)(rovercheck [a-z]+ [^`#\n]*?)(?: {2,}\S.*)?(?:`|$)", re.MULTILINE)


def commands(file: Path) -> Iterator[str]:
    """The commands that a page or file shows, comments left out."""
    yield from COMMAND.findall(file.read_text(encoding="utf-8"))


@pytest.mark.parametrize("file", [*PAGES, *FILES], ids=lambda f: f.relative_to(ROOT).as_posix())
def test_every_command_is_understood(file: Path) -> None:
    shown = list(commands(file))
    assert shown
    for line in shown:
        verb, *arguments = split(line)[1:]
        command = app.commands[verb]
        command.make_context(verb, arguments, parent=click.Context(app), resilient_parsing=False)


OUTPUT = {
    "check --model heater.py": "✗ HEAT-3 violated 4 ticks = 0.08 s of Heater, as expected",
    "trace HEAT-3 --model heater.py": "Why: Only Pause waits: the transition On -> Off leads past it",
    "certify proofs --model heater.py": "2 properties in 2 files: 2 accepted.",
    "requirements --model heater.py": "2 requirements: 2 covered",
    "list properties --english --model heater.py": "one of the next 500 (10000 ms) heating is false",
}
"""Of commands of the guide, what they print among other things."""


def test_what_the_guide_types_works(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    shown: dict[str, str] = {}
    for line in dict.fromkeys(commands(ROOT / "docs" / "models.md")):
        arguments = split(line)[1:]
        assert run(arguments) == Exit.AS_EXPECTED, capfd.readouterr().err
        shown[" ".join(arguments)] = " ".join(capfd.readouterr().out.split())
        if arguments == ["init", "heater"]:
            monkeypatch.chdir(tmp_path / "heater")
    for command, words in OUTPUT.items():
        assert words in shown[command]
    assert (tmp_path / "heater" / "heater.svg").read_text(encoding="utf-8").startswith("<svg")


def test_the_listing_of_the_guide_is_a_model(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    page = (ROOT / "docs" / "models.md").read_text(encoding="utf-8")
    [listing] = [b for b in re.findall(r"(?:(?: {4}.*)?\n)+", page) if "from rovercheck import" in b]
    (tmp_path / "m.py").write_text(re.sub(r"^ {4}", "", listing, flags=re.MULTILINE), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert run(["list", "properties", "--model", "m.py"]) == Exit.AS_EXPECTED
    assert "HEAT-1  Heater" in capfd.readouterr().out


def test_init_writes_the_workflow_of_the_examples() -> None:
    assert (START / "workflow.yml").read_text() == (CI / "github-actions.yml").read_text()


SCHEMAS = [
    ("vendor.github-workflows", "examples/ci/github-actions.yml"),
    ("vendor.gitlab-ci", "examples/ci/gitlab-ci.yml"),
    ("vendor.github-actions", "action.yml"),
]


@pytest.mark.parametrize(("schema", "name"), SCHEMAS)
def test_the_files_for_ci_have_the_form_their_readers_want(schema: str, name: str) -> None:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, str(ROOT / name)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_the_hook_of_the_example_and_the_one_that_is_offered_check_a_model() -> None:
    yaml = YAML(typ="safe")
    [hook] = yaml.load((ROOT / ".pre-commit-hooks.yaml").read_text())
    [repo] = yaml.load((CI / ".pre-commit-config.yaml").read_text())["repos"]
    [used] = repo["hooks"]
    assert repo["repo"] == "local" and used["id"] == hook["id"]
    for one in (hook, used):
        assert {"name", "entry", "language"} <= one.keys() and one["pass_filenames"] is False
        program, verb, *arguments = split(one["entry"])
        assert program == "rovercheck"
        app.commands[verb].make_context(verb, arguments, parent=click.Context(app))
    assert re.search(used["files"], "heater.py") and re.search(hook["files"], "model/baseline.toml")
