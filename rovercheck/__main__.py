"""The program ``rovercheck``, also as ``python -m rovercheck``, wherever it is started."""

from rovercheck import claim


def main() -> None:
    """Run the command line with our own packages."""
    claim()
    from checker.__main__ import main as run

    run()


if __name__ == "__main__":
    main()
