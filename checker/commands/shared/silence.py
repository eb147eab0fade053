"""Whether the command that runs now was told to say nothing but what it finds, or more than usual."""

import click

_UNWANTED, _MORE = "rovercheck.quiet", "rovercheck.verbose"


def silence(context: click.Context, _: click.Parameter, quiet: bool) -> None:
    """Say nothing meanwhile, in the command that runs now; what ``--quiet`` of most verbs does."""
    context.meta[_UNWANTED] = quiet


def silent() -> bool:
    """Whether the command that runs now was told to say nothing meanwhile."""
    context = click.get_current_context(silent=True)
    return context is not None and bool(context.meta.get(_UNWANTED))


def say_more(context: click.Context, _: click.Parameter, verbose: bool) -> bool:
    """Say more than usual, in the command that runs now; what ``--verbose`` does."""
    context.meta[_MORE] = verbose
    return verbose


def talkative() -> bool:
    """Whether the command that runs now was told to say more than usual."""
    context = click.get_current_context(silent=True)
    return context is not None and bool(context.meta.get(_MORE))
