"""Toggle of backward mode of Board 1, the first region of its reference chart [spec Fig 19] (S59)."""

from rovercheck.spec_model.manoeuvres.backward import backward_mode_toggle
from rovercheck.spec_model.signals.board1 import backward_enabled, btn1, btn2, x_norm, y_norm

toggle = backward_mode_toggle(
    "Backward_mode_toggle",
    btn1=btn1,
    btn2=btn2,
    x_norm=x_norm,
    y_norm=y_norm,
    backward_enabled=backward_enabled,
)
