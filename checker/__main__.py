"""The program ``rovercheck``, also as ``python -m checker``; it understands Ctrl-C from the first moment."""

import sys


def main() -> None:
    """Run the command line; loading it takes a while, in which Ctrl-C ends the program as it does later."""
    try:
        from checker.cli import main as run
    except KeyboardInterrupt:
        sys.stderr.write("Interrupted; nothing was written.\n")
        sys.exit(130)
    run()


if __name__ == "__main__":
    main()
