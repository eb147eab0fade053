"""What a chart or system must satisfy to have a meaning; every fault is said in a sentence."""

from rovercheck.spec_model.lang.wellformed.check import check_chart, check_system

__all__ = ["check_chart", "check_system"]
