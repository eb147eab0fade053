"""A toy board: a lamp that a button lights and a timer puts out; one transition can never be taken."""

from collections.abc import Mapping

from rovercheck.spec_model.abstraction import Board, Output, Value
from rovercheck.spec_model.abstraction.board import Values, units
from rovercheck.spec_model.abstraction.signals import discrete, measured, stamp
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import chosen
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, rising

press = flag("press", "the button is held down")
light = var("light_lx", chosen([0, 9, 10, 11, 100], "lx"), 100, "how bright it is")
lit = flag("lit", "the lamp is on")

lamp = Chart(
    "Lamp",
    [
        State("Off", entry=[assign(lit, False)], transitions=[
            to("On", when=rising(press) & (light < 10)),
            to("Broken", when=lit),
        ]),
        State("On", entry=[assign(lit, True)], transitions=[
            to("Off", when=after(3 * ticks) & ~press),
        ]),
        State("Broken"),
    ],
    default="Off",
    text="Lit in the dark by a press, for three steps at least",
)  # fmt: skip
NEVER = "Lamp.arrow.3"
"""Off -> Broken: the lamp is never lit in Off."""
AFTER_NEVER = "Lamp.pair.1-3"


class Plain:
    """Inputs of the chart are those of the board, as reader and as writer."""

    def __init__(self) -> None:
        self._now = 0

    def step(self, inputs: Values) -> dict[str, int]:
        return {"press": int(inputs["press"]), "light_lx": int(inputs["light_lx"])}


class Written:
    def __init__(self) -> None:
        self._now = 0

    def step(self, at: Mapping[str, int]) -> dict[str, Value]:
        self._now += TICK_MS
        given = {v.name: units(v.domain, at.get(v.name, v.init)) for v in (press, light)}
        return {"now_ms": self._now, **given}


SYSTEM = in_order("toy", lamp, text="The lamp alone")
TOY = Board(
    name="toy",
    system=SYSTEM,
    inputs=(stamp("now_ms", "start of the step"), discrete(press), measured(light, 0, 1000, whole=True)),
    outputs=(Output(discrete(lit), lit),),
    reader=Plain,
    writer=Written,
    grid_ms=TICK_MS,
)
