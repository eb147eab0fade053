"""The SMT-LIB text of questions and invariants against the reference semantics."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.strategies import DataObject, DrawFn

from rovercheck.checker.certify import smtlib, solver
from rovercheck.checker.certify.invariant import conjuncts
from rovercheck.checker.certify.question import CertifyQuestion, question
from rovercheck.checker.certify.smtlib import own, quoted
from rovercheck.checker.certify.terms import DEEPEST, TRUTH, Malformed, definitions, evaluate, read
from rovercheck.checker.certify.tick import conjuncts as parts
from rovercheck.checker.certify.tick import executed
from rovercheck.checker.results.verdict import Inductive
from rovercheck.spec_model.lang.evaluate import evaluate as value_of
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.strategies_ts import booleans, goals, transition_systems


def asked(system: TransitionSystem) -> CertifyQuestion:
    everything = [v.name for v in (*system.variables, *system.frozen)]
    claims = [g.name for g in goals(system)]
    return question(executed(system), claims, range(len(parts(system.assume))), everything)


def some(data: DataObject, variables: tuple[Var, ...]) -> dict[str, int]:
    return {v.name: data.draw(st.sampled_from(list(v.domain.values))) for v in variables}


def values(script: str, symbols: list[str]) -> dict[str, int]:
    """A model of the script, which has one."""
    sent: list[Any] = []
    solver.solve(sent.append, [script], [symbols])
    return dict(sent[0])


def fixed(found: CertifyQuestion, at: dict[str, int], variables: tuple[Var, ...]) -> list[str]:
    """The state and the inputs, asserted."""
    symbols = found.symbols(0)
    return [f"(assert {smtlib.among(symbols[v.name], v.domain, [(at[v.name],) * 2])})" for v in variables]


@given(transition_systems(), st.data())
def test_a_tick_is_that_of_the_reference(system: TransitionSystem, data: DataObject) -> None:
    found = asked(system)
    before = some(data, (*system.variables, *system.frozen))
    inputs = some(data, system.inputs)
    expected = step(system, before, inputs)
    lines = [*found.valuation(), *found.one_tick(0), *found.initial()]
    lines += fixed(found, before | inputs, (*found.state, *found.tick.inputs))
    after = {quoted(v.name, 1): expected[v.name] for v in found.tick.variables}
    told = {own("domain", 0): 1, own("stays", 0): 1}
    told[own("assume", 0)] = value_of(system.assume, before | inputs)
    told[own("init", 0)] = int(all(before[v.name] == v.init for v in system.variables))
    assert values("\n".join(lines), [*after, *told]) == after | told


@st.composite
def conditions(draw: DrawFn, state: tuple[Var, ...]) -> tuple[Expr, ...]:
    """Three random conditions over the variables."""
    return tuple(booleans(draw, state, 3) for _ in range(3))


@given(transition_systems(), st.data())
def test_conjuncts_mean_the_same_to_the_solver_and_to_the_reader(
    system: TransitionSystem, data: DataObject
) -> None:
    state = (*system.frozen, *system.variables)
    formulas = data.draw(conditions(state))
    written = conjuncts(Inductive(formulas), system.frozen, system.variables)
    found = asked(system)
    at = some(data, state)
    symbols = found.symbols(0)
    bodies, sorts = definitions(written.definitions, found.spoken)
    assert all(sorts[c] == TRUTH for c in written.conjuncts if c.startswith("|"))
    known: dict[str, bool | tuple[int, int]] = {}
    for v in state:
        bits = 0 if smtlib.sort(v.domain) == "Bool" else smtlib.width(v.domain)
        known[symbols[v.name]] = (at[v.name] % (1 << bits), bits) if bits else bool(at[v.name])
    for symbol, body in bodies.items():
        known[symbol] = evaluate(body, known)
    expected = {c: value_of(f, at) for c, f in zip(written.conjuncts, formulas, strict=True)}
    assert {c: int(evaluate(c, known) is True) for c in written.conjuncts} == expected
    names = {c: c if c.startswith("|") else own("literal", i) for i, c in enumerate(written.conjuncts)}
    lines = [*found.valuation(), *written.definitions, *fixed(found, at, state)]
    lines += [smtlib.define(name, "Bool", c) for c, name in names.items() if name != c]
    assert values("\n".join(lines), list(names.values())) == {names[c]: v for c, v in expected.items()}


@pytest.mark.parametrize("name", ["x", "PB1-11 phase", "a|b", "a@1", "%7C", "back\\slash", ":init", "età"])
def test_symbols_of_different_names_differ(name: str) -> None:
    symbol = quoted(name, 3)
    assert symbol.startswith("|") and symbol.endswith("@3|") and symbol.isascii()
    assert not set("|\\@:") & set(symbol[1:-3])
    others = {quoted(n, 3) for n in ("y", "a%7Cb", "a%401", "%257C", "%3Ainit")}
    assert symbol not in others


INSIDE = {"|x@0|": 4, "|b@0|": TRUTH}


@pytest.mark.parametrize(
    "line",
    [
        "(define-fun |:c0@0| () Bool |b@0|) (assert false)",
        "(define-fun |:c0@0| () Bool |b@0|",
        "(define-fun |:c0@0| () Bool |x@1|)",
        "(define-fun |:c0@0| () Bool |:assume@0|)",
        "(define-fun |x@1| () Bool true)",
        "(define-fun |:c0@0| ((y Bool)) Bool true)",
        "(define-fun |:c0@0| () Bool (exists ((y Bool)) y))",
        "(define-fun |:c0@0| () Bool ((_ extract 1 -1) |x@0|))",
        "(define-fun |:c0@0| () Bool true) ; |",
        "(define-fun |:c0@0| () Bool true)\u00a0",
        "(define-fun |:c0@0| () Bool\x00true)",
        "(define-fun |:c\u0663@0| () Bool true)",
        "(define-fun |:c0@0| () Bool (push 1))",
        "(define-fun |:c0@0| () Bool (not |b@0| false))",
        "(define-fun |:c0@0| () Bool (ite |b@0|))",
        "(define-fun |:c0@0| () Bool (and))",
        "(define-fun |:c0@0| () Bool (= |x@0| |x@0| |x@0|))",
        "(define-fun |:c0@0| () Bool (= |x@0| |b@0|))",
        "(define-fun |:c0@0| () Bool (ite |b@0| true |x@0|))",
        "(define-fun |:c0@0| () Bool (bvslt |x@0| (_ bv1 5)))",
        "(define-fun |:c0@0| () Bool (bvslt (_ bv0 0) (_ bv0 0)))",
        "(define-fun |:c0@0| () Bool |x@0|)",
        "(define-fun |:c0@0| () (_ BitVec 4) |b@0|)",
        "(define-fun |:c0@0| () (_ BitVec 5) |x@0|)",
        "(define-fun |:c0@0| () (_ BitVec 1) ((_ extract 4 4) |x@0|))",
        "(define-fun |:c0@0| () (_ BitVec 1) ((_ extract 1 2) |x@0|))",
        "(define-fun |:c0@0| () (_ BitVec 2) ((_ extract 1 0) |b@0|))",
        "(define-fun |:c0@0| () Bool (= |x@0| ((_ sign_extend 9999999999) |x@0|)))",
        "(define-fun |:c0@0| () Bool (= |x@0| (_ bv" + "9" * 5000 + " 4)))",
        "(define-fun |:c0@0| () Bool " + "(not " * DEEPEST + "true" + ")" * DEEPEST + ")",
        "(define-fun |:c0@0| () Bool " + "(" * 100_000,
        "(assert false)",
        "(declare-const |:c0@0| Bool)",
        ")",
        "",
    ],
)
def test_a_definition_says_nothing_but_a_formula_about_the_valuation(line: str) -> None:
    with pytest.raises(Malformed):
        definitions([line], INSIDE)


def test_nothing_is_defined_twice() -> None:
    line = "(define-fun |:c0@0| () Bool |b@0|)"
    assert definitions([line], INSIDE) == ({"|:c0@0|": "|b@0|"}, INSIDE | {"|:c0@0|": TRUTH})
    with pytest.raises(Malformed):
        definitions([line, line], INSIDE)


def test_reading_a_term() -> None:
    assert read("(and |a b@0| (= |x@0| (_ bv3 4)))") == ("and", "|a b@0|", ("=", "|x@0|", ("_", "bv3", "4")))


@given(st.integers(-8, 7), st.integers(-8, 7))
def test_arithmetic_on_bit_vectors(a: int, b: int) -> None:
    known: dict[str, bool | tuple[int, int]] = {"|x@0|": (a % 16, 4), "|y@0|": (b % 16, 4)}
    operators = [
        "bvadd",
        "bvsub",
        "bvmul",
        "bvsdiv",
        "bvsmod",
        "bvslt",
        "bvsle",
        "bvsgt",
        "bvsge",
        "=",
        "distinct",
    ]
    terms = {f"({op} |x@0| |y@0|)": op for op in operators}
    script = [f"(declare-const {s} (_ BitVec 4))" for s in known]
    for (text, op), i in zip(terms.items(), range(99), strict=False):
        of = "(_ BitVec 4)" if op in operators[:5] else "Bool"
        script.append(smtlib.define(f"r{i}", of, text))
    script += [f"(assert (= {s} (_ bv{v[0]} 4)))" for s, v in known.items() if not isinstance(v, bool)]
    found = values("\n".join(script), [f"r{i}" for i in range(len(terms))])
    for i, text in enumerate(terms):
        mine = evaluate(read(text), known)
        number = int(mine) if isinstance(mine, bool) else mine[0] - (mine[0] >> 3 << 4)
        assert number == found[f"r{i}"], text
