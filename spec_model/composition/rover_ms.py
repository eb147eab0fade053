"""The whole rover with stamps between the steps: everything that can change changes, or fails, at will.

No scene: every sensor, wheel, button and stick, the heading, each frame of the link and both boards are free
in every step.  It is far too large to be enumerated.  A statement about it is proved on the few variables
that it rests on (``localisation``), and holds in every weather.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace

from rovercheck.spec_model.board1 import LINKS
from rovercheck.spec_model.board1 import supervisor as supervisor_1
from rovercheck.spec_model.board1.fine_systems import LINKS_MS
from rovercheck.spec_model.board2 import supervisor as supervisor_2
from rovercheck.spec_model.board2.heading import measured
from rovercheck.spec_model.board2.supervisor_systems import targetAngle
from rovercheck.spec_model.composition.systems import ENVIRONMENT, SYNCHRONOUS, in_turn
from rovercheck.spec_model.environment import board1 as env1
from rovercheck.spec_model.environment import board2 as env2
from rovercheck.spec_model.environment import milliseconds as fine
from rovercheck.spec_model.lang.chart import Block, Component
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.common import PHASE_CLASS
from rovercheck.spec_model.system_table import SystemTable

RX_1 = "reception of Board 1"
"""The monitor of Board 1 whose data may be stamped between two steps, beside those of Board 2."""

ALL = (RX_1, *(s.region for s in b2.SOURCES if s is not b2.SUP))


@dataclass(frozen=True)
class Stamped:
    """Both boards with stamps at a phase to the steps: of each region named, frozen and unknown."""

    regions: Collection[str]

    @property
    def _sources(self) -> list[b2.SourceSignals]:
        return [b2.between_steps(s, PHASE_CLASS) if s.region in self.regions else s for s in b2.SOURCES]

    @property
    def phases(self) -> dict[str, Var]:
        """By the name of the region."""
        of_board1 = {RX_1: replace(b1.rx_phase, domain=PHASE_CLASS)} if RX_1 in self.regions else {}
        return {s.region: s.phase for s in self._sources if s.phase is not None} | of_board1

    @property
    def board2(self) -> tuple[Component, ...]:
        """The supervisor of Board 2."""
        return supervisor_2(heading=measured(motion.yaw, targetAngle), sources=self._sources)

    def in_turn(self, board2: tuple[Component, ...]) -> tuple[Component, ...]:
        """What happens in one instant, with this supervisor of Board 2."""
        links, reception = LINKS, env1.reception_clock
        if RX_1 in self.regions:
            links, reception = LINKS_MS, fine.reception_at(self.phases[RX_1])
        clocks: tuple[Block, ...] = env2.clocks_of(self._sources)
        return in_turn(supervisor_1(links), board2, reception, clocks)


def _rover_ms() -> System:
    stamped = Stamped(ALL)
    return in_order(
        "rover_ms",
        *stamped.in_turn(stamped.board2),
        text="Both boards, each of which may fail, and a link that may fail; data are stamped between the "
        "steps.",
        frozen=tuple(stamped.phases.values()),
        notes=(SYNCHRONOUS, fine.CONSTANT_PHASE, ENVIRONMENT),
    )


SYSTEMS = SystemTable(("rover_ms", _rover_ms))
