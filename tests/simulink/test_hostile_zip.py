"""A ZIP file of a stranger is read within bounds, or refused in one message, whatever is in it."""

from pathlib import Path
from struct import pack_into
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZIP_LZMA, ZipFile, ZipInfo

import pytest

from rovercheck.checker.simulink import package
from rovercheck.checker.simulink.dictionary import MOST_DICTIONARIES
from rovercheck.checker.simulink.writer.packages import DIAGRAM, WrittenModel, packed
from tests.simulink.hostile import ROOT, lamp, outcome, package_in, refusal, refused_parts


def test_a_part_that_unpacks_to_too_much_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(package, "MOST_BYTES", 1 << 20)
    said = refused_parts(lamp(root=f"<System>{' ' * (2 << 20)}</System>"), tmp_path)
    assert said == f"hostile.slx, part {ROOT}: more than 1 MiB of parts, unpacked, are not read."
    halves = lamp(root=f"<System>{' ' * (600 << 10)}</System>", chart=f"<chart>{' ' * (600 << 10)}</chart>")
    assert "more than 1 MiB of parts" in refused_parts(halves, tmp_path)
    unread = {**lamp(), "simulink/picture.png": b"\0" * (2 << 20)}
    assert not isinstance(outcome(package_in(tmp_path, unread)), str)


def test_a_file_that_is_too_large_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(package, "MOST_BYTES", 1 << 20)
    (tmp_path / "large.slx").write_bytes(b"PK" * (1 << 20))
    assert refusal(tmp_path / "large.slx") == "large.slx: more than 1 MiB are not read."


def test_a_size_that_is_a_lie_does_not_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(package, "MOST_BYTES", 1 << 20)
    path = package_in(tmp_path, lamp(root=f"<System>{' ' * (2 << 20)}</System>"))
    data = bytearray(path.read_bytes())
    for start, offset in ((b"PK\x01\x02", 24), (b"PK\x03\x04", 22)):
        at = -1
        while (at := data.find(start, at + 1)) >= 0:
            pack_into("<I", data, at + offset, 100)
    path.write_bytes(data)
    assert isinstance(outcome(path), str)


def test_many_parts_are_refused_before_there_is_an_object_for_each(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "many.slx").write_bytes(package.ENTRY * (package.MOST_PARTS + 1))
    assert refusal(tmp_path / "many.slx") == "many.slx: more than 20,000 parts in one package are not read."
    monkeypatch.setattr(package, "MOST_PARTS", 20)
    parts = {f"part{number}": b"" for number in range(10)}
    assert "more than 20 parts" in refused_parts({**lamp(), **parts}, tmp_path)


@pytest.mark.parametrize(
    "name",
    [
        "/etc/passwd",
        "//a",
        "../a.xml",
        "a/../../b",
        "a\\..\\b",
        "C:/a",
        "a\nb",
        "a\x1b[2Jb",
        "a\u202eb",
        "a\x9bb",
    ],
)
def test_a_part_with_a_name_that_is_none_is_refused(name: str, tmp_path: Path) -> None:
    said = refused_parts({**lamp(), name: b""}, tmp_path)
    assert said == f"hostile.slx: {name!r} is no name of a part. Save the model again in Simulink."


@pytest.mark.filterwarnings("ignore:Duplicate name:UserWarning")
def test_a_part_that_is_there_twice_is_refused(tmp_path: Path) -> None:
    path = package_in(tmp_path, lamp())
    with ZipFile(path, "a") as zipped:
        zipped.writestr(ROOT, "<System/>")
    assert f"the part {ROOT} is there twice" in refusal(path)


@pytest.mark.parametrize("method", [ZIP_BZIP2, ZIP_LZMA])
def test_a_part_that_is_packed_by_another_method_is_refused(method: int, tmp_path: Path) -> None:
    with ZipFile(tmp_path / "other.slx", "w", method) as zipped:
        for name, text in lamp().items():
            zipped.writestr(name, text)
    assert "packed by a method that is not Simulink's" in refusal(tmp_path / "other.slx")


@pytest.mark.parametrize(("offset", "value"), [(8, 1), (8, 0x41), (8, 0x20), (10, 99), (10, 14), (10, 0)])
def test_flags_and_methods_that_do_not_fit_are_refused(offset: int, value: int, tmp_path: Path) -> None:
    """Encrypted parts, patches, unknown methods, and packed parts that are said to be plain."""
    path = package_in(tmp_path, lamp())
    data = bytearray(path.read_bytes())
    at = -1
    while (at := data.find(b"PK\x01\x02", at + 1)) >= 0:
        data[at + offset] = value
    path.write_bytes(data)
    assert f"part {DIAGRAM}: " in refusal(path)


def test_a_file_that_is_cut_anywhere_is_refused(tmp_path: Path) -> None:
    whole = package_in(tmp_path, lamp()).read_bytes()
    for length in range(0, len(whole) - 1, 97):
        (tmp_path / "cut.slx").write_bytes(whole[:length])
        assert "it is no package of Simulink" in refusal(tmp_path / "cut.slx")


def test_a_zip_in_front_of_a_zip_is_no_other_model(tmp_path: Path) -> None:
    """What stands before a package is no part of it: the list at its end counts."""
    whole = package_in(tmp_path, lamp()).read_bytes()
    (tmp_path / "model.slx").write_bytes(b"#!/bin/sh\nexit 1\n" + whole)
    assert not isinstance(outcome(tmp_path / "model.slx"), str)


def test_what_is_no_file_or_no_package_is_told(tmp_path: Path) -> None:
    (tmp_path / "text.slx").write_text("Model {\n}\n", encoding="utf-8")
    assert "it is no package of Simulink: File is not a zip file" in refusal(tmp_path / "text.slx")
    assert "Name a file of Simulink" in refusal(tmp_path)
    assert "Name a file of Simulink" in refusal(tmp_path / "gone.slx")
    with ZipFile(tmp_path / "empty.slx", "w", ZIP_DEFLATED) as zipped:
        zipped.writestr(ZipInfo("a/"), "")
    assert f"it has no part {DIAGRAM}" in refusal(tmp_path / "empty.slx")


# --- dictionaries ------------------------------------------------------------------------------------------


def beside(chunk: str, folder: Path) -> str:
    """Why a model with a dictionary is not read."""
    packed(folder / "types.sldd", {"data/chunk0.xml": f"<DataSource>{chunk}</DataSource>"})
    return refusal(WrittenModel("typed", dictionary="types.sldd").save(folder / "typed.slx"))


def test_a_member_that_is_no_number_is_refused(tmp_path: Path) -> None:
    member = '<Element><P Name="Name">A&#10;B</P><P Name="Value">1e5</P></Element>'
    value = f'<Element Class="EnumTypeDefinition"><P Name="Enumerals">{member}</P></Element>'
    entry = f'<Object Class="DD.ENTRY"><P Name="Name">Gear</P><P Name="Value">{value}</P></Object>'
    assert beside(entry, tmp_path) == (
        "types.sldd, part data/chunk0.xml, line 1: 'A\\nB' of 'Gear' is '1e5', and no whole number. Members "
        "of an enumeration are whole numbers."
    )


@pytest.mark.parametrize("name", ["a&#10;b", "&#x9b;", "x" * 300])
def test_a_dictionary_with_a_name_that_is_none_is_refused(name: str, tmp_path: Path) -> None:
    said = beside(f'<DictionaryReference><P Name="Name">{name}.sldd</P></DictionaryReference>', tmp_path)
    assert "part data/chunk0.xml, line 1: it refers to the dictionary" in said


@pytest.mark.parametrize("name", ["gone", "../gone", "/etc/gone", "a/b/gone"])
def test_dictionaries_are_looked_for_beside_the_first_one_only(name: str, tmp_path: Path) -> None:
    said = beside(f"<Reference>{name}.sldd</Reference>", tmp_path)
    assert said == "gone.sldd: No such file or directory. Name a file of Simulink, .slx or .sldd."


def test_dictionaries_without_an_end_are_refused(tmp_path: Path) -> None:
    for number in range(MOST_DICTIONARIES + 1):
        text = f"<DataSource><Reference>{number + 1}.sldd</Reference></DataSource>"
        packed(tmp_path / f"{number}.sldd", {"data/chunk0.xml": text})
    model = WrittenModel("typed", dictionary="0.sldd").save(tmp_path / "typed.slx")
    assert "no more than 100 dictionaries are read for one" in refusal(model)
