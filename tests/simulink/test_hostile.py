"""The parts of a package of a stranger are read within bounds, or refused in one message."""

from contextlib import suppress
from encodings.aliases import aliases
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.simulink import blocks, package, xml
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import DIAGRAM, Files, WrittenModel, packed
from rovercheck.checker.simulink.xml import parsed
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.corruption import damaged
from tests.simulink.hostile import CHART, ROOT, harmless, lamp, outcome, package_in, refused_parts
from tests.simulink.samples import SAMPLES, package_of

MANY = 200
"""Random damages of each example; ``python -m tests.simulink.corruption`` tries any number of them."""

# --- random damage -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("sample", SAMPLES)
def test_whatever_is_damaged_there_is_a_model_or_a_message(sample: str, tmp_path: Path) -> None:
    before = {file.name for file in package_of(sample).parent.iterdir()}
    found = []
    for _ in damaged(sample, MANY, 0, tmp_path):
        found.append(outcome(tmp_path / package_of(sample).name))
    refused = [one for one in found if isinstance(one, str)]
    assert MANY // 20 < len(refused) < MANY - MANY // 20
    assert {file.name for file in tmp_path.iterdir()} <= before


# --- XML ---------------------------------------------------------------------------------------------------

LAUGHS = """<!DOCTYPE a [<!ENTITY a "ha"><!ENTITY b "&a;&a;"><!ENTITY c SYSTEM "file:/etc/passwd">]>
<a>&b;&c;</a>"""


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1", "shift_jis"])
@pytest.mark.parametrize("text", [LAUGHS, "<!DOCTYPE a>\n<a/>", '<!DOCTYPE a SYSTEM "http://a/b.dtd"><a/>'])
def test_a_doctype_is_refused_in_every_encoding(text: str, encoding: str, tmp_path: Path) -> None:
    declared = f'<?xml version="1.0" encoding="{encoding.removesuffix("-sig")}"?>\n{text}'
    said = refused_parts(lamp(chart=declared.encode(encoding)), tmp_path)
    assert said == (
        f"hostile.slx, part {CHART}, line 2: a <!DOCTYPE> may define entities, and is not read. Simulink "
        "writes none: save the model again."
    )


def test_an_entity_without_a_doctype_is_not_known(tmp_path: Path) -> None:
    assert "undefined entity" in refused_parts(lamp(chart="<chart>&b;</chart>"), tmp_path)


@pytest.mark.filterwarnings("ignore:.*escape:DeprecationWarning")
def test_every_encoding_that_is_known_or_not_gives_a_text_or_a_message() -> None:
    for name in sorted({*aliases.values(), "idna", "punycode", "undefined", "no-such", "a" * 99}):
        with harmless(), suppress(ModelError):
            assert parsed(f'<?xml version="1.0" encoding="{name}"?><a/>'.encode(), "here")[0].tag == "a"
    with pytest.raises(ModelError, match="here: it is no XML: unknown encoding: no-such"):
        parsed(b'<?xml version="1.0" encoding="no-such"?><a/>', "here")


def test_elements_in_each_other_are_read_up_to_a_bound(tmp_path: Path) -> None:
    deep = xml.MOST_DEPTH
    files = lamp(root=f"<System>{'<a>' * (deep - 1)}{'</a>' * (deep - 1)}</System>")
    packed(tmp_path / "deep.slx", files)
    assert not isinstance(outcome(tmp_path / "deep.slx"), str)
    said = refused_parts(lamp(root=f"<System>{'<a>' * deep}{'</a>' * deep}</System>"), tmp_path)
    assert f"no more than {deep} elements in each other are read" in said
    assert "elements in each other" in refused_parts(lamp(root="<a>" * 1_000_000), tmp_path)


def test_elements_of_all_parts_are_counted_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(package, "MOST_ELEMENTS", 1000)
    many = f"<System>{'<Block/>' * 600}</System>"
    assert not isinstance(outcome(package_in(tmp_path, lamp(root=many))), str)
    model = WrittenModel("two")
    model.root.subsystem("below", 0, 0)
    files = model.files() | {"simulink/systems/system_1.xml": many.encode()}
    assert not isinstance(outcome(package_in(tmp_path, files)), str)
    own = files[ROOT].replace(b"</System>", b"<Block/>" * 600 + b"</System>")
    assert "in one package" in refused_parts(files | {ROOT: own}, tmp_path)


@pytest.mark.parametrize("states", [20, 97])
def test_states_in_each_other_are_told_at_any_depth_that_is_read(
    states: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    start = '<state SSID="{}"><P Name="type">OR_STATE</P><P Name="labelString">S</P><Children>'
    text = "".join(start.format(number) for number in range(1, states + 1)) + "</Children></state>" * states
    path = package_in(tmp_path, lamp(chart=f'<chart id="22"><Children>{text}</Children></chart>'))
    assert len(list(read_model(path).charts[0].content.every_state())) == states
    assert run(["import", str(path)]) == Exit.INCONCLUSIVE  # its output comes from nowhere
    assert run(["import", str(path), "--json"]) == Exit.INCONCLUSIVE
    assert capsys.readouterr().err == ""


# --- systems -----------------------------------------------------------------------------------------------


def block(number: int, inside: str) -> str:
    return f'<Block BlockType="SubSystem" Name="b" SID="{number}">{inside}</Block>'


def chain(many: int, last: str) -> Files:
    """Systems that each have the next one in a block."""
    parts = {f"system_{n}": f'<System Ref="system_{n + 1}"/>' for n in range(many)} | {f"system_{many}": last}
    files = {
        f"simulink/systems/{name}.xml": f"<System>{block(n, inside)}</System>".encode()
        for n, (name, inside) in enumerate(parts.items())
    }
    top = "<ModelInformation><Model><System Ref='system_0'/></Model></ModelInformation>"
    return {DIAGRAM: top.encode(), **files}


def test_systems_in_each_other_are_read_up_to_a_bound(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = package_in(tmp_path, chain(blocks.MOST_LEVELS - 2, ""))
    assert run(["import", str(path), "--json"]) in (Exit.AS_EXPECTED, Exit.INCONCLUSIVE)
    inline = "<System>" + block(1, "") + "</System>"
    for number in range(blocks.MOST_LEVELS - 1):
        inline = f"<System>{block(number, inline)}</System>"
    told = f"no more than {blocks.MOST_LEVELS} systems in each other are read"
    assert run(["import", str(package_in(tmp_path, lamp(root=inline))), "--json"]) in (
        Exit.AS_EXPECTED,
        Exit.INCONCLUSIVE,
    )
    assert capsys.readouterr().err == ""
    assert told in refused_parts(lamp(root=f"<System>{block(1, inline)}{block(2, '')}</System>"), tmp_path)
    assert told in refused_parts(chain(1000, ""), tmp_path)


@pytest.mark.parametrize("last", ["system_0", "system_3", "system_7"])
def test_a_system_that_is_in_itself_is_refused(last: str, tmp_path: Path) -> None:
    said = refused_parts(chain(7, f'<System Ref="{last}"/>'), tmp_path)
    assert f"part simulink/systems/{last}.xml: the system is in itself, or in two blocks" in said


def test_systems_that_many_blocks_have_are_refused_before_they_multiply(tmp_path: Path) -> None:
    files = {
        name: text.replace(b"</System>", text.removeprefix(b"<System>"))
        for name, text in chain(40, "").items()
    }
    assert "in two blocks" in refused_parts(files, tmp_path)


def test_a_part_that_only_names_another_one_is_refused(tmp_path: Path) -> None:
    said = refused_parts(lamp(root='<System Ref="system_3"/>'), tmp_path)
    assert f"part {ROOT}: in place of a system it has the name of another one" in said


def test_long_names_of_systems_do_not_multiply(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(blocks, "MOST_LETTERS", 100_000)
    inside = "<System>" + '<Block Name="b"/>' * 100 + "</System>"
    named = f'<System><Block Name="{{}}" SID="1">{inside}</Block></System>'
    assert not isinstance(outcome(package_in(tmp_path, lamp(root=named.format("a" * 900)))), str)
    said = refused_parts(lamp(root=named.format("a" * 1000)), tmp_path)
    assert "the paths of the blocks have more than 100,000 letters" in said


# --- parts and values --------------------------------------------------------------------------------------


@pytest.mark.parametrize("part", [ROOT, CHART, "simulink/systems/system_3.xml"])
def test_a_part_that_is_missing_is_named(part: str, tmp_path: Path) -> None:
    files = {name: text for name, text in lamp().items() if name != part}
    said = refused_parts(files, tmp_path)
    assert said == f"hostile.slx, part {part}: it is missing. Save the model again in Simulink."


STATE = '<chart id="1"><Children>{}</Children></chart>'


@pytest.mark.parametrize(
    ("chart", "said"),
    [
        (
            '<state SSID="x"><P Name="type">OR_STATE</P></state>',
            "SSID of <state> is 'x', and no whole number",
        ),
        (f'<state SSID="{"9" * 30}"/>', f"SSID of <state> is '{'9' * 30}', and no whole number"),
        ('<state><P Name="type">OR_STATE</P></state>', "SSID of <state> is '', and no whole number"),
        (
            '<state SSID="1"><P Name="type">ODD</P></state>',
            "type of <state> is 'ODD', which is not known here",
        ),
        ('<transition SSID="1"><src><P Name="SSID">1e3</P></src></transition>', "src/SSID of <transition>"),
        (
            '<transition SSID="1"><P Name="executionOrder">1.5</P></transition>',
            "executionOrder of <transition>",
        ),
        ('<data SSID="1"><P Name="scope">&#x9b;&#10;</P></data>', r"scope of <data> is '\x9b\n'"),
        ('<event SSID="1"><P Name="scope">X</P></event>', "known are LOCAL_EVENT, INPUT_EVENT, OUTPUT_EVENT"),
    ],
)
def test_a_value_without_a_meaning_is_refused_with_its_line(chart: str, said: str, tmp_path: Path) -> None:
    told = refused_parts(lamp(chart=STATE.format("\n" + chart)), tmp_path)
    assert told.startswith(f"hostile.slx, part {CHART}, line 2: ") and said in told


@pytest.mark.parametrize("name", ["a&#10;b", "&#x9b;2J", "x" * 9999, "../../etc/passwd", "&#x202e;"])
def test_a_name_of_a_part_in_a_part_is_only_looked_up(name: str, tmp_path: Path) -> None:
    machine = f'<Stateflow><machine id="1"><Children><chart Ref="{name}"/></Children></machine></Stateflow>'
    assert "it is missing" in refused_parts(lamp(machine=machine), tmp_path)
    assert "it is missing" in refused_parts(
        lamp(root=f"<System>{block(1, f'<System Ref={chr(34)}{name}{chr(34)}/>')}</System>"), tmp_path
    )


def test_names_with_control_characters_reach_no_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = WrittenModel("odd")
    _, chart = model.root.chart("a\nb\x9b2J\u202e")
    chart.state("S\x9b\nen: x = 1;", more={"isNoteBox": 0})
    chart.data("d\u202e", "local", "string")
    model.root.block("Reference", "lib\x9b")
    path = model.save(tmp_path / "odd.slx")
    for arguments in (["import", str(path)], ["import", str(path), "--json"]):
        assert run(arguments) == 2
        said = capsys.readouterr().out
        assert all(char.isprintable() or char == "\n" for char in said)
    assert read_model(path).charts[0].name == "a\nb\x9b2J\u202e"
