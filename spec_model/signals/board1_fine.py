"""Signals of the links of Board 1 where an update may come at any ms between two steps."""

from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Var, var

LAG = integer(0, 19, "ms")
"""From an arrival to the step that sees it; an arrival at the instant of a step is seen by it."""

AGE = integer(0, 121, "ms")
"""Time since an update of the link or the heartbeat; 121 ms stands for all that exceeds 120 ms."""


def _lag(name: str) -> Var:
    return var(name, LAG, doc="from the latest update to the step that sees it")


def _first_lag(name: str) -> Var:
    doc = "from the first update of the tick to the step; more than the lag: there were two"
    return var(name, LAG, doc=doc)


rx_lag = _lag("rx_lag")
rx_first_lag = _first_lag("rx_first_lag")
rx_age_ms = var("rx_age_ms", AGE, doc="now_ms - Board2_Data.data_last_valid_ms")

heartbeat_lag = _lag("heartbeat_lag")
heartbeat_first_lag = _first_lag("heartbeat_first_lag")
heartbeat_age_ms = var("heartbeat_age_ms", AGE, doc="now_ms - last_valid_b2_ms")
