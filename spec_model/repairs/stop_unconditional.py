"""Motion: CMD_ESTOP stops the rover whatever it does, and the stop is not released while it lasts."""

from collections.abc import Callable

from rovercheck.spec_model.lang.chart import Chart, Junction, to
from rovercheck.spec_model.lang.edit import begin, guard
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.repairs import Repair
from rovercheck.spec_model.signals.board1 import cmd, rover_safety_state


def stop_while_commanded(cmd: Var, safety: Var) -> Callable[[Chart], Chart]:
    """S63 keeps the stop from a rover that does not move forward; release and first step ask no command."""
    stop = (cmd == "CMD_ESTOP") | (safety == "SAFETY_CRITICAL")

    def change(chart: Chart) -> Chart:
        first = Junction("first", [to("In_frenata_di_emergenza", when=stop), to("Stato_marcia_rover")])
        chart = begin(chart, [to("first")], [first])
        chart = guard(chart, "Stato_marcia_rover", 1, lambda _: stop)
        return guard(chart, "Procedura_emergency_stop", 1, lambda g: g & (cmd != "CMD_ESTOP"))

    return change


unconditional = Repair(
    name="stop-unconditional",
    text=(
        "The transition to In_frenata_di_emergenza asks for CMD_ESTOP alone, the default transition tests it "
        "too, and Procedura_emergency_stop is not left while CMD_ESTOP lasts."
    ),
    fixes=(
        "PB1-23a",
        "PB1-23b",
        "PB1-23c",
        "PB1-23d",
        "PB1-23e",
        "PB1-23f",
        "PSY-10a",
        "PSY-11",
        "PSY-12",
        "P-WEATHER-CALM",
        "P-WEATHER-NEAR-PUSHED",
        "P-WEATHER-NEAR-STEERED",
    ),
    charts={"Motion_Supervision": stop_while_commanded(cmd, rover_safety_state)},
    gives_up={
        "REACH1-ESTOP-IGNORED": "It shows that a rotation goes on under CMD_ESTOP, which the repair ends.",
        "PB1-26g": "A rotation now ends by CMD_ESTOP too, far from its target.",
        "PB1-40m": "A stop now begins by CMD_ESTOP whatever the user does.",
    },
)
