"""Obstacles in the degraded state, the choice between the two charts, and the command for Board 1."""

from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import always, holds_after
from rovercheck.spec_model.lang.expr import any_of, implies, ite
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.words import named, once, previous
from rovercheck.spec_model.signals.board2 import (
    DEG_B1,
    B2Dec,
    B2DecDegraded,
    B2Decision,
    autorized_prev,
    command,
    crit_mask_b1,
    deg_mask_b1,
    prevDEG_B1,
)
from rovercheck.spec_model.signals.board2_supervisor import B2DecDriving, autorized_to_send_command, cmd

inside_3m = within(300)

PB2_11b = always(
    "PB2-11b", "The decision is 0 to 4 in the non-degraded state and 5 or 6 in the degraded state.",
    that=any_of(*(B2Dec == n for n in range(5))) == ~DEG_B1,
    covers=("B2-OBS-07", "B2-OBS-22"), on="obstacles_free", interpretations=("E04", "E09"),
)  # fmt: skip

PB2_11c = always(
    "PB2-11c", "Decisions 1, 6 become CMD_ESTOP, 2 CMD_GO_LEFT, 4 CMD_GO_RIGHT, and 0, 3, 5 CMD_NORMAL.",
    that=any_of(
        (command == "CMD_ESTOP") & ((B2Dec == 1) | (B2Dec == 6)),
        (command == "CMD_GO_LEFT") & (B2Dec == 2),
        (command == "CMD_GO_RIGHT") & (B2Dec == 4),
        (command == "CMD_NORMAL") & any_of(*(B2Dec == n for n in (0, 3, 5))),
    ),
    covers=("B1-IN-01", "B2-OBS-08"), on="obstacles_free", interpretations=("E04", "E31"),
)  # fmt: skip

PB2_12 = always(
    "PB2-12", "In the degraded state an obstacle at 300 cm or less means stop in the same step.",
    that=implies(DEG_B1 & inside_3m, B2Dec == 6),
    covers=("B2-OBS-04", "B2-OBS-22"), on="obstacles_free", from_tick=2, interpretations=("E09", "E32"),
)  # fmt: skip

PB2_12_else = always(
    "PB2-12-else", "In the degraded state without an obstacle at 300 cm or less the rover moves degraded.",
    that=implies(DEG_B1 & ~inside_3m, B2Dec == 5),
    covers=["B2-OBS-22"], on="obstacles_free", from_tick=2, interpretations=("E09", "E32"),
)  # fmt: skip

PB2_12_command = always(
    "PB2-12-command", "In the degraded state an obstacle at 300 cm or less means CMD_ESTOP in the same step.",
    that=implies(DEG_B1 & inside_3m, command == "CMD_ESTOP"),
    covers=("B2-OBS-04", "B2-OBS-22"), on="obstacles_free", from_tick=2,
    interpretations=("E04", "E09", "E32"),
)  # fmt: skip

PB2_12_chart = always(
    "PB2-12-chart", "From step 2 on the degraded chart stops exactly for obstacles at 300 cm or less.",
    that=(B2DecDegraded == 6) == inside_3m,
    covers=["B2-OBS-22"], on="obstacles_d", from_tick=2,
)  # fmt: skip

PB2_12_first = always(
    "PB2-12-first", "In every step, also the first, an obstacle at 300 cm or less stops the degraded chart.",
    that=implies(inside_3m, B2DecDegraded == 6),
    covers=("B2-OBS-04", "B2-OBS-22"), on="obstacles_d",
)  # fmt: skip

PB2_12_next = holds_after(
    "PB2-12-next", "An obstacle at 300 cm or less in two steps running stops the degraded chart.",
    premise=inside_3m, for_=1 * tick, then=B2DecDegraded == 6,
    covers=("B2-OBS-04", "B2-OBS-22"), on="obstacles_d",
)  # fmt: skip

PB2_12_only = always(
    "PB2-12-only", "In no step, not even the first, does the degraded chart stop without such an obstacle.",
    that=implies(~inside_3m, B2DecDegraded == 5),
    covers=["B2-OBS-22"], on="obstacles_d",
)  # fmt: skip

# --- the choice between the two charts -------------------------------------------------------------

a_cause = named("a fault on Board 1, or Board 2 drove", deg_mask_b1 | crit_mask_b1 | autorized_prev)

PB2_51 = always(
    "PB2-51", "The state is degraded exactly if a fault mask last received from Board 1 is not zero, or if "
              "Board 2 was authorised in the step before.",
    that=DEG_B1 == a_cause,
    covers=("B2-OBS-01", "B2-OBS-04"), on="obstacles", interpretations=["E09"],
)  # fmt: skip

PB2_51_previous = always(
    "PB2-51-previous", "prevDEG_B1 is true exactly if one step ago there was such a cause for the degraded "
                       "state.",
    that=prevDEG_B1 == previous(a_cause),
    covers=["B2-OBS-04"], on="obstacles", interpretations=["E09"],
)  # fmt: skip

PB2_52 = always(
    "PB2-52", "One step after the degraded state the non-degraded chart does not deviate.",
    that=implies(previous(DEG_B1), ~any_of(*(B2Decision == n for n in (2, 3, 4)))),
    covers=["B2-OBS-09"], on="obstacles_free", from_tick=2, interpretations=("E09", "E32"),
)  # fmt: skip

PB2_53 = always(
    "PB2-53", "The decision of Board 2 is that of the degraded chart in the degraded state, else that of the "
              "non-degraded one.",
    that=B2Dec == ite(DEG_B1, B2DecDegraded, B2Decision),
    covers=("B2-OBS-07", "B2-OBS-22"), on="obstacles", interpretations=("E09", "E32"),
)  # fmt: skip

# --- the degraded chart while Board 2 drives -------------------------------------------------------

drove_before = named("Board 2 was authorised before", once(previous(autorized_to_send_command)))
drives = named("Board 2 drives", autorized_to_send_command)

PB2_56 = always(
    "PB2-56", "While Board 2 drives, but for the first such step, its obstacle decision is to stop exactly "
              "if an obstacle is at 300 cm or less.",
    that=implies(drives & drove_before, (B2DecDriving == 6) == inside_3m),
    covers=("B2-OBS-04", "B2-OBS-22"), on="references_2", interpretations=["E22"],
)  # fmt: skip

PB2_56_command = always(
    "PB2-56-command", "While Board 2 drives, the command is CMD_ESTOP at decision 6 and CMD_NORMAL at 5, and "
                      "the decision is one of the two.",
    that=implies(drives, ite(B2DecDriving == 6, cmd == "CMD_ESTOP",
                             (B2DecDriving == 5) & (cmd == "CMD_NORMAL"))),
    covers=("B2-OBS-04", "B2-OBS-22"), on="references_2", interpretations=("E04", "E22"),
)  # fmt: skip

PB2_56_before = always(
    "PB2-56-before", "Until Board 2 drives, the chart that only then executes has decided nothing: it says "
                     "0.",
    that=implies(~once(drives), B2DecDriving == 0),
    covers=["B2-OBS-22"], on="references_2", interpretations=["E22"],
)  # fmt: skip

PB2_56_first = always(
    "PB2-56-first", "In the first step in which Board 2 drives it goes on, whatever the distances.",
    that=implies(drives & ~drove_before, B2DecDriving == 5),
    covers=["B2-OBS-22"], on="references_2", interpretations=["E22"],
)  # fmt: skip
