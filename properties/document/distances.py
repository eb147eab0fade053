"""What the sonars measure: an obstacle near enough to stop for, a moving one in range [spec §3.4]."""

from rovercheck.spec_model.ambiguity import choose
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, any_of
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board2 import d1, d2, d3

NO_ECHO = 301
"""cm that stand for a sonar without an echo [design] (E13)."""


def within(limit: int) -> Expr:
    """Some sonar measures an obstacle at ``limit`` cm or less; any of the three counts (E27).

    The rover stops at 70 cm, in the degraded state at 300 cm [spec §3.4].
    """
    return named(f"nearest <= {limit}", any_of(*(d <= limit for d in (d1, d2, d3))))


def in_range(d: Var) -> Expr:
    """The range of moving obstacles: "> 100 cm" of §3.4 and "100-300 cm" of §3.4.1 i together (E03).

    Between 70 and 100 cm there is no rule (E01).
    """
    above_100 = choose("E03", {"OPEN": d > 100, "CLOSED": d >= 100, "HALF": d > 100, "UNBOUNDED": d > 100})
    least = choose("E01", {"GAP-NONE": above_100, "GAP-STOP": above_100, "GAP-MOVING": d > 70})
    most = choose("E03", {"OPEN": d < 300, "CLOSED": d <= 300, "HALF": d <= 300, "UNBOUNDED": TRUE})
    return named(f"closeRange({d.name})", least & most)
