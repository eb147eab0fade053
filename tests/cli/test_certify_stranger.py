"""A checker of certificates written from docs/certificates.md alone, with none of ours and another solver."""

import gzip
import json
import re
from collections.abc import Mapping
from hashlib import sha256
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
import z3

from rovercheck.checker.certify.certificate import certificates
from rovercheck.checker.certify.file import CertificateOrigin, write
from rovercheck.checker.results.verdict import Inductive, Unreachable
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, const, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.certificate_files import COUNTERS, WHEEL, written
from tests.certifying import certified


def shows(certificate: Mapping[str, Any]) -> bool:
    """Whether every obligation is met."""
    lines = certificate["question"]
    assert sha256("".join(f"{line}\n" for line in lines).encode()).hexdigest() == certificate["digest"]
    cut = next(i for i, line in enumerate(lines) if line.startswith("(define-fun |:domain@0|")) + 1
    valuation, tick, init = lines[:cut], lines[cut:-1], lines[-1:]
    here = invariant(certificate["invariant"], valuation)
    there = [line.replace("@0|", "@1|") for line in here]
    claims = [f"|{claim}@{{}}|" for claim in certificate["claims"]]
    tried = [*valuation, *tick]
    before = ["|:domain@0|", "|:I@0|", "|:assume@0|"]
    met = [
        unsatisfiable([*valuation, *init, *here], "|:domain@0|", "|:init@0|", "(not |:I@0|)"),
        unsatisfiable([*tried, *here, *there], *before, "(not |:I@1|)"),
        unsatisfiable([*tried, *here], *before, "(not |:stays@0|)"),
    ]
    k = certificate["invariant"].get("ticks", 1)
    if k == 1:
        return all(met) and all(unsatisfiable([*tried, *here], *before, c.format(1)) for c in claims)
    run = [
        *valuation,
        *(re.sub("@1[|]", f"@{i + 1}|", line).replace("@0|", f"@{i}|") for i in range(k) for line in tick),
    ]
    names = re.findall(r"\(declare-const \|([^|]+)@0\|", "\n".join(valuation))
    apart = [
        f"(or {' '.join(f'(distinct |{n}@{a}| |{n}@{b}|)' for n in names)})"
        for a, b in combinations(range(k), 2)
        if certificate["invariant"]["simple"]
    ]
    for claim in claims:
        for last in range(1, k):
            assumed = [f"|:assume@{i}|" for i in range(last)]
            base = ["|:domain@0|", "|:init@0|", *assumed, claim.format(last)]
            met.append(unsatisfiable([*run, *init], *base))
        step = [*before, *(f"|:assume@{i}|" for i in range(k)), *apart]
        step += [f"(not {claim.format(i)})" for i in range(1, k)]
        met.append(unsatisfiable([*run, *here], *step, claim.format(k)))
    return all(met)


def unsatisfiable(lines: list[str], *asserted: str) -> bool:
    solver = z3.Solver()
    solver.from_string("\n".join([*lines, *(f"(assert {a})" for a in asserted)]))
    return bool(solver.check() == z3.unsat)


def invariant(found: Mapping[str, Any], valuation: list[str]) -> list[str]:
    """Definitions up to that of |:I@0|."""
    if "nodes" not in found:
        conjuncts = " ".join([*found["conjuncts"], "true", "true"])
        return [*found["definitions"], f"(define-fun |:I@0| () Bool (and {conjuncts}))"]
    sorts = dict(re.findall(r"\(declare-const (\|[^|]+\|) (.+)\)", "\n".join(valuation)))
    lines, names = [], ["true"]
    for number, (variable, *edges) in enumerate(found["nodes"], 1):
        name = found["variables"][variable]
        symbol = f"|{name}@0|" if f"|{name}@0|" in sorts else f"|{name}|"
        ways = " ".join(
            f"(and {between(symbol, sorts[symbol], low, high)} {names[to]})"
            for low, high, to in zip(edges[::3], edges[1::3], edges[2::3], strict=True)
        )
        names.append(f"|:d{number}@0|")
        lines.append(f"(define-fun {names[-1]} () Bool (or false {ways}))")
    return [*lines, f"(define-fun |:I@0| () Bool {names[found['root']]})"]


def between(symbol: str, sort: str, low: int, high: int) -> str:
    if sort == "Bool":
        return "true" if low < high else f"(= {symbol} {'true' if low else 'false'})"
    bits = int(sort.rstrip(")").split()[-1])
    ends = (f"(_ bv{end % 2**bits} {bits})" for end in (low, high))
    return "(and (bvsle {1} {0}) (bvsle {0} {2}))".format(symbol, *ends)


def inside(path: Path) -> list[Mapping[str, Any]]:
    data = path.read_bytes()
    found: list[Mapping[str, Any]] = json.loads(gzip.decompress(data) if path.suffix == ".gz" else data)[
        "certificates"
    ]
    return found


@pytest.mark.parametrize("ids", [COUNTERS, WHEEL])
def test_certificates_of_the_rover(ids: tuple[str, ...], tmp_path: Path) -> None:
    found = inside(written(tmp_path, *ids))
    assert found and all(map(shows, found))


COUNT, LAST, STAY, BAD = (
    var("count", integer(-3, 4)),
    var("last", chosen([-3, 1, 4])),
    flag("stay"),
    flag("bad"),
)
TOP = var("top", integer(1, 2), 1)


def system() -> TransitionSystem:
    """``count`` goes from 0 to ``top`` and back to 0; from 3, where no run gets, to 4, which is bad."""
    up = ite(
        COUNT < TOP, COUNT + 1, ite(COUNT == TOP, const(0), ite(STAY, COUNT, minimum(COUNT + 1, const(4))))
    )
    program = (Assign(LAST, ite(COUNT == 1, const(1), LAST)), Assign(COUNT, up), Assign(BAD, COUNT == 4))
    return TransitionSystem(
        "odd", (STAY,), (TOP,), (Var("count", COUNT.domain), Var("last", LAST.domain, 1), BAD), (), program
    )


def stated(folder: Path, *conjuncts: Expr, ticks: int = 1, simple: bool = False) -> Mapping[str, Any]:
    answer = Unreachable(Inductive(conjuncts, ticks, simple))
    made = certificates(system(), [BAD], {"bad": answer}, "hand")
    [found] = inside(write(folder, CertificateOrigin("odd", ("X",), ("X",), {}), made))
    return found


def test_a_closed_set_with_a_frozen_variable(tmp_path: Path) -> None:
    made = certified(system(), [BAD])
    [found] = inside(write(tmp_path, CertificateOrigin("odd", ("X",), ("X",), {}), made))
    assert "top" in found["invariant"]["variables"] and shows(found)
    found["invariant"]["nodes"][-1][1:4] = []
    assert not shows(found)


def test_conjuncts(tmp_path: Path) -> None:
    assert shows(stated(tmp_path, COUNT <= TOP))
    assert not shows(stated(tmp_path, COUNT <= 3))
    assert not shows(stated(tmp_path, TRUE))


def test_k_induction(tmp_path: Path) -> None:
    assert shows(stated(tmp_path, COUNT >= 0, ticks=4, simple=True))
    assert not shows(stated(tmp_path, COUNT >= 0, ticks=2, simple=True))
    assert shows(stated(tmp_path, COUNT <= TOP, ticks=3))
    assert not shows(stated(tmp_path, COUNT >= 0, ticks=3))
