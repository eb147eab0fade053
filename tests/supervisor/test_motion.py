"""What both motion charts share: axes, angles, standstill, the user's references."""

from math import inf, isfinite, isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.motion import (
    UserReferences,
    angle180,
    angle_error,
    axis,
    check_stop,
    heading,
    sign,
    wrap,
)


@pytest.mark.parametrize(
    "value, used",
    [(0.0, 0.0), (0.1, 0.1), (-1.0, -1.0), (1.0, 1.0), (1.5, 1.0), (-2, -1.0), (nan, 0), (inf, 0), (-inf, 0)],
)
def test_axis(value, used):
    assert axis(value) == used


def test_heading():
    assert [heading(yaw) for yaw in (0.0, 359.5, 360.0, -90.0)] == [0, 359.5, 0, 270]
    assert 0 <= heading(-1e308) < 360
    assert all(isnan(heading(yaw)) for yaw in (nan, inf, -inf))


def test_sign():
    assert [sign(-0.5), sign(0.0), sign(-0.0), sign(7)] == [-1, 0, 0, 1]


@pytest.mark.parametrize(
    "degrees, wrapped",
    [(0, 0), (179.5, 179.5), (180, -180), (-180, -180), (-180.5, 179.5), (360, 0), (540, -180), (-540, -180)],
)
def test_wrap(degrees, wrapped):
    assert wrap(degrees) == wrapped


@given(st.floats(-1e6, 1e6))
def test_wrap_stays_in_its_half_open_range(degrees):
    assert -180 <= wrap(degrees) < 180


def test_wrap_of_a_hair_below_the_seam():
    assert wrap(-180.00000000000003) < 180


@pytest.mark.parametrize("yaw, opposite", [(0, 180), (179, 359), (180, 360), (181, 1), (359.5, 179.5)])
def test_angle180(yaw, opposite):
    assert angle180(yaw) == opposite


@pytest.mark.parametrize("yaw, target, error", [(350, 10, 20), (10, 350, -20), (0, 180, -180), (200, 200, 0)])
def test_angle_error(yaw, target, error):
    assert angle_error(yaw, target) == error


@pytest.mark.parametrize("wheel", range(4))
@pytest.mark.parametrize(
    "rpm, stands",
    [(0, True), (2.4, True), (-2.4, True), (2.5, False), (-2.5, False), (nan, False), (inf, False)],
)
def test_check_stop(wheel, rpm, stands):
    speeds = [0.0] * 4
    speeds[wheel] = rpm
    assert check_stop(speeds) == stands


def test_references_are_scaled():
    user = UserReferences()
    user.update(0.5, -0.8, 0.5, 0.4)
    assert (user.v_user, user.omega_user) == (-0.4, 0.2)
    user.update(-0.5, 0.8, 0.5, 0.4)
    assert (user.v_user, user.omega_user) == (0.4, -0.2)


@pytest.mark.parametrize("y, v_user, still", [(-0.8, 0.8, True), (0.0, 0.0, False), (0.5, 0.5, False)])
def test_inverted_references(y, v_user, still):
    user = UserReferences(invert_y=True)
    user.update(0.0, y, 1.0, 1.0)
    assert (user.v_user, user.invert_y) == (v_user, still)


def test_no_speed_allowed_ends_the_inversion():
    user = UserReferences(invert_y=True)
    user.update(0.0, -1.0, 0.0, 0.0)
    assert (user.v_user, user.invert_y) == (0, False)


@given(st.floats())
def test_an_axis_never_gives_an_infinite_reference(value):
    user = UserReferences()
    user.update(axis(value), axis(value), 1.0, 1.0)
    assert isfinite(user.v_user) and abs(user.omega_user) <= 1
