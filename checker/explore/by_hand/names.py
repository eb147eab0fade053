"""What conditions may speak of: the variables of a system and the states of its charts."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.expr import Var


@dataclass(frozen=True)
class Names:
    """What a condition may speak of.

    ``spelled`` are the variables whose name Python cannot read, by the spelling used for them instead.
    """

    variables: Mapping[str, Var]
    charts: Mapping[str, Chart]
    spelled: Mapping[str, Var] = field(default_factory=dict)

    @property
    def states(self) -> list[str]:
        """All states, as they are written."""
        return [f"{c.name}.{'.'.join(path)}" for c in self.charts.values() for path in c.states if path]

    @property
    def help(self) -> str:
        """What may be written, with examples of this system."""
        state = f" ({self.states[0]})" if self.states else ""
        compared = next((f" ({text})" for v in self.variables.values() if (text := self._compared(v))), "")
        return f"Write a state{state}, a comparison{compared}, and, or, not, parentheses."

    def _compared(self, var: Var) -> str:
        """A comparison of a variable that people know by name; empty for others."""
        if isinstance(var.sort, Bool) or var.hidden or var.name in self.charts or not var.name.isidentifier():
            return ""
        sign = ">" if isinstance(var.sort, Num) else "=="
        return f"{var.name} {sign} {var.domain.show(var.domain.low)}"
