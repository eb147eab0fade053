"""The program ``rovercheck``, also as ``python -m rovercheck``; signals end it from the first moment on."""

import signal
import sys


def main() -> None:
    """Run the command line; loading it takes a while, in which it can be ended as it can later."""
    _stop_as_on_ctrl_c()
    try:
        from rovercheck.checker.cli import main as run
    except KeyboardInterrupt:
        sys.stderr.write("Interrupted; nothing was written.\n")
        sys.exit(130)
    run()


def _stop_as_on_ctrl_c() -> None:
    """When told to end, or left by the terminal, say what was found and leave no search behind."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:  # not under nohup
            signal.signal(number, signal.default_int_handler)


if __name__ == "__main__":
    main()
