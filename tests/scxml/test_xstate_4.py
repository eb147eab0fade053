"""Machines of XState 4: their rules, each as XState 4.38 does it, and what of it is refused."""

import json
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.scxml.records import StateMachine
from rovercheck.checker.scxml.xstate.bindings import Bindings
from rovercheck.checker.scxml.xstate.reader import xstate_machine_of
from rovercheck.checker.scxml.xstate.runner import runner_of
from rovercheck.spec_model.lang.errors import ModelError

FOUR = Bindings(Path("toy.bindings.toml"), 4)


def machine(config: dict[str, Any], bindings: Bindings = FOUR) -> StateMachine:
    """A machine of some configuration."""
    return xstate_machine_of(json.dumps({"id": "m", **config}).encode(), "toy.json", bindings)


def ran(config: dict[str, Any], *events: str) -> tuple[set[str], set[str]]:
    """The states that are active after some events, without the machine, and the actions of the last step."""
    runner = runner_of(machine(config))
    for event in ("", *events):
        runner.step(event)
    return {one.id for one in runner.active} - {"m"}, runner.ran


def noisy(name: str, **more: Any) -> dict[str, Any]:
    """A state that says when it is entered and left."""
    return {"entry": f"in {name}", "exit": f"out {name}", **more}


INNER: dict[str, Any] = {"initial": "b", "states": {"b": noisy("b"), "c": noisy("c")}}


def test_a_transition_leaves_its_source_unless_its_target_begins_with_a_dot() -> None:
    on = {"E": "a", "F": "#m.a.b", "G": ".c", "H": {"target": ".c", "internal": False}}
    config = {"initial": "a", "states": {"a": noisy("a", on=on, **INNER)}}
    assert ran(config, "E")[1] == {"out b", "out a", "in a", "in b"}
    assert ran(config, "F")[1] == {"out b", "out a", "in a", "in b"}
    assert ran(config, "G")[1] == {"out b", "in c"}
    assert ran(config, "H")[1] == {"out b", "out a", "in a", "in c"}


def test_an_internal_transition_to_what_is_active_changes_nothing() -> None:
    config = {"initial": "a", "states": {"a": noisy("a", on={"E": ".b"}, **INNER)}}
    assert ran(config, "E") == ({"a", "a.b"}, set())


def test_a_wildcard_comes_before_delays() -> None:
    state = {"on": {"*": {"actions": "star"}}, "after": {"10": {"actions": "late"}}}
    assert ran({"initial": "a", "states": {"a": state}}, "")[1] == {"star"}


SENT = (("send", "F"), ("raise", "G"))


def test_raise_and_send_stand_in_the_file() -> None:
    actions = [{"type": f"xstate.{kind}", "event": {"type": one}} for kind, one in SENT]
    on = {"E": {"actions": actions}, "F": "c", "G": "b"}
    config = {"initial": "a", "states": {"a": {"on": on}, "b": {"on": {"F": "c"}}, "c": {}}}
    assert ran(config, "E")[0] == {"c"} and machine(config).offered == ("E",)


def test_what_is_logged_changes_nothing() -> None:
    log = {"type": "xstate.log", "label": "entered"}
    assert machine({"initial": "a", "states": {"a": {"entry": [log, "beep"]}}}).actions == ("beep",)


def test_an_event_that_is_raised_while_another_waits_is_told() -> None:
    both = [{"type": "xstate.raise", "event": one} for one in ("F", "G")]
    again = {"actions": {"type": "xstate.raise", "event": "G"}}
    config = {"initial": "a", "states": {"a": {"on": {"E": {"actions": both}, "F": again, "G": "a"}}}}
    with pytest.raises(DrawnFault, match="raised while another one waits"):
        ran(config, "E")


REGION: dict[str, Any] = {"initial": "b", "states": {"b": {"on": {"E": "c"}}, "c": {}}}


@pytest.mark.parametrize(
    ("states", "said"),
    [
        ({"a": {"initial": "b", "states": {"b": {}, "h": {"type": "history"}}}}, "a history of XState 4"),
        ({"a": {"type": "parallel", "states": {"b": {"type": "final"}}}}, "a final state as a region"),
        ({"a": {"on": {"E": ["a"]}, "always": {"target": ["a", "b"]}}, "b": {}}, "exclude each other"),
        ({"a": {"type": "parallel", "states": {"p": REGION, "q": {"on": {"F": "p"}}}}}, "between regions"),
        (
            {"a": {"type": "parallel", "states": {"p": REGION, "q": {"on": {"E": "#m.o"}}}}, "o": {}},
            "leaves a for an event that another region of it answers too",
        ),
        ({"a": {"entry": {"type": "xstate.send", "event": "E", "delay": 9}}}, "`send` with a delay"),
        ({"a": {"initial": {"target": "b"}, "states": {"b": {}}}}, "an `initial` of a with actions"),
    ],
)  # fmt: skip
def test_what_is_refused_is_told(states: dict[str, Any], said: str) -> None:
    with pytest.raises(ModelError) as raised:
        machine({"initial": "a", "states": states})
    assert said in str(raised.value)


def test_the_version_follows_from_the_words_of_transitions() -> None:
    plain = Bindings(Path("toy.bindings.toml"))
    states = {"a": {"on": {"E": {"target": "a", "cond": "g"}}}}
    assert machine({"initial": "a", "states": states}, plain).format == "XState 4"
    assert machine({"initial": "a", "states": {"a": {"on": {"E": "a"}}}}, plain).format == "XState 5"
    with pytest.raises(ModelError, match="version = 5, but the machine is of 4"):
        machine({"initial": "a", "states": states}, Bindings(Path("toy.bindings.toml"), 5))
