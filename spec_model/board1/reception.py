"""Reception monitor of Board 1: do valid frames of Board 2 arrive, and often enough [spec §2.4, Table 2]."""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals.board1 import rx_age, rx_slow, rx_status


def reception_monitor(age: Var) -> Chart:
    """The monitor for an age of the last valid frame in ms, however fine its steps."""
    silent = named("age_R > 120 ms", age > 120)
    return Chart(
        "Monitor_reception",
        [
            State("Rx_OK", entry=[assign(rx_status, "RX_OK")], transitions=[to("decide")]),
            State("Rx_DEG", entry=[assign(rx_status, "RX_DEGRADED")], transitions=[to("decide")]),
            State("Rx_CRIT", entry=[assign(rx_status, "RX_CRITICAL")], transitions=[to("decide")]),
        ],
        default=[to("decide"), to("Rx_OK")],
        junctions=[
            Junction(
                "decide",
                [
                    to("Rx_CRIT", when=silent),  # strict (S37); wins over a slow mean (S39)
                    to("Rx_DEG", when=rx_slow),
                    to("Rx_OK"),  # released by the first fresh frame (S38)
                ],
            )
        ],
        text="Reception status from the age of the last valid frame and the mean of ten intervals.",
    )


monitor_reception = reception_monitor(rx_age)
