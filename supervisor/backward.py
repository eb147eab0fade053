"""The presses of two buttons that switch backward driving on and off, the same on both boards."""

from dataclasses import dataclass, field
from enum import Enum, auto

from rovercheck.supervisor.timing import After, Rising, steps


class Combo(Enum):
    """How much of the combination btn1, btn1, btn2, btn2 has been pressed."""

    STARTING_POINT = auto()
    STEP2 = auto()
    STEP3 = auto()
    STEP4 = auto()


@dataclass
class BackwardToggle:
    """``Backward_mode_toggle``: presses within one second of each other, with the joystick centred.

    The first execution needs no case of its own: no edge rises in it, so it stays where it starts.  An axis
    that is not a number is not centred.
    """

    backward_enabled: bool = False
    state: Combo = Combo.STARTING_POINT
    _timer: After = field(default_factory=lambda: After(steps(1)))
    _btn1: Rising = field(default_factory=Rising)
    _btn2: Rising = field(default_factory=Rising)

    def step(self, x_norm: float, y_norm: float, btn1: float, btn2: float) -> bool:
        """One execution; true while backward driving is on.

        Axes lie in [-1;1] and are exactly 0 inside their dead zone; a button is above 0 while pressed.
        """
        self._timer.tick()
        pressed1, pressed2 = self._btn1.update(btn1), self._btn2.update(btn2)
        centred = x_norm == 0 and y_norm == 0
        if self.state is Combo.STARTING_POINT:
            if pressed1 and centred:
                self._enter(Combo.STEP2)
        elif not centred:
            self._enter(Combo.STARTING_POINT)
        else:
            self._combine(pressed1, pressed2)
        return self.backward_enabled

    def _combine(self, pressed1: bool, pressed2: bool) -> None:
        if self.state is Combo.STEP2 and pressed1:
            self._enter(Combo.STEP3)
        elif self.state is Combo.STEP3 and pressed2:
            self._enter(Combo.STEP4)
        elif self.state is Combo.STEP4 and pressed2:
            self.backward_enabled = not self.backward_enabled
            self._enter(Combo.STARTING_POINT)
        elif self._timer.over:
            self._enter(Combo.STARTING_POINT)

    def _enter(self, state: Combo) -> None:
        self.state = state
        self._timer.enter()
