"""Domains, units, times and labels: what is written comes back, and slips are named."""

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.lang.domain import (
    Domain,
    Num,
    Unit,
    boolean,
    chosen,
    common_resolution,
    enumeration,
    fixed,
    integer,
    show,
)
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.expr import const
from rovercheck.spec_model.lang.time import ms, sec, tick, ticks

STATUS = enumeration("Status", {"OK": 0, "DEGRADED": 1, "CRITICAL": 4})


@pytest.mark.parametrize(("domain", "written", "raw"), [
    (boolean, True, 1),
    (boolean, False, 0),
    (STATUS, "CRITICAL", 4),
    (integer(-40, 90, "°C"), -15, -15),
    (fixed(0, 100, 0.01, "%"), 0.42, 42),
    (fixed(-1, 1, "1/3"), Fraction(2, 3), 2),
    (chosen([0, 0.25, 10]), 0.25, 1),
])  # fmt: skip
def test_raw_values_and_back(domain, written, raw: int) -> None:
    assert domain.raw(written) == raw
    assert domain.raw(domain.show(raw)) == raw
    assert raw in domain


@pytest.mark.parametrize(("make", "message"), [
    (lambda: STATUS.raw("CRITCAL"), "'CRITCAL' is no member of Status. Did you mean 'CRITICAL'?"),
    (lambda: integer(0, 9).raw(10), "10 is outside integer in 0..9."),
    (lambda: fixed(0, 1, 0.1).raw(0.15), "0.15 is outside number in steps of 0.1 in 0..1."),
    (lambda: fixed(0, 1, 0), "A resolution of 0 has no meaning; write a positive one."),
    (lambda: fixed(0, 1, 0.3), "0..1 does not start and end on multiples of 0.3."),
    (lambda: integer(3, 2), "3..2 is empty; write the lower end first."),
    (lambda: integer(0, 1 << 62), "0..4611686018427387904 has 4,611,686,018,427,387,905 values, "
     "which no board holds in 64 bits; write fewer."),
    (lambda: chosen([]), "A domain needs at least one value."),
    (lambda: enumeration("E", {"A": 1, "B": 1}),
     "The enumeration E needs at least one member, each with its own number."),
    (lambda: (30 * ms).ticks(20),
     "30 ms is not a whole number of ticks of 20 ms; write a multiple of the tick."),
    (lambda: (-1 * sec).ticks(20),
     "-1 s is not a whole number of ticks of 20 ms; write a multiple of the tick."),
])  # fmt: skip
def test_slips_are_named(make, message: str) -> None:
    with pytest.raises(ModelError) as error:
        make()
    assert str(error.value) == message


def test_a_number_is_the_decimal_that_was_written() -> None:
    assert fixed(0, 1, 0.1).raw(0.3) == 3
    assert show(Fraction(42, 100)) == "0.42"
    assert show(Fraction(1, 3)) == "1/3"


def test_density() -> None:
    assert integer(2, 5).dense and STATUS.raw("DEGRADED") == 1
    assert not STATUS.dense and not chosen([0, 20, 60]).dense
    assert list(chosen([60, 20, 0, 20]).values) == [0, 20, 60]


@pytest.mark.parametrize(("written", "shown"), [
    ("°C", "°C"), ("°C/ms", "°C/ms"), ("ms·°C/ms", "°C"), ("1/ms", "1/ms"), ("", ""), ("m/s/s", "m/s/s"),
])  # fmt: skip
def test_units(written: str, shown: str) -> None:
    assert str(Unit.of(written)) == shown


def test_units_multiply() -> None:
    assert Unit.of("°C/ms") * Unit.of("ms") == Unit.of("°C")


@pytest.mark.parametrize(
    "wrong", [7, None, fixed(0, 5, 1, "ms"), Num()], ids=["number", "none", "domain", "sort"]
)
def test_what_is_no_unit_is_told(wrong: Any) -> None:
    """It ended in an AttributeError."""
    with pytest.raises(ModelError, match=r"is no unit; write one as a text, such as 'ms'"):
        const(5, wrong)


def test_the_unit_of_something_else_is_a_unit() -> None:
    assert const(5, Unit.of("ms")).sort == const(5, "ms").sort


@given(st.fractions(min_value="1/100", max_value=10), st.fractions(min_value="1/100", max_value=10))
def test_the_common_resolution_is_the_coarsest_that_divides_both(a: Fraction, b: Fraction) -> None:
    step = common_resolution(a, b)
    assert (a / step).denominator == (b / step).denominator == 1
    assert (a / (2 * step)).denominator != 1 or (b / (2 * step)).denominator != 1


@pytest.mark.parametrize(("span", "count", "shown"), [
    (3 * sec, 150, "3 s"), (500 * ms, 25, "500 ms"), (0.5 * sec, 25, "500 ms"), (7 * ticks, 7, "7 ticks"),
    (1 * tick, 1, "1 tick"),
])  # fmt: skip
def test_times(span, count: int, shown: str) -> None:
    assert (span.ticks(20), str(span)) == (count, shown)


def test_near_names_are_offered_and_only_those() -> None:
    names = ["Battery_ok", "Battery_degraded", "Battery_critical"]
    assert did_you_mean("Batery_degraded", names) == "Did you mean 'Battery_degraded'?"
    assert did_you_mean("Region3", ["Region1", "Region2"]) == "Did you mean 'Region2' or 'Region1'?"
    assert did_you_mean("xyz", names) == "Known: Battery_critical, Battery_degraded, Battery_ok."
    assert did_you_mean("xyz", []) == "There is none to choose from."


@pytest.mark.parametrize("values", [(3, 1, 2), (1, 2, 3, 3), range(3, 0, -1)])
def test_a_domain_made_by_hand_is_in_order(values: range | tuple[int, ...]) -> None:
    """Its lowest and highest values were the first and the last that were written."""
    made = Domain(Num(), values)
    assert (made.low, made.high, len(made), made.dense) == (1, 3, 3, True)
    assert made == Domain(Num(), (1, 2, 3))


def test_a_domain_of_nothing_is_refused() -> None:
    with pytest.raises(ModelError, match="needs at least one value"):
        Domain(Num(), ())
