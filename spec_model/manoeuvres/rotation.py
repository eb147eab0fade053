"""How Retromarcia_180 knows how far it still has to turn: by the heading, or by a free error.

The chart reads the heading in two places: entry stores the target, 180 degrees away, and the during
action compares the heading with it.  Everything else reads the result, ``angle_err``.

A chart checked alone meets an arbitrary yaw in every step.  Then the heading may be replaced by one
free input, the error itself, without losing or adding a run:

* in the step of entry the error is -180 degrees for every yaw, since wrap(180) = -180;
* in every later step each error in [-180;180[ is that of some yaw, whatever the target is;
* nothing but ``angle_err`` reads yaw or the target.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.expr import FALSE, Expr, Var, const, ite
from rovercheck.spec_model.lang.words import absolute, named, wrap

NEAR = 7.5
"""Degrees from the target at which the rotation is over; strict."""


@dataclass(frozen=True)
class Rotation:
    """What Retromarcia_180 does with the heading: on entry, in each later step, and to know the end.

    ``data`` mean nothing outside the rotation, which begins by setting them.
    """

    start: tuple[Action, ...]
    measure: tuple[Action, ...]
    turned: Expr
    data: tuple[Var, ...]

    @property
    def local_to(self) -> Sequence[tuple[Var, Sequence[str]]]:
        return [(data, ["Retromarcia_180"]) for data in self.data]


def measured(yaw: Var, targetAngle: Var, angle_err: Var) -> Rotation:
    """The rotation as it is drawn, by the heading."""
    measure = assign(angle_err, angleError(yaw, targetAngle))
    return Rotation(
        start=(assign(targetAngle, angle180(yaw)), measure),
        measure=(measure,),
        turned=absolute(angle_err) < NEAR,
        data=(angle_err, targetAngle),
    )


def free(rotation_error: Var, angle_err: Var, nearly_turned: Var) -> Rotation:
    """The rotation of a chart that meets an arbitrary yaw: the error is the input ``rotation_error``.

    The next step needs of the error only whether it was below the limit: ``nearly_turned``.
    """
    return Rotation(
        start=(assign(angle_err, -180), assign(nearly_turned, FALSE)),
        measure=(
            assign(angle_err, named("angleError(yaw, targetAngle)", rotation_error)),
            assign(nearly_turned, absolute(angle_err) < NEAR),
        ),
        turned=named(f"abs({angle_err.name}) < {NEAR}", nearly_turned),
        data=(angle_err, nearly_turned),
    )


def angle180(g: Expr) -> Expr:
    """The opposite heading; 360 stays 360."""
    opposite = g + 180
    return named(f"angle180({g})", ite(opposite > 360, opposite - 360, opposite))


def angleError(g: Expr, target: Expr) -> Expr:
    """From heading ``g`` to the target, in [-180;180[ degrees, clockwise positive."""
    return named(f"angleError({g}, {target})", wrap(target - g))


def toward_target(angle_err: Var, omega: Expr) -> Expr:
    """``sign(-angle_err) * omega``: positive turns left, against a negative error; 0 when there."""
    return named(
        f"sign(-{angle_err.name}) * {omega}", ite(angle_err < 0, omega, ite(angle_err > 0, -omega, const(0)))
    )


def turned_around(v_user: Var, invert_y: Var) -> Action:
    """The end of UPD: after a rotation, the stick still pulled back means forward."""
    return when(
        invert_y,
        [when(v_user >= 0, [assign(invert_y, False)], [assign(v_user, -v_user)])],
    )
