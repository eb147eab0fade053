"""A toy board: a lamp that a button lights and a timer puts out; one transition can never be taken."""

from rovercheck.spec_model.abstraction import Board, Output
from rovercheck.spec_model.abstraction.interface import BoardInterface, clock, produced, sample
from rovercheck.spec_model.abstraction.signals import discrete, measured
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


SYSTEM = in_order("toy", lamp, text="The lamp alone")
TOY = Board(
    name="toy",
    system=SYSTEM,
    interface=BoardInterface(
        (clock(), sample(discrete(press), press), sample(measured(light, 0, 1000, whole=True), light)),
        produced((Output(discrete(lit), lit),)),
    ),
    grid_ms=TICK_MS,
)
