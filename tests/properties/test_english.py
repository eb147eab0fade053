"""Structured English: a golden sentence for each form and word, and no change of a formula goes unsaid."""

from typing import get_args

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.properties import forms
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.english import definitions, sentence
from rovercheck.properties.forms import Property
from rovercheck.properties.phrases import Voice, clause, term
from rovercheck.spec_model.lang.domain import enumeration, fixed, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Named, any_of, const, flag, implies, ite, var
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import ms, sec, ticks
from rovercheck.spec_model.lang.walk import nodes, structure
from rovercheck.spec_model.lang.words import (
    absolute,
    after,
    bit,
    duration,
    held,
    maximum,
    minimum,
    modulo,
    named,
    once,
    previous,
    quotient,
    rising,
)  # fmt: skip

a, b, c = flag("a"), flag("b"), flag("c")
age = var("age", fixed(0, 200, 20, "ms"))
n, m = var("n", integer(-9, 9)), var("m", integer(0, 15))
yaw = var("yaw", integer(0, 359, "°"))
rx = var("rx", enumeration("Rx", ["RX_OK", "RX_CRITICAL"]))
place = var("Relay", enumeration("states of Relay", ["-", "B1_actuating"]))
silent = named("silent", age > 120)


def prop(form: forms.Form, from_tick: int = 1) -> Property:
    return Property("P", "It is so.", form, ("R1",), "toy", from_tick)


# --- forms ---------------------------------------------------------------------------------------

FORMS = [
    (forms.Always(a), "In every step a is true."),
    (forms.Always(a & b), "In every step: a is true and b is true."),
    (forms.Always(implies(a, b)), "In every step in which a is true, b is true."),
    (forms.Always(implies(a, b & c)), "In every step in which a is true, b is true and c is true."),
    (forms.Always(implies(a, b | c)), "In every step in which a is true, b is true or c is true."),
    (forms.Never(a & b), "There is no step in which a is true and b is true."),
    (forms.Responds(a, b, 0 * ticks), "Whenever a is true, then in that step b is true."),
    (forms.Responds(a, b, 1 * ticks), "Whenever a is true, then in that step or the next (20 ms) b is true."),
    (
        forms.Responds(a, b | c, 60 * ms),
        "Whenever a is true, then in that step or one of the next 3 (60 ms): b is true or c is true.",
    ),
    (forms.HoldsAfter(a, 0 * ticks, b), "Whenever a is true, then in that step b is true."),
    (
        forms.HoldsAfter(a & b, 40 * ms, c),
        "Whenever in each of 3 successive steps (40 ms, ends included) (a is true and b is true), "
        "then in the last of them c is true.",
    ),
    (forms.HoldsFor(a, b, 0 * ticks), "Whenever a becomes true, then in that step b is true."),
    (
        forms.HoldsFor(a, b, 1 * sec),
        "Whenever a becomes true, then in that step and each of the next 50 (1000 ms) b is true.",
    ),
    (forms.LeavesOnlyIf(a, b), "Whenever a becomes false, then in that step b is true."),
    (forms.LeavesOnlyIf(place == "B1_actuating", a),
     "Whenever Relay leaves B1_actuating, then in that step a is true."),
    (forms.LeavesOnlyIf(n == 3, a), "Whenever n ceases to be 3, then in that step a is true."),
    (forms.LeavesOnlyIf(silent, a), "Whenever “silent” ceases to hold, then in that step a is true."),
    (forms.LeavesOnlyIf(~a, b),
     "Whenever it ceases to be true that a is false, then in that step b is true."),
    (forms.EntersOnlyIf(a, b), "Whenever a becomes true, then in that step b is true."),
    (forms.EntersOnlyIf(place == "B1_actuating", a),
     "Whenever Relay enters B1_actuating, then in that step a is true."),
    (forms.EntersOnlyIf(n == 3, a), "Whenever n becomes 3, then in that step a is true."),
    (forms.EntersOnlyIf(silent, a), "Whenever “silent” begins to hold, then in that step a is true."),
    (forms.EntersOnlyIf(a & b, c),
     "Whenever it becomes true that (a is true and b is true), then in that step c is true."),
    (forms.Precedes(a, b), "Whenever b is true, then in that step or some step before a is true."),
    (
        forms.Until(a, b, c),
        "Whenever a is true, then in every step from that one on, up to but not including the first in which "
        "c is true: b is true.",
    ),
    (forms.Reachable(a), "Some run has a step in which a is true."),
    (forms.LeadsTo(a, b),
     "Whenever a is true, then in that step or some later one, without a limit, b is true."),
    (
        forms.LeadsTo(a, b, fair=(c, n > 0)),
        "In every run in which again and again c is true and again and again n is above 0: "
        "whenever a is true, then in that step or some later one, without a limit, b is true.",
    ),
    (
        forms.Settles(a, b),
        "If from some step on in every step a is true, then from some step on in every step b is true.",
    ),
    (forms.Recoverable(a), "From wherever a run is, some continuation has a step in which a is true."),
]  # fmt: skip


@pytest.mark.parametrize(("form", "said"), FORMS, ids=[said for _, said in FORMS])
def test_a_form_in_words(form: forms.Form, said: str) -> None:
    assert sentence(prop(form), 20) == said


def test_every_form_has_a_golden_sentence() -> None:
    assert {type(form) for form, _ in FORMS} == set(get_args(forms.Form))


def test_the_first_step_that_counts_is_said() -> None:
    assert sentence(prop(forms.Never(a), 2), 20) == "From step 2 on, there is no step in which a is true."


def test_a_step_may_have_another_length() -> None:
    said = "Whenever a is true, then in that step or one of the next 6 (60 ms) b is true."
    assert sentence(prop(forms.Responds(a, b, 60 * ms)), 10) == said


# --- formulas ------------------------------------------------------------------------------------

CLAUSES = [
    (TRUE, "true"),
    (a, "a is true"),
    (~a, "a is false"),
    (~~a, "a is true"),
    (silent, "“silent” holds"),
    (~silent, "“silent” does not hold"),
    (a & b & c, "a is true and b is true and c is true"),
    (a & (b | c), "a is true and (b is true or c is true)"),
    (a & b | c, "(a is true and b is true) or c is true"),
    (~(a & b), "not (a is true and b is true)"),
    (c & ~(a | b), "c is true and not (a is true or b is true)"),
    (implies(a, b), "if a is true then b is true"),
    (implies(a & b, c) & c, "(if (a is true and b is true) then c is true) and c is true"),
    (any_of(a, FALSE), "a is true"),
    (any_of(a & b, FALSE) & c, "(a is true and b is true) and c is true"),
    (a == b, "a is true exactly when b is true"),
    (a != b, "a is true exactly when b is false"),
    (~(a == b), "a is true exactly when b is false"),
    (a == (b & c), "a is true exactly when (b is true and c is true)"),
    (ite(a, b, c), "if a is true then (b is true), otherwise (c is true)"),
    (rx == "RX_CRITICAL", "rx is RX_CRITICAL"),
    (rx != "RX_CRITICAL", "rx is not RX_CRITICAL"),
    (~(rx == "RX_CRITICAL"), "rx is not RX_CRITICAL"),
    (place == "B1_actuating", "Relay is in B1_actuating"),
    (age < 120, "age is below 120 ms"),
    (age <= 120, "age is at most 120 ms"),
    (age > 120, "age is above 120 ms"),
    (age >= 120, "age is at least 120 ms"),
    (~(age >= 120), "age is not at least 120 ms"),
    (yaw == 45, "yaw is 45°"),
    (bit(m, 3), "bit 3 of m is 1"),
    (~bit(m, 3), "bit 3 of m is 0"),
    (previous(a), "a was true in the step before"),
    (~previous(silent), "“silent” did not hold in the step before"),
    (previous(a & b), "(a was true and b was true) in the step before"),
    (previous(~(a & b)), "not (a was true and b was true) in the step before"),
    (previous(previous(a)), "a was true 2 steps before"),
    (previous(a & previous(b)), "(a was true and b was true in the step before that) in the step before"),
    (previous(n) == 3, "n of the step before is 3"),
    (n == previous(n), "n is the same as in the step before"),
    (a != previous(a), "a is not the same as in the step before"),
    (previous(rx == "RX_OK"), "rx was RX_OK in the step before"),
    (held(a, 40 * ms), "in each of the last 3 steps (40 ms, ends included) a is true"),
    (held(a, 0 * ticks), "in this step a is true"),
    (~held(a, 40 * ms), "in some of the last 3 steps (40 ms, ends included) a is false"),
    (c & held(a | b, 1 * ticks),
     "c is true and (in each of the last 2 steps (20 ms, ends included) (a is true or b is true))"),
    (once(a), "in this step or some step before a is true"),
    (~once(a), "in this step and every step before a is false"),
    (rising(a), "a becomes true, not in the first step"),
    (~rising(a), "not (a becomes true, not in the first step)"),
    (duration(a) > 3 * sec, "for more than 3 s a is true"),
    (duration(a) >= 3 * sec, "for at least 3 s a is true"),
    (after(3 * sec), "3 s have passed since the state was entered"),
]  # fmt: skip

TERMS = [
    (n + m - 1, "n + m - 1"),
    (n - (m + 1), "n - (m + 1)"),
    (n * m + 1, "(n × m) + 1"),
    ((n + m) * m, "(n + m) × m"),
    (-n, "-n"),
    (absolute(n), "|n|"),
    (minimum(n, m), "the smaller of n and m"),
    (maximum(n, m + 1), "the larger of n and (m + 1)"),
    (modulo(yaw + 180, 360), "(yaw + 180°) mod 360°"),
    (quotient(m, 2), "m div 2"),
    (ite(a, n, m), "(n if a is true, otherwise m)"),
    (age + const("0.5", "ms"), "age + 0.5 ms"),
    (named("half", m * 2), "“half”"),
    (
        ite(a, const(1), const(0)) + ite(~b, const(1), const(0)),
        "the number of true ones among (a is true; b is false)",
    ),
    (n + ite(b, const(1), const(0)), "n + (1 if b is true, otherwise 0)"),
    (
        ite(a, const(1), const(0)) + ite(b, const(2), const(0)),
        "(1 if a is true, otherwise 0) + (2 if b is true, otherwise 0)",
    ),
]


@pytest.mark.parametrize(("formula", "said"), CLAUSES, ids=[said for _, said in CLAUSES])
def test_a_condition_in_words(formula: Expr, said: str) -> None:
    assert clause(formula, Voice(20)) == said


@pytest.mark.parametrize(("formula", "said"), TERMS, ids=[said for _, said in TERMS])
def test_a_number_in_words(formula: Expr, said: str) -> None:
    assert term(formula, Voice(20)) == said


def test_every_operator_and_temporal_word_has_a_golden_phrase() -> None:
    seen = {getattr(e, "op", None) or getattr(e, "when", None) for f, _ in CLAUSES + TERMS for e in nodes(f)}
    assert seen >= set(Op)
    assert {word for word in seen if word} - set(Op) == {
        "after",
        "duration",
        "held",
        "once",
        "previous",
        "rising",
    }


# --- names ---------------------------------------------------------------------------------------


def test_a_named_formula_is_spelled_out_once_below_and_so_are_those_in_it() -> None:
    assumed = named("assumed", n * 2)
    stale = named("stale", silent & (assumed > 6))
    told = prop(forms.Always(implies(stale, a & ~silent)))
    assert sentence(told, 20) == "In every step in which “stale” holds, a is true and “silent” does not hold."
    assert definitions(told, 20) == (
        "“stale” means: “silent” holds and “assumed” is above 6.",
        "“silent” means: age is above 120 ms.",
        "“assumed” is n × 2.",
    )


def test_a_name_that_is_not_quoted_is_not_spelled_out() -> None:
    assert definitions(prop(forms.Recoverable(a, by=silent, within=1 * sec)), 20) == ()


# --- no change goes unsaid -----------------------------------------------------------------------

CHANGES = [
    (forms.Always(age < 120), forms.Always(age <= 120)),
    (forms.Always(age < 120), forms.Always(age < 140)),
    (forms.Always(a & b), forms.Always(a | b)),
    (forms.Always(a & b & c), forms.Always(a & (b | c))),
    (forms.Always((a & b) | c), forms.Always(a & (b | c))),
    (forms.Always(implies(a, b)), forms.Always(implies(b, a))),
    (forms.Always(implies(a & b, c)), forms.Always(a & implies(b, c))),
    (forms.Always(a == b), forms.Always(implies(a, b))),
    (forms.Always(a), forms.Never(a)),
    (forms.Always(a), forms.Always(previous(a))),
    (forms.Always(previous(a)), forms.Always(previous(previous(a)))),
    (forms.Always(held(a, 3 * ticks)), forms.Always(held(a, 4 * ticks))),
    (forms.Always(~held(a, 3 * ticks)), forms.Always(held(~a, 3 * ticks))),
    (forms.Always(held(a, 3 * ticks) & b), forms.Always(held(a & b, 3 * ticks))),
    (forms.Always(previous(a) & b), forms.Always(previous(a & b))),
    (forms.Responds(a, b, 3 * ticks), forms.Responds(a, b, 4 * ticks)),
    (forms.HoldsAfter(a, 3 * ticks, b), forms.HoldsAfter(a, 4 * ticks, b)),
    (forms.HoldsFor(a, b, 3 * ticks), forms.HoldsFor(a, b, 4 * ticks)),
    (forms.EntersOnlyIf(a, b), forms.LeavesOnlyIf(a, b)),
    (forms.Until(a, b, c), forms.Until(a, c, b)),
    (forms.LeadsTo(a, b), forms.LeadsTo(a, b, fair=(c,))),
]


@pytest.mark.parametrize(("one", "other"), CHANGES, ids=[f"{i}" for i in range(len(CHANGES))])
def test_another_property_has_another_sentence(one: forms.Form, other: forms.Form) -> None:
    assert sentence(prop(one), 20) != sentence(prop(other), 20)


# --- the catalogue -------------------------------------------------------------------------------


@pytest.mark.parametrize("known", catalogue().values(), ids=lambda p: p.id)
def test_a_property_of_the_catalogue_in_words(known: Property) -> None:
    said = formally(known)
    assert all(line.endswith(".") and line.count("(") == line.count(")") for line in map(_bare, said))
    quoted = {part.partition("”")[0] for part in " ".join(said).split("“")[1:]}
    defined = {line.partition("”")[0].removeprefix("“") for line in said[1:]}
    assert quoted == defined, "each name is spelled out, and no other"


def _bare(line: str) -> str:
    """The line without names, which may hold any sign."""
    return "".join(part.rpartition("”")[2] for part in line.split("“"))


def test_in_a_property_a_name_means_one_formula() -> None:
    by: dict[tuple[str, str], set[object]] = {}
    for known in catalogue().values():
        for formula in nodes(*forms.formulas(known.form)):
            if isinstance(formula, Named):
                by.setdefault((known.id, formula.name), set()).add(structure(formula.body))
    assert [where for where, meanings in by.items() if len(meanings) > 1] == []


def test_properties_with_one_sentence_are_one_property() -> None:
    by: dict[tuple[str, ...], set[str]] = {}
    for known in catalogue().values():
        said = (known.on, *formally(known))
        by.setdefault(said, set()).add(" ".join(text(f) for f in forms.formulas(known.form)))
    assert [said for said, written in by.items() if len(written) > 1] == []


def test_the_command_prints_80_columns(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "properties", "--english"]) == Exit.AS_EXPECTED
    shown = capfd.readouterr().out
    assert max(map(len, shown.splitlines())) <= 80
    assert all(f"\n{id} (on " in shown for id in catalogue())


def test_one_property_can_be_asked_for(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "properties", "PB1-13b", "--english"]) == Exit.AS_EXPECTED
    shown = " ".join(capfd.readouterr().out.split())
    assert shown.endswith("and each of the next 151 (3020 ms) give_b2_actuation is true.")


@pytest.mark.parametrize("more", [["--english"], ["PB1-11"]])
def test_only_properties_are_chosen_or_put_in_words(
    more: list[str], capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(["list", "systems", *more]) == Exit.USAGE
    assert "write `rovercheck list systems` without them" in " ".join(capfd.readouterr().err.split())
