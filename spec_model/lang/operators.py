"""The operators of formulas."""

from collections.abc import Mapping
from enum import StrEnum


class Op(StrEnum):
    """The closed set of operators; whatever reads expressions has a row for each in a table, ``OPERATIONS``.

    SCALE multiplies by a positive constant to change resolution (it is not written by people).
    DIV rounds down, MOD is never negative; both take a positive constant on the right.
    BIT(x, i) is bit i of a non-negative integer.
    """

    NOT = "not"
    AND = "and"
    OR = "or"
    ITE = "ite"
    EQ = "=="
    NE = "!="
    LT = "<"
    LE = "<="
    GT = ">"
    GE = ">="
    ADD = "+"
    SUB = "-"
    NEG = "neg"
    MUL = "*"
    SCALE = "scale"
    DIV = "div"
    MOD = "mod"
    ABS = "abs"
    MIN = "min"
    MAX = "max"
    BIT = "bit"


COMPARISONS = frozenset({Op.EQ, Op.NE, Op.LT, Op.LE, Op.GT, Op.GE})
SIGNS: Mapping[Op, str] = {
    Op.EQ: "==", Op.NE: "!=", Op.LT: "<", Op.LE: "<=", Op.GT: ">", Op.GE: ">=",
    Op.ADD: "+", Op.SUB: "-", Op.MUL: "*", Op.SCALE: "*",
}  # fmt: skip
"""What stands between two values in Python and C."""


def infix(left: object, sign: str, right: object) -> str:
    """What was written with an operator, with the parentheses that it needs."""
    from rovercheck.spec_model.lang.label import beside  # the printer reads expressions

    return f"{beside(left, sign)} {sign} {beside(right, sign, right=True)}"
