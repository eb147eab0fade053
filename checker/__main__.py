"""``python -m checker`` is ``rovercheck``."""

from checker.cli import main

if __name__ == "__main__":
    main()
