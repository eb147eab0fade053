"""Relay: Board 1 takes the motors back at once, as the text of §2.5 says, not after the 3 s of Fig 16."""

from rovercheck.spec_model.repairs import Repair

_BOARD2_TOO = "Board 2 follows the interpretation (E21) and gives the motors back without delay too."
_EXCLUDES = "It states the delay of Fig 16, which PB1-15 and the text of §2.5 exclude."

relay_without_delay = Repair(
    name="relay-without-delay",
    text="The transition B2_actuating -> B1_actuating of Fig 16 waits for no time (S45).",
    fixes=("PB1-15",),
    interpretations={"S45": "IMMEDIATE"},
    gives_up={
        **dict.fromkeys(("PB1-13a", "PB1-13b", "PB1-13c", "PB1-44b", "REACH-RELAY-LAST-STEP"), _EXCLUDES),
        **dict.fromkeys(("PB2-15a", "PB2-15c", "PB2-15d", "PB2-58b", "REACH-B2-LAST-STEP"), _BOARD2_TOO),
    },
)
