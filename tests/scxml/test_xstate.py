"""Machines of XState: what they mean by both readings, what is refused, and what is checked."""

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

from rovercheck import xstate_model
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.scxml.records import StateMachine
from rovercheck.checker.scxml.system import lowered_machine
from rovercheck.checker.scxml.xstate.bindings import Bindings
from rovercheck.checker.scxml.xstate.interpret import XstateRunner
from rovercheck.checker.scxml.xstate.reader import xstate_machine_of
from rovercheck.spec_model.lang.errors import ModelError
from tests.scxml.random_xstate import lowered_xstate, random_xstate, xstate_differences, xstate_steps

VENDING = Path(__file__).parents[2] / "examples/xstate/vending.json"
NONE = Bindings(Path("toy.bindings.toml"))


def machine(config: dict[str, Any], bindings: Bindings = NONE) -> StateMachine:
    """A machine of some configuration."""
    return xstate_machine_of(json.dumps({"id": "m", **config}).encode(), "toy.json", bindings)


def ran(config: dict[str, Any], *events: str, bindings: Bindings = NONE) -> tuple[set[str], set[str]]:
    """The states that are active after some events, without the machine, and the actions of the last step."""
    runner = XstateRunner(machine(config, bindings))
    for event in ("", *events):
        runner.step(event)
    return {one.id for one in runner.active} - {"m"}, runner.ran


@pytest.mark.parametrize(
    ("version", "seed"), [*((5, seed) for seed in range(12)), *((4, seed) for seed in range(8))]
)
def test_both_readings_of_random_machines_agree(version: int, seed: int) -> None:
    try:
        one = lowered_xstate(*random_xstate(seed, version))
    except ModelError as error:
        assert "were entered" in str(error) or "Give the history a target" in str(error) or "4" in str(error)
        return
    assert xstate_differences(one, xstate_steps(one.machine, Random(seed), 20)) == ""


# --- the rules of XState 5, each as XState 5.33 does it ----------------------------------------------------


def test_a_transition_into_its_source_leaves_it_only_with_reenter() -> None:
    inner = {"initial": "b", "states": {"b": {"entry": "in b"}}, "entry": "in a", "exit": "out a"}
    stays = {
        "initial": "a",
        "states": {"a": {**inner, "on": {"E": "a", "F": {"target": ".b", "reenter": True}}}},
    }
    assert ran(stays, "E")[1] == {"in b"}
    assert ran(stays, "F")[1] == {"out a", "in a", "in b"}


def test_between_regions_all_of_them_are_left() -> None:
    regions = {
        "p": {"initial": "a", "states": {"a": {"on": {"E": "#m.q.d"}}, "b": {}}},
        "q": {"initial": "c", "states": {"c": {}, "d": {}}},
        "r": {"entry": "in r", "exit": "out r"},
    }
    active, actions = ran({"type": "parallel", "states": regions}, "E")
    assert active == {"p", "p.a", "q", "q.d", "r"} and actions == {"out r", "in r"}


def test_a_parallel_state_answers_only_if_no_region_does() -> None:
    regions = {"p": {"on": {"E": {"actions": "inner"}}}, "q": {}}
    config = {
        "type": "parallel",
        "states": regions,
        "on": {"E": {"actions": "outer"}, "F": {"actions": "outer"}},
    }
    assert ran(config, "E")[1] == {"inner"} and ran(config, "F")[1] == {"outer"}


def test_always_is_not_asked_again_where_it_changed_nothing() -> None:
    config = {"initial": "a", "states": {"a": {"always": {"actions": "ping"}, "on": {"E": {}}}}}
    assert ran(config)[1] == {"ping"} and ran(config, "E")[1] == {"ping"} and ran(config, "")[1] == set()


def test_events_match_by_themselves_before_wildcards_and_longer_wildcards_first() -> None:
    on = {
        "*": {"actions": "any"},
        "a.*": {"actions": "short"},
        "a.b.*": {"actions": "long"},
        "a.b": {"actions": "b"},
    }
    config = {"initial": "s", "states": {"s": {"on": on}}}
    told = {event: ran(config, event)[1] for event in ("a.b", "a.b.(other)", "a.(other)", "(other)")}
    assert told == {"a.b": {"b"}, "a.b.(other)": {"long"}, "a.(other)": {"short"}, "(other)": {"any"}}
    assert set(machine(config).offered) == set(told)


def test_names_that_are_numbers_come_first_as_in_javascript() -> None:
    text = '{"id": "m", "type": "parallel", "states": {"b": {}, "2": {}, "1": {}}}'
    assert [one.id for one in xstate_machine_of(text.encode(), "toy.json", NONE).states[1:]] == [
        "1",
        "2",
        "b",
    ]


def test_a_delay_that_is_over_does_not_come_after_its_state_was_left() -> None:
    regions = {
        "p": {"after": {"10": {"target": "#m.off"}}},
        "q": {"after": {"10": {"actions": "late"}}},
    }
    config = {"initial": "on", "states": {"on": {"type": "parallel", "states": regions}, "off": {}}}
    assert ran(config, "") == ({"off"}, set())


def test_a_history_of_a_parallel_state_begins_with_all_of_its_regions() -> None:
    history = {"type": "history", "history": "deep"}
    states = {
        "p": {"type": "parallel", "states": {"q": {}, "r": {}, "h": history}},
        "o": {"on": {"E": "p.h"}},
    }
    config = {"initial": "o", "states": states, "entry": "in m"}
    assert ran(config, "E") == ({"p", "p.q", "p.r"}, set())


def test_actions_and_guards_are_bound_in_a_file() -> None:
    on = {"E": [{"guard": "full", "actions": "ring"}, {"actions": "more"}]}
    config = {"initial": "a", "context": {"n": 0}, "states": {"a": {"on": on}}}
    bound = Bindings(Path("toy.bindings.toml"), None, {"full": "n >= 2"}, {"more": {"n": "n + 1"}})
    assert ran(config, "E", "E", bindings=bound)[1] == set()
    assert ran(config, "E", "E", "E", bindings=bound)[1] == {"ring"}


def test_what_the_export_may_have_lost_is_noted() -> None:
    on = {"E": {}, "F": {"actions": "more"}, "G": {"target": "a"}}
    found = machine({"initial": "a", "context": {"n": 0, "list": []}, "states": {"a": {"on": on}}}).notes
    assert found == (
        "Actions without a binding change no data: more.",
        "No action assigns n, which keeps its first value.",
        "These transitions do nothing; an action that was written as a function is lost in JSON: "
        "a E (line 1).",
        "Of the context these are no numbers or truth values: list.",
    )


# --- what is refused ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("states", "said"),
    [
        ({"a": {"invoke": {"src": "load"}}}, "`invoke`: another actor"),
        ({"a": {"on": {"E": "b"}}}, "the target 'b' of a, which is no state"),
        ({"a": {"entry": [None]}}, "action: was a function"),
        ({"a": {"entry": {"type": "xstate.assign"}}}, "action: 'xstate.assign' was a function"),
        ({"a": {"after": {"soon": "a"}}}, "the delay 'soon', which has no length here"),
        ({"a": {"after": {"0": "a"}}}, "comes after the step. Write `always`"),
        ({"a": {"states": {"b": {}}}}, "the state a has no `initial`"),
        ({"a": {"type": "parallel"}}, "a parallel state without states"),
        ({"a": {"on": {"E": {"targets": "a"}}}}, "`targets` of a transition"),
        ({"a": {"transitions": []}}, "which is no part of a state"),
        ({"a.b": {}}, "the name of a state 'a.b'"),
        ({"a": {"on": {"E": {"guard": "g", "internal": True}}}}, "`internal` is of XState 4, and `guard`"),
    ],
)
def test_what_has_no_meaning_is_told_with_its_line(states: dict[str, Any], said: str) -> None:
    text = json.dumps({"initial": next(iter(states)), "states": states}, indent=1)
    with pytest.raises(ModelError) as raised:
        xstate_machine_of(text.encode(), "toy.json", NONE)
    assert said in str(raised.value) and "toy.json, line " in str(raised.value)


def test_the_order_of_always_in_two_regions_is_refused_where_it_matters() -> None:
    go = {"always": {"guard": "g", "actions": {"type": "more"}}}
    config = {"type": "parallel", "context": {"n": 0}, "states": {"a": go, "b": go}}
    bound = Bindings(Path("toy.bindings.toml"), None, {}, {"more": {"n": "n + 1"}})
    assert machine(config).actions == ("more",)
    with pytest.raises(ModelError, match="`always` of a and b may be taken at once"):
        machine(config, bound)


HOSTILE = [
    b"", b"\0\1\2", b"{", b"[]", b"7", b'{"a": 1}', b'{"states": {}}', b'{"states": 1}', b"\xff\xfe{}",
    b'{"states": {"a": {}, "a": {}}, "initial": "a"}', b'{"states": NaN}', b'{"initial": -Infinity}',
    b'{"states": {"a": {"after": {"1": 1' + b"0" * 5000 + b"}}}}", b'{"initial": "\\ud800"}',
    b'{"states":{"a":' * 10_000, b"[" * 10_000,
    b'{"id": "m", "key": "m", "states": {}, "order": 1, "transitions": []}',
]  # fmt: skip


@pytest.mark.parametrize("number", range(len(HOSTILE)))
def test_hostile_files_are_one_message(
    number: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "hostile.json"
    file.write_bytes(HOSTILE[number])
    assert run(["import", str(file)]) == Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert "hostile.json, line" in said and "Traceback" not in said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[guards", "this is no TOML"), ("x = 1", "'x' means nothing"), ("version = 3", "XState 4 and 5"),
        ("guards = 1", "`guards` is a table"), ("[guards]\ninStock = 1", "the guard 'inStock' is no text"),
        ("[actions]\nnoCoins = 1", "the action 'noCoins' says nothing"),
        ("[actions]\nnoCoins = { cents = '0' }", "'cents', which is no datum of the context"),
        ("[guards]\nstock = 'true'", "the machine has no guard 'stock'"),
        ("[delays]\nTOO_LONG = 0", "above 0"),
    ],
)  # fmt: skip
def test_bindings_without_a_meaning_are_told(text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "vending.json").write_bytes(VENDING.read_bytes())
    if "TOO_LONG" not in text and not text.startswith("[guards\n"):
        text = f"{text}\n[delays]\nTOO_LONG = 10000" if "[" in text and said != "this is no TOML" else text
    (tmp_path / "vending.bindings.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as raised:
        xstate_model(tmp_path / "vending.json")
    assert said in str(raised.value)


def test_whatever_is_damaged_there_is_a_machine_or_a_message() -> None:
    refused, random, text = 0, Random(0), VENDING.read_bytes()
    for _ in range(200):
        damaged = bytearray(text)
        for _ in range(random.choice((1, 1, 3))):
            damaged[random.randrange(len(text))] = random.choice(b"{}[],:\"' ax0\0\xff")
        try:
            xstate_machine_of(bytes(damaged), "vending.json", NONE)
        except ModelError as error:
            refused += 1
            assert "vending.json" in str(error) or "toy.bindings.toml" in str(error)
    assert refused > 20


# --- checking ----------------------------------------------------------------------------------------------


def test_import_says_what_stands_in_a_machine(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["import", str(VENDING)]) == Exit.AS_EXPECTED
    said = " ".join(capsys.readouterr().out.split())
    assert "vending: XState 5, 11 states, 11 transitions, 1 datum." in said
    assert "Guards without a binding, which are inputs: inStock." in said and "It can be checked" in said


def test_properties_speak_of_guards_actions_and_states_by_path_or_id() -> None:
    vending = xstate_model(VENDING)
    assert (
        str(vending.guard("inStock")) == "guard.inStock" and str(vending.ran("motorOn")) == "action.motorOn"
    )
    assert str(vending.active("serving.motor.done")) == str(vending.active("vending.serving.motor.done"))
    with pytest.raises(ModelError, match="no action without a binding 'addCoin'"):
        vending.ran("addCoin")


def test_a_machine_of_many_states_with_delays_is_no_step_too_long() -> None:
    def region(number: int) -> dict[str, Any]:
        states = {
            f"s{one}": {
                "on": {f"E{(one + number) % 12}": f"s{(one * 7 + 1) % 20}", "BACK": "s0"},
                **({"after": {"100": f"s{(one * 3) % 20}"}} if one % 5 == 0 else {}),
            }
            for one in range(20)
        }
        return {"initial": "s0", "states": states}

    config = {"type": "parallel", "states": {f"r{number}": region(number) for number in range(3)}}
    found = lowered_machine(machine(config), "toy.json", {})  # was refused: a choice for each delay
    assert len(found.machine.states) == 64
