"""Keys of questions: written alike, one key; anything that may change a verdict, another one."""

import inspect
from dataclasses import dataclass, fields, replace
from enum import Enum
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.mutate.mutants import mutants
from rovercheck.checker.store.content import ContentKeys, NoKey
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import Always, Property, always, leads_to, recoverable
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled, Junction, State, to
from rovercheck.spec_model.lang.domain import Bool, fixed
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import Assumption, Note, System, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.rover import systems
from tests.profiles import examples
from tests.store.records import COUNT, GO, LEFT_OUT, NO_PART, PUSH, lamp, records, samples
from tests.strategies import systems as random_systems


def key(*values: object) -> str:
    return ContentKeys().key(*values)


# --- what is written alike ---------------------------------------------------------------------------


def test_words_for_readers_and_places_do_not_enter() -> None:
    plain, told = lamp(), lamp("Lights.", "Pushed.", "Nothing is left out.")
    assert key(plain) == key(told) == key(lamp(note="brief"))
    noted = replace(plain, notes=(Note("All of it.", brief="all"),))
    assert key(noted) == key(plain)
    one, two = (always("P", text, that=GO, covers=["R"], on="lamp") for text in ("Goes.", "It goes."))
    assert key(one) == key(two)
    assert (
        key(Assumption("A", "one", GO)) == key(Assumption("A", "two", GO)) != key(Assumption("B", "one", GO))
    )


def test_a_chart_moved_within_its_file_is_the_same() -> None:
    here, there = lamp(), lamp()
    for system in (here, there):
        assert all(isinstance(s.place, Place) for s in system.charts[0].states.values())
    moved = replace(there, place=Place("elsewhere.py", 7))
    assert key(here) == key(there) == key(moved)


@examples(40)
@given(random_systems())
def test_a_system_has_one_key_however_often_it_is_asked_for(system: System) -> None:
    keys = ContentKeys()
    first = keys.key(system)
    assert first == keys.key(system) == key(system), "what is remembered changes nothing"
    assert (
        len({first, keys.key(replace(system, name="Other")), keys.key((system,)), keys.key(system, 1)}) == 4
    )


# --- what is written otherwise -----------------------------------------------------------------------


@pytest.mark.parametrize("name", ["relay", "temperature"])
def test_no_mutant_has_the_key_of_the_original(name: str) -> None:
    known = systems()
    original = known[name]
    keys = ContentKeys()
    own, made = keys.key(original), mutants(original)
    assert made
    alike = [m.id for m in made if keys.key(m.system) == own]
    assert not alike


@examples(40)
@given(random_systems(), st.data())
def test_no_mutant_of_a_random_system_has_its_key(system: System, data: st.DataObject) -> None:
    made = mutants(system)
    for mutant in made[:: max(1, len(made) // 10)]:
        assert key(mutant.system) != key(system), mutant.id


def test_every_field_of_every_record_enters_or_it_is_said_why_not() -> None:
    left, shown = dict(LEFT_OUT), samples()
    for name, kind in records().items():
        if name in NO_PART or kind in (Bool, State, Junction):
            continue
        original, changes = shown[name]
        for one in fields(kind):
            if left.pop(f"{name}.{one.name}", None) is not None:
                assert one.name not in changes
                continue
            other = _with(original, one.name, changes[one.name])
            assert key(other) != key(original), f"{name}.{one.name} does not enter"
    for name in [n for n in left if n.startswith("State.")]:
        left.pop(name)
    assert not left, "these fields are gone"


def _with(record: Any, name: str, value: object) -> Any:
    values = {f.name: getattr(record, f.name) for f in fields(record)}
    return type(record)(**{**values, name: value})


def test_every_field_of_a_state_enters_but_its_place() -> None:
    act, inner = assign(GO, PUSH), State("In")
    plain = State("A", states=[inner], default="In")
    others = [
        State("B", states=[inner], default="In"),
        State("A", states=[State("On")], default="In"),
        State("A", states=[inner], default="In", entry=[act]),
        State("A", states=[inner], default="In", during=[act]),
        State("A", states=[inner], default="In", exit=[act]),
        State("A", states=[inner], default="In", transitions=[to("A")]),
        State("A", states=[inner], default="In", junctions=[Junction("J", [to("In")])]),
        State("A", states=[inner], default="In", junctions=[Junction("K", [to("In")])]),
        State("A", states=[inner], default="In", junctions=[Junction("J", [to("A")])]),
        State("A", states=[inner], default=to("In", when=GO)),
        State("A", states=[inner], parallel=True),
        State("A", states=[inner]),
    ]
    assert {f.name for f in fields(State)} == {
        "name", "entry", "during", "exit", "states", "transitions", "junctions", "default", "parallel",
        "label", "place",
    }  # fmt: skip
    assert len({key(plain), *map(key, others)}) == 1 + len(others)
    assert key(plain) == key(State("A", states=[State("In")], default="In", place=Place("x.py", 3)))


def test_of_components_that_are_no_records_all_enters_but_words() -> None:
    """What their constructors take: a new parameter has to be looked at here."""
    assert [*inspect.signature(Chart).parameters] == [
        "name", "states", "default", "junctions", "parallel", "text", "local_to", "data", "place",
    ]  # fmt: skip
    assert [*inspect.signature(Block).parameters] == ["name", "do", "text", "temporaries", "place"]
    assert [*inspect.signature(Enabled).parameters] == ["by", "components", "name", "place"]
    s, t = State("S"), State("T")
    charts = [
        Chart("C", [s], default="S"),
        Chart("D", [s], default="S"),
        Chart("C", [t], default="T"),
        Chart("C", [s, t], default="S"),
        Chart("C", [t, s], default="S"),
        Chart("C", [s, t], default="T"),
        Chart("C", [s, t], parallel=True),
        Chart("C", [s], default="J", junctions=[Junction("J", [to("S")])]),
        Chart("C", [s], default="S", local_to=[(COUNT, ["S"])]),
        Chart("C", [s], default="S", local_to=[(GO, ["S"])]),
    ]
    act = assign(GO, PUSH)
    blocks = [Block("B", [act]), Block("C", [act]), Block("B", [act, act]), Block("B", [assign(PUSH, GO)])]
    enabled = [
        Enabled(GO, blocks[0]), Enabled(PUSH, blocks[0]), Enabled(GO, blocks[0], name="b"),
        Enabled(GO, blocks[1]), Enabled(GO, blocks[0], blocks[1]), Enabled(GO, blocks[1], blocks[0]),
        Enabled(GO, Enabled(GO, blocks[0])),
    ]  # fmt: skip
    made = [*charts, *blocks, *enabled]
    assert len({key(one) for one in made}) == len(made)


def test_the_order_of_transitions_and_components_enters() -> None:
    one, two = to("A", when=GO), to("B", when=GO)
    a, b = (State("S", transitions=ts) for ts in ([one, two], [two, one]))
    assert key(a) != key(b)
    first, second = Block("X", [assign(GO, PUSH)]), Block("Y", [assign(PUSH, GO)])
    assert key(in_order("s", first, second)) != key(in_order("s", second, first))


def test_every_property_of_the_rover_has_its_own_key() -> None:
    keys = ContentKeys()
    found = {keys.key(prop): id for id, prop in catalogue().items()}
    assert len(found) == len(catalogue())


# --- values that look alike --------------------------------------------------------------------------


LOOK_ALIKE = [
    (True, 1, "1", 1.0, Fraction(1), b"1"),
    (None, "None", 0, False, "", b"", ()),
    (0.0, -0.0),
    (0.5, Fraction(1, 2), "1/2"),
    (("ab", "c"), ("a", "bc"), ("abc",), "abc"),
    (((), ()), (((),),), ()),
    ((1, (2, 3)), ((1, 2), 3), (1, 2, 3)),
    (range(3), (0, 1, 2), range(0, 4), range(0, 3, 2)),
    ({1: 2}, {2: 1}, {1, 2}, (1, 2)),
    (frozenset({1}), (1,), {1: 1}),
    ({"a": ("b",)}, {"a": "b"}, {("a",): "b"}),
    ("\udcff", "\\udcff", "ÿ"),
]


@pytest.mark.parametrize("alike", LOOK_ALIKE, ids=[repr(row[0]) for row in LOOK_ALIKE])
def test_what_only_looks_alike_has_other_keys(alike: tuple[object, ...]) -> None:
    assert len({key(one) for one in alike}) == len(alike)
    assert len({key((one,)) for one in alike}) == len(alike)


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=5)
    | st.fractions() | st.binary(max_size=4),
    lambda inner: st.lists(inner, max_size=4).map(tuple)
    | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=12,
)  # fmt: skip


def shape(value: object) -> object:
    """A value in which what is equal is of one type throughout."""
    if isinstance(value, tuple):
        return "tuple", tuple(map(shape, value))
    if isinstance(value, dict):
        return "dict", frozenset((k, shape(v)) for k, v in value.items())
    return type(value).__name__, repr(value)


@examples(400)
@given(VALUES, VALUES)
def test_keys_are_equal_where_values_and_types_are(one: object, two: object) -> None:
    assert (key(one) == key(two)) == (shape(one) == shape(two))
    assert key(one, two) != key((one, two))
    assert key(one) == key(one), "whatever the order of a set or a mapping is in this process"


@examples(100)
@given(st.lists(st.text(max_size=4), unique=True, min_size=2), st.randoms())
def test_the_order_of_sets_and_mappings_does_not_enter(members: list[str], random: Any) -> None:
    other = list(members)
    random.shuffle(other)
    assert key(frozenset(members)) == key(frozenset(other)) == key(set(other))
    assert key(dict.fromkeys(members, 1)) == key(dict.fromkeys(other, 1))


# --- what has no key ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Stricter(Always):
    """A form of a user's: what it means is said by code, not by its fields."""

    def monitor(self, past: Any) -> Any:
        armed, _ = super().monitor(past)
        return armed, armed


class Odd(int):
    """A number that is another kind of number."""


class Shade(Enum):
    """A choice of a user's."""

    DARK = 1


@pytest.mark.parametrize(
    "value",
    [object(), lambda: 1, Odd(3), key, int, Stricter(GO), iter(()), complex(1, 2), bytearray(b"1")],
    ids=lambda value: type(value).__name__,
)
def test_what_cannot_be_told_whole_has_no_key(value: object) -> None:
    for within in (value, (value,), {"a": value}):
        with pytest.raises(NoKey):
            key(within)


def test_a_property_of_a_form_of_a_users_own_has_no_key() -> None:
    """Its monitor is code that no key tells of."""
    with pytest.raises(NoKey):
        key(Property("P", "", Stricter(GO), ("R",), "lamp"))


def test_members_of_enumerations_differ_by_their_names() -> None:
    assert key(Op.AND) != key(Op.OR) and key(Op.AND) != key(str(Op.AND))
    assert key(Shade.DARK) != key("DARK")


def test_what_is_too_deep_is_no_key_and_no_crash() -> None:
    from rovercheck.checker.store.verdicts import VerdictStore

    deep: tuple[object, ...] = ()
    for _ in range(200_000):
        deep = (deep,)
    assert VerdictStore("auto").about("test", deep) is None


def test_numbers_of_any_size_have_keys() -> None:
    assert key(10**5000) != key(10**5000 + 1)


def test_fixed_point_values_enter_exactly() -> None:
    assert key(fixed(0, 2, 0.5)) != key(fixed(0, 2, 0.25)) and key(fixed(0, 2, 0.5)) == key(fixed(0, 2, 0.5))


def test_unbounded_forms_enter_with_what_they_rest_on() -> None:
    def leads(**more: Any) -> Property:
        return leads_to("L", "", trigger=GO, response=PUSH, covers=["R"], on="lamp", **more)

    ways = [leads(), leads(bound=2 * ticks), leads(fair=[GO]), leads(fair=[GO, PUSH]), leads(from_tick=2)]
    more = [recoverable("L", "", to=GO, covers=["R"], on="lamp"),
            recoverable("L", "", to=GO, covers=["R"], on="lamp", by=PUSH, within=2 * ticks)]  # fmt: skip
    assert len({key(one) for one in (*ways, *more)}) == len(ways) + len(more)
