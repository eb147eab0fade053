"""A lamp with an alarm and a few properties: a model of which every mutant can be judged by hand."""

from rovercheck.properties.forms import always, never, reachable
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.expr import flag, implies, ite, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, bit

press, level = flag("press"), var("level", integer(0, 3))
lit, shade = flag("lit"), var("shade", enumeration("Shade", ["DARK", "WARM", "COLD"]))
alarm, seen, copy = flag("alarm"), var("seen", integer(0, 3)), var("copy", integer(0, 3))

lamp = Chart(
    "Lamp",
    [
        State(
            "Off",
            entry=[assign(lit, False), assign(shade, "DARK")],
            transitions=[to("On", when=press & (level >= 2)), to("Night", when=press)],
        ),
        State(
            "On",
            entry=[assign(lit, True), assign(shade, "WARM")],
            transitions=[to("Off", when=after(2 * ticks)), to("Night", when=level < 1)],
        ),
        State("Night", entry=[assign(lit, False), assign(shade, "COLD")], transitions=[to("Off")]),
    ],
    default="Off",
)
alarming = Block(
    "Alarm",
    [
        assign(alarm, lit & (shade != "DARK") & bit(level, 0)),
        when(alarm, [assign(seen, level)], [assign(seen, ite(lit, 0, seen))]),
        assign(copy, seen),
    ],
)
lamps = in_order("lamps", lamp, alarming)

LIT = always("LIT", "A lit lamp is warm.", that=implies(lit, shade == "WARM"), covers=["R"], on=lamps)
QUIET = never("QUIET", "No alarm without light.", that=alarm & ~lit, covers=["R"], on=lamps)
NIGHT = reachable("NIGHT", "The lamp can be cold.", that=shade == "COLD", covers=["R"], on=lamps)
NEVER = never("NEVER", "It is never lit, which is wrong.", that=lit, covers=["R"], on=lamps)
REQUIREMENTS = {"R": "A lamp."}
