"""What events carry: read where the event is one from outside, as inputs in their domains."""

import json
from pathlib import Path

import pytest

from rovercheck import check, scxml_model
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved, Verdict, Violated
from rovercheck.checker.scxml.interpret import MachineRunner
from rovercheck.checker.scxml.reader import machine_of
from rovercheck.spec_model.lang.errors import ModelError

SPACE = "<scxml xmlns='http://www.w3.org/2005/07/scxml' datamodel='ecmascript'>"
DATA = "<datamodel><data id='x' expr='0'/><data id='b' expr='false'/></datamodel>"
FAST = (
    "<state id='slow'><transition event='speed' cond='_event.data.value &gt; 50' target='fast'>"
    "<assign location='x' expr='_event.data.value'/><assign location='b' expr='_event.data.braking'/>"
    "</transition></state><state id='fast'><transition event='stop' target='slow'/></state>"
)


def written(folder: Path, inside: str, domains: str = "") -> Path:
    file = folder / "toy.scxml"
    file.write_text(f"{SPACE}{DATA}{inside}</scxml>", encoding="utf-8")
    if domains:
        file.with_suffix(".domains.toml").write_text(f"[domains]\n{domains}\n", encoding="utf-8")
    return file


def test_by_the_algorithm_of_the_standard() -> None:
    runner = MachineRunner(machine_of(f"{SPACE}{DATA}{FAST}</scxml>".encode(), "toy.scxml"))
    runner.step("speed", carried={"value": 50, "braking": True})
    assert [one.id for one in runner.active] == ["slow"] and runner.data == {"x": 0, "b": False}
    runner.step("speed", carried={"value": 51, "braking": True})
    assert [one.id for one in runner.active] == ["fast"] and runner.data == {"x": 51, "b": True}


def verdicts(file: Path, **demands: str) -> dict[str, Verdict]:
    """Of conditions on ``m``, the machine in a file, that must always hold."""
    beside = file.with_name(f"{file.stem}_properties.py")
    each = "".join(
        f"    always('{id}', 'T.', that={that}, covers=['R'], on=m.system),\n" for id, that in demands.items()
    )
    head = f"from rovercheck import always, implies, scxml_model\n\nm = scxml_model('{file.name}')"
    beside.write_text(f"{head}\nPROPERTIES = [\n{each}]\nREQUIREMENTS = {{'R': 'T.'}}\n", encoding="utf-8")
    return {one.result.property.id: one.result.verdict for one in check(str(file))}


def test_a_property_of_what_an_event_carries(tmp_path: Path) -> None:
    file = written(tmp_path, FAST, '"event.value" = { low = 0, high = 60 }\nx = { low = 0, high = 60 }')
    notes = " ".join(map(str, scxml_model(file).system.notes))
    assert "Each event from outside carries value, braking" in notes
    found = verdicts(file, ABOVE="(m['x'] == 0) | (m['x'] > 50)", BELOW="m['x'] < 60")
    below = found["BELOW"]
    assert isinstance(found["ABOVE"], Proved) and isinstance(below, Violated)
    assert isinstance(below.because, Trace)
    assert below.because.ticks[-1].inputs["event.value"] == 60


def test_domains_are_proposed_from_what_is_a_copy_of_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = written(tmp_path, FAST)
    assert run(["import", str(file)]) == Exit.INCONCLUSIVE
    said = " ".join(capsys.readouterr().out.split())
    assert "no domain is given for" in said and "They carry: value, braking." in said
    assert run(["import", "--propose-domains", str(file)]) == Exit.AS_EXPECTED
    text = file.with_suffix(".domains.toml").read_text(encoding="utf-8")
    assert '"event.value" = { low = 0, high = 51 }' in text and "x = { low = 0, high = 51 }" in text
    capsys.readouterr()
    assert run(["import", "--json", str(file)]) == Exit.AS_EXPECTED
    assert json.loads(capsys.readouterr().out)["event_data"] == {"value": "integer", "braking": "boolean"}


RAISES = "<state id='a'><onexit><raise event='i'/></onexit>"
READ = "<assign location='x' expr='_event.data.n'/>"


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        (
            f"\n<state id='a'><onentry>{READ}</onentry></state>",
            "a begins or ends, whatever the event is",
        ),
        (
            f"<state id='a'>\n<transition cond='x == 1'>{READ}</transition></state>",
            "where the event may be any",
        ),
        (
            f"{RAISES}\n<transition event='i'>{READ}</transition></state>",
            "line 2: <transition>: _event.data.n where the event may be i, which carries nothing",
        ),
        (
            "<state id='a'>\n<transition event='e' cond='_event.data.n'><assign location='x' "
            "expr='_event.data.n'/></transition></state>",
            "is a number in one place and a truth value in another",
        ),
        (
            "<state id='a'>\n<transition event='e' cond='_event.data.n == _event.data.m'/></state>",
            "nothing says whether '_event.data.n' is a number or a truth value",
        ),
        ("<state id='a'>\n<transition event='e' cond='_event.data.n.m == 1'/></state>", "no exact meaning"),
        ("<state id='a'>\n<transition event='e' cond='_event.name == 1'/></state>", "no exact meaning"),
    ],
)
def test_what_is_not_known_to_be_carried_is_refused(inside: str, said: str) -> None:
    with pytest.raises(ModelError) as raised:
        machine_of(f"{SPACE}{DATA}{inside}</scxml>".encode(), "toy.scxml")
    assert said in str(raised.value) and "toy.scxml, line 2" in str(raised.value)


@pytest.mark.parametrize(
    ("domains", "said"),
    [
        ('"event.valu" = { low = 0, high = 1 }', "event.valu is no datum. Did you mean 'event.value'?"),
        ('"event.braking" = { low = 0, high = 1 }', "event.braking is true or false, and has no domain"),
        (
            '"event.value" = { low = 0, high = 1, resolution = 0.5 }',
            "event.value has whole numbers. Write",
        ),
        ("x = { low = 0, high = 60 }", 'Write "event.value" = { low = 0, high = 9 }'),
    ],
)
def test_domains_that_do_not_fit_are_told(domains: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(ModelError) as raised:
        scxml_model(written(tmp_path, FAST, domains))
    assert said in str(raised.value)


def test_a_chart_that_was_exported_is_checked_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Fig 16: Board 1 drives again only 3 s after the last critical status."""
    file = tmp_path / "relay.scxml"
    assert run(["export", "--format", "scxml", "--system", "relay", "-o", str(file)]) == Exit.AS_EXPECTED
    assert run(["import", "--propose-domains", str(file)]) == Exit.AS_EXPECTED
    capsys.readouterr()
    fine = "(m['rx_status'] != 2) & (m['b2_sup_status'] != 2)"
    drives = "m['give_b2_actuation']"
    found = verdicts(
        file, STATE=f"m.active('B2_actuating') == {drives}", RETURN=f"implies({fine}, ~{drives})"
    )
    assert isinstance(found["STATE"], Proved) and isinstance(found["RETURN"], Violated)
