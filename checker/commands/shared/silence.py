"""Whether the command that runs now was told, with ``--quiet``, to say nothing but what it finds."""

import click

_UNWANTED = "rovercheck.quiet"


def silence(context: click.Context, _: click.Parameter, quiet: bool) -> None:
    """Say nothing meanwhile, in the command that runs now; what ``--quiet`` of most verbs does."""
    context.meta[_UNWANTED] = quiet


def silent() -> bool:
    """Whether the command that runs now was told to say nothing meanwhile."""
    context = click.get_current_context(silent=True)
    return context is not None and bool(context.meta.get(_UNWANTED))
