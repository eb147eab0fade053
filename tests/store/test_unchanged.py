"""The unchanged rover: what is told the second time is what was told the first time, or is decided anew."""

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check import run as checking
from rovercheck.checker.commands.check import unchanged
from rovercheck.checker.commands.check.run import CheckOutput, CheckRequest
from rovercheck.checker.commands.check.unchanged import ToldModel, ToldStore, keepable
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import SearchOptions, SelectionOptions
from rovercheck.checker.store.tree import tree_key
from tests.store.test_entries import MODEL, TOLD

pytestmark = pytest.mark.usefixtures("folder", "no_child")
SOME = ("PB1-30c-FL", "PB1-15", "PB1-11")
"""Properties of the rover that are soon decided, proofs and violations."""


@dataclass
class Rover:
    """Checks of the rover; ``decided`` are the properties that were asked for when it was not served."""

    said: list[str] = field(default_factory=list)
    decided: list[tuple[str, ...]] = field(default_factory=list)

    def check(self, *options: str) -> Exit:
        self.decided.clear()
        return Exit(run(["check", *options]))

    @property
    def served(self) -> bool:
        return not self.decided


@pytest.fixture
def rover(monkeypatch: pytest.MonkeyPatch) -> Iterator[Rover]:
    made, check = Rover(), checking.check

    def noted(request: CheckRequest, output: CheckOutput = checking.PRINTED) -> Exit:
        made.decided.append(tuple(p.id for p in request.properties))
        return check(request, output)

    monkeypatch.setattr(checking, "check", noted)
    yield made


@pytest.fixture
def quick(rover: Rover, monkeypatch: pytest.MonkeyPatch) -> Rover:
    """Decides nothing where it is not served, so that a test need not wait for it."""

    def noted(request: CheckRequest, output: CheckOutput = checking.PRINTED) -> Exit:
        rover.decided.append(tuple(p.id for p in request.properties))
        return Exit.AS_EXPECTED

    monkeypatch.setattr(checking, "check", noted)
    return rover


@pytest.fixture
def known() -> ToldModel:
    """What the catalogue says of the properties of the rover."""
    from rovercheck.checker.commands.check.unchanged import ToldProperty
    from rovercheck.properties.catalogue import catalogue
    from rovercheck.spec_model.rover import systems

    properties = {id: ToldProperty(p.on, p.costly) for id, p in catalogue().items()}
    return ToldModel(properties, list(systems()), {})


def kept_of(known: ToldModel, ids: Iterable[str]) -> None:
    """Keep that some properties were told."""
    from dataclasses import replace

    place = ToldStore.now(SearchOptions("auto", None, None, "exact"))
    assert place is not None
    place.add(replace(known, verdicts={id: replace(TOLD, id=id) for id in ids}))


def lines(capsys: pytest.CaptureFixture[str]) -> list[str]:
    return sorted(capsys.readouterr().out.splitlines())


def test_text_and_json_are_the_same_the_second_time(rover: Rover, capsys: pytest.CaptureFixture[str]) -> None:
    code = rover.check(*SOME)
    first = lines(capsys)
    assert not rover.served and len(first) > len(SOME)
    assert rover.check(*SOME) is code and rover.served
    assert lines(capsys) == first
    assert rover.check(*SOME, "--json") is code and rover.served
    told = json.loads(capsys.readouterr().out)
    assert rover.check(*SOME, "--json", "--no-store") is code and not rover.served
    anew = json.loads(capsys.readouterr().out)
    for one in (told, anew):
        one["results"].sort(key=lambda row: row["id"])
    assert told == anew
    assert rover.check(*SOME, "--quiet") is code and rover.served and not capsys.readouterr().out
    strict = rover.check(*SOME, "--strict")
    assert rover.served
    served = lines(capsys)
    assert rover.check(*SOME, "--strict", "--no-store") is strict and not rover.served
    assert lines(capsys) == served
    assert rover.check(SOME[0]) is Exit.AS_EXPECTED and rover.served, "one of them"
    assert rover.check(*SOME, "--recheck") is code and not rover.served
    assert rover.check(*SOME) is code and not rover.served, "what was told before is told anew"


NOT_SERVED = {
    "another interpretation": ("--interpret", "S43=AND"),
    "a repair": ("--repair", "stop-unconditional"),
    "another engine": ("--engine", "bmc", "--depth", "5"),
    "another depth": ("--depth", "7"),
    "other timers": ("--timers", "free"),
    "every engine": ("--all-engines",),
    "certificates": ("--certify",),
    "no premises": ("--no-premises",),
    "no store": ("--no-store",),
    "a file": ("--junit", "{folder}/j.xml"),
    "another file": ("--sarif", "{folder}/s.json"),
    "annotations": ("--annotations", "github"),
}


@pytest.mark.parametrize("how", NOT_SERVED)
def test_what_asks_for_something_else_is_not_served(
    how: str, quick: Rover, known: ToldModel, tmp_path: Path
) -> None:
    kept_of(known, SOME)
    quick.check(*SOME)
    assert quick.served
    quick.check(*SOME, *(word.format(folder=tmp_path) for word in NOT_SERVED[how]))
    assert not quick.served, how


def test_a_variable_switches_it_off(quick: Rover, known: ToldModel, monkeypatch: pytest.MonkeyPatch) -> None:
    kept_of(known, SOME)
    monkeypatch.setenv("ROVERCHECK_STORE", "")
    quick.check(*SOME)
    assert not quick.served


def test_the_beginning_of_ids_is_not_served_as_an_id(quick: Rover, known: ToldModel) -> None:
    forms = tuple(id for id in known.properties if id.startswith("PB1-16") and not id[6:7].isdigit())
    assert len(forms) > 2 and "PB1-16" not in known.properties
    kept_of(known, forms[:-1])
    quick.check("PB1-16")
    assert [set(ids) for ids in quick.decided] == [set(forms)]


def test_an_id_that_begins_others_is_served_alone(
    quick: Rover, known: ToldModel, capsys: pytest.CaptureFixture[str]
) -> None:
    id = next(
        one for one in known.properties if any(o != one and o.startswith(one) for o in known.properties)
    )
    kept_of(known, [id])
    quick.check(id, "--json")
    assert quick.served
    assert [row["id"] for row in json.loads(capsys.readouterr().out)["results"]] == [id]


def test_an_unknown_name_is_still_answered_with_near_ones(
    quick: Rover, known: ToldModel, capsys: pytest.CaptureFixture[str]
) -> None:
    kept_of(known, known.properties)
    assert quick.check("PB1-9999") is Exit.USAGE
    assert "There is no property 'PB1-9999'" in capsys.readouterr().err
    assert quick.check("--system", "relai") is Exit.USAGE
    assert "Did you mean 'relay'" in capsys.readouterr().err


def test_a_selection_is_served_as_it_is_decided(
    quick: Rover, known: ToldModel, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """By ids, twice the same one, by systems, both, and those that take long too."""
    kept_of(known, known.properties)
    ids = list(known.properties)
    selections: list[tuple[str, ...]] = [
        ("--system", "relay"), ("--system", "relay", "--system", "masks"), ("--full", "--system", "relay"),
        (ids[3], ids[1], ids[3]), (*SOME, "--system", "relay"), (), ("--system", "obstacles", "--full"),
    ]  # fmt: skip
    for words in selections:
        quick.check(*words, "--json")
        assert quick.served, words
        served = [row["id"] for row in json.loads(capsys.readouterr().out)["results"]]
        quick.check(*words, "--no-store")
        [asked] = quick.decided
        assert sorted(served) == sorted(asked), words


def test_all_of_it_is_not_served_where_chains_are_told_too(quick: Rover, known: ToldModel) -> None:
    kept_of(known, known.properties)
    quick.check("--full")
    assert not quick.served


def test_where_one_was_not_told_all_are_asked(quick: Rover, known: ToldModel) -> None:
    kept_of(known, SOME[:-1])
    quick.check(*SOME)
    assert [set(ids) for ids in quick.decided] == [set(SOME)]


def test_a_selection_without_properties_is_not_served(quick: Rover, known: ToldModel) -> None:
    kept_of(known, SOME)
    quick.check(SOME[0], "--system", "masks")
    assert not quick.served


def test_what_was_told_earlier_stays_beside_what_is_told_now(known: ToldModel) -> None:
    kept_of(known, SOME[:1])
    kept_of(known, SOME[1:])
    place = ToldStore.now(SearchOptions("auto", None, None, "exact"))
    assert place is not None
    found = place.read()
    assert found is not None and found.verdicts.keys() == {*SOME}
    assert all(found.chosen(SelectionOptions((id,))) for id in SOME)


def test_each_search_has_its_own_place() -> None:
    asked = [
        SearchOptions(engine, depth, 3.0, timers)
        for engine in ("auto", "bmc")
        for depth in (None, 5)
        for timers in ("exact", "free")
    ]
    places = {place.name for one in asked if (place := ToldStore.now(one)) is not None}
    assert len(places) == len(asked)


def test_what_is_open_is_not_kept() -> None:
    from dataclasses import replace

    assert keepable(TOLD)
    assert not keepable(replace(TOLD, word="unknown"))
    assert not keepable(replace(TOLD, asked=True, occurs=None))
    assert keepable(replace(TOLD, asked=True, occurs=False))


def test_an_edit_of_any_file_is_noticed(
    quick: Rover, known: ToldModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept_of(known, SOME)
    monkeypatch.setattr(unchanged, "tree_key", lambda: "edited")
    quick.check(*SOME)
    assert not quick.served
    monkeypatch.setattr(unchanged, "tree_key", tree_key)
    quick.check(*SOME)
    assert quick.served and MODEL.verdicts
