"""Edits of charts, as faults put in by hand."""

from spec_model.lang.edit import (
    arrow,
    arrows,
    constant,
    drop,
    edit_junction,
    edit_state,
    entry,
    everywhere,
    guard,
    in_block,
    in_expressions,
    in_system,
    operator,
    swap,
    timer,
)  # fmt: skip

__all__ = [
    "arrow", "arrows", "constant", "drop", "edit_junction", "edit_state", "entry", "everywhere", "guard",
    "in_block", "in_expressions", "in_system", "operator", "swap", "timer",
]  # fmt: skip
