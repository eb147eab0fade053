"""Scenes in which something must happen in one step and no other: what random runs seldom meet."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.compare.environment import Blocks, Environment
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Toward

QUICK = 3
"""Steps from one press of a button to the next, where nothing waits for them."""
SECOND = range(40, 60)
"""Steps in which the timers of one second lie that a combination of presses is given up after."""
PRESSES = (0, 0, 1, 1)


def combinations(env: Environment, buttons: Sequence[str], axes: Sequence[str]) -> Iterator[Blocks]:
    """The presses that toggle backward mode: each in turn nearly too late, or after the stick has moved."""
    centred = InputBlock(2, tuple((axis, 0) for axis in axes))
    over = InputBlock(max(SECOND), (*((axis, 0) for axis in axes), *((button, False) for button in buttons)))
    late = [n for n in env.timers if n in SECOND]
    for stage in range(1, len(PRESSES)):
        for gap in (QUICK, *late):
            yield [centred, *_pressed(buttons, {stage: gap}), over]
        for axis in axes:
            first, rest = _pressed(buttons[:1], {}, PRESSES[:1]), _pressed(buttons, {}, PRESSES[1:])
            yield [centred, *first, InputBlock(1, ((axis, 0.5),)), centred, *rest, over]
            pressed = _pressed(buttons, {})
            moved = [InputBlock(1, ((axis, -0.25),)), centred]
            yield [centred, *pressed[: 2 * stage], *moved, *pressed[2 * stage :], over]


def _pressed(buttons: Sequence[str], gaps: dict[int, int], presses: Sequence[int] = PRESSES) -> Blocks:
    """The presses, one step each; ``gaps`` are the steps from the press before, by number, else quick."""
    blocks: Blocks = []
    for number, press in enumerate(presses, 1):
        name = buttons[press]
        blocks += [
            InputBlock(1, ((name, True),)),
            InputBlock(max(1, gaps.get(number, QUICK) - 1), ((name, False),)),
        ]
    return blocks


def passing(env: Environment, sonars: Sequence[str], pairs: Sequence[tuple[int, int]]) -> Iterator[Blocks]:
    """An obstacle that the next sonar sees just when the wait for it ends, a few steps sooner, or later."""
    window = max(env.timers)
    for first, second in pairs:
        left, seen = f"d{first}", f"d{second}"
        for gap in range(window - 6, window + 1):
            yield [
                InputBlock(QUICK, ((left, 200),)),
                InputBlock(gap, ((left, 301),)),
                InputBlock(QUICK, ((seen, 200),)),
                InputBlock(30, tuple((sonar, 301) for sonar in sonars)),
                InputBlock(QUICK, (("yaw", Toward("B2.targetAngle", 0.0)),)),
            ]


def turning(sonars: Sequence[str]) -> Iterator[Blocks]:
    """A turn away from an obstacle across north, from either side, watched until it is made and beyond."""
    for (first, second), headings, ahead in (
        ((sonars[1], sonars[2]), (300, 330, 345, 359), -1),
        ((sonars[1], sonars[0]), (0, 15, 30, 60), 1),
    ):
        for heading in headings:
            yield [
                InputBlock(2, (("yaw", heading), *((sonar, 301) for sonar in sonars))),
                InputBlock(QUICK, ((first, 200),)),
                InputBlock(QUICK, ((first, 301),)),
                InputBlock(QUICK, ((second, 200),)),
                *(InputBlock(2, (("yaw", Toward("B2.targetAngle", ahead * off)),)) for off in (30, 15, 0)),
                InputBlock(QUICK, ((second, 301),)),
            ]


def recovering(env: Environment) -> Iterator[Blocks]:
    """Sources slow for long enough, quick again for about the second of recovery, and silent for good."""
    for stamp in env.values.stamps:
        limits = env.values.aims.silences.get(stamp, ())
        if limits and limits[0] < 20:  # whose mean gap is watched
            slow = limits[-1]  # as rarely as is still tolerated
            for quick in range(min(SECOND) + 1, min(SECOND) + 16):
                yield [
                    InputBlock(6 * slow, ((stamp, Every((slow,))),)),
                    InputBlock(quick, ((stamp, Every()),)),
                    InputBlock(limits[-1] + 5, ((stamp, SILENT),)),
                    InputBlock(2 * max(SECOND), ((stamp, Every()),)),  # until it is sound again
                ]


def braking(
    drive: Sequence[tuple[str, Change]], rolling: Sequence[tuple[str, Change]], lost: str, wait: int
) -> Iterator[Blocks]:
    """A stop from motion with the link lost before: nobody measures whether the wheels stand."""
    for before in (1, 9, 20, 30, 40, 50):
        yield [
            InputBlock(4, (*drive, *rolling, (lost, Every()))),
            InputBlock(before, ((lost, SILENT),)),
            InputBlock(wait + 12, (("d2", 300),)),
            InputBlock(5, (("d2", 301),)),
            InputBlock(60, (*((name, 0) for name, _ in rolling), (lost, Every()))),
        ]


def rotating(speeds: Sequence[str], wheels: str, imu: str) -> Iterator[Blocks]:
    """Rotations by gyroscope and wheels that differ by nearly the limit of a window, or come nearly too late.

    In 3 s a difference of 5 degrees is that of 1.8168 rpm, in 100 ms one of 1 degree that of 10 degrees/s.
    """
    still = tuple((name, 0) for name in speeds)
    fresh: tuple[tuple[str, Change], ...] = ((wheels, Every()), (imu, Every()), ("gz_dps", 0), *still)
    front, _, rear, _ = speeds
    for one, other in ((1.816, 1.816), (1.816, 1.817), (1.817, 1.817), (7, 2), (1, 0)):
        yield [InputBlock(310, (*fresh, (front, one), (rear, other)))]
    for speed in (0, 0.004, 0.005, 0.006):
        yield [InputBlock(80, (*fresh, ("gz_dps", 10), (front, speed), (rear, speed)))]
    for speed, rate in ((80, 147), (-80, -147), (136, 249)):  # on the spot, as fast as can be told
        sides = zip(speeds, (speed, -speed, speed, -speed), strict=True)
        yield [InputBlock(310, (*fresh, *sides, ("gz_dps", rate)))]
    for gap in (4, 5, 6):
        for rate in (60, 250):
            yield [InputBlock(320, (*fresh, ("gz_dps", rate), (imu, Every((gap,)))))]
        yield [InputBlock(320, (*fresh, *((name, 60) for name in speeds[::2]), (wheels, Every((gap,)))))]


def resuming(
    drive: tuple[tuple[str, Change], ...], over: tuple[tuple[str, Change], ...], pause: int
) -> Iterator[Blocks]:
    """Driving, a pause for as long as it takes to give the motors back, and driving again."""
    for before in (QUICK, 2 * QUICK, 30):
        yield [InputBlock(before, drive), InputBlock(pause + QUICK, over), InputBlock(30, drive)]
