"""Places: transitions, states, charts and properties know the line at which they are written."""

import pickle
from dataclasses import replace
from inspect import currentframe
from pathlib import Path

import pytest

from rovercheck.properties.catalogue import as_written, catalogue
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.chart import Chart, State, Transition, to
from rovercheck.spec_model.lang.edit import drop, guard
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, flag
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.place import Place, here
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.rover import systems

ROOT = Path(__file__).parents[2]
go = flag("go")


def line() -> int:
    frame = currentframe()
    assert frame is not None and frame.f_back is not None
    return frame.f_back.f_lineno


START = line()
lamp = Chart(
    "Lamp",
    [
        State("Off", transitions=[to("On", when=go)]),
        State(
            "On",
            transitions=[
                to("Off", when=~go),
                to("Off", when=go & go),
            ],
        ),
    ],
    default="Off",
)  # fmt: skip


def lines(chart: Chart) -> list[int]:
    """The line of the chart, and of each transition in drawing order, as distances from ``START``."""
    found = [chart.place, *(transition.place for transition in chart.transitions)]
    assert all(place is not None and place.file == __file__ for place in found)
    return [place.line - START for place in found if place is not None]


def test_lines_are_those_of_the_words() -> None:
    assert lines(lamp) == [1, 1, 4, 8, 9], "the default transition is written with the chart"
    places = [state.place for state in lamp.states.values()]
    assert [place.line - START for place in places if place is not None] == [1, 4, 5]


def test_a_property_knows_its_line() -> None:
    at = line() + 1
    made = always("X", "It is.", that=go, covers=["B1-REL-04"], on="relay")
    assert made.place == Place(__file__, at)


def test_every_transition_and_property_of_the_rover_has_a_place() -> None:
    for system in systems().values():
        for chart in system.charts:
            assert chart.place and (ROOT / chart.place.path).is_file()
            assert all(transition.place for transition in chart.transitions)
    for prop in as_written().values():
        assert prop.place and prop.place.path.startswith(("properties/areas/", "properties/promises/"))
        written = (ROOT / prop.place.path).read_text(encoding="utf-8").splitlines()
        near = "".join(written[prop.place.line - 1 : prop.place.line + 2])
        assert f'"{prop.id}"' in near or "{" in near, "its id, or what its id is made of"
    assert all(prop.place for prop in catalogue().values())


def test_places_survive_what_is_done_to_charts() -> None:
    assert lines(pickle.loads(pickle.dumps(lamp))) == lines(lamp)
    fixed = Specialiser({"elsewhere": Const(1, TRUE.sort)}).chart(lamp)
    assert lines(fixed) == lines(lamp)
    assert lines(Specialiser({"go": Const(1, TRUE.sort)}).chart(lamp)) == [1, 1, 4, 9]
    assert lines(drop(lamp, "On", 1)) == [1, 1, 4, 9]
    assert lines(guard(lamp, "On", 1, lambda g: g | FALSE)) == lines(lamp)
    assert lines(lamp.with_local_data([])) == lines(lamp)


def test_places_are_no_part_of_what_is_equal_or_shown() -> None:
    transition = Transition("On")
    moved = replace(transition, place=Place("other.py", 3))
    assert transition == moved and hash(transition) == hash(moved) and repr(transition) == repr(moved)
    state = lamp.states[("Off",)]
    assert state == replace(state, place=None) and "place" not in repr(state)
    prop = next(iter(catalogue().values()))
    assert prop == replace(prop, place=None) and repr(prop) == repr(replace(prop, place=None))


def test_what_engines_and_certificates_see_is_the_same() -> None:
    def bare(state: State) -> State:
        transitions = [replace(t, place=None) for t in state.transitions]
        inside = [bare(s) for s in state.states]
        return replace(
            state, transitions=tuple(transitions), states=tuple(inside), place=Place("other.py", 1)
        )

    moved = Chart("Lamp", bare(lamp.root).states, default="Off")
    assert lines(lamp) and moved.place != lamp.place
    assert repr(lower(in_order("lamp", moved)).step) == repr(lower(in_order("lamp", lamp)).step)


def test_what_fires_knows_where_it_is_written() -> None:
    run = Interpreter(in_order("lamp", lamp))
    fired = [*run.step({"go": 0}), *run.step({"go": 1})]
    assert [f.place.line - START for f in fired if f.place] == [1, 4]


def test_paths_are_seen_from_the_project_or_the_repository(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert Place(str(ROOT / "spec_model" / "rover.py"), 3).path == "spec_model/rover.py"
    (tmp_path / ".git").mkdir()
    (tmp_path / "sub").mkdir()
    monkeypatch.chdir(tmp_path / "sub")
    assert str(Place(str(tmp_path / "model" / "heater.py"), 4)) == "model/heater.py:4"
    assert Place("/else/where.py", 1).path == "/else/where.py"


def test_nowhere_in_particular() -> None:
    names: dict[str, object] = {"here": here}
    exec("found = here()", {**names, "__name__": "typed"}, names)
    assert names["found"] is None
