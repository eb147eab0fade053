"""The verb ``completion``: what makes the shell complete verbs, options and the names of the model."""

import click

from rovercheck.checker.commands.shared.codes import Exit

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_ROVERCHECK_COMPLETE"
"""Set by what the shell runs at the tabulator."""

EXAMPLES = """\b
Examples:
  eval "$(rovercheck completion bash)"      in ~/.bashrc
  eval "$(rovercheck completion zsh)"       in ~/.zshrc
  rovercheck completion fish > ~/.config/fish/completions/rovercheck.fish
"""


@click.command(short_help="Print what lets the shell complete names.", epilog=EXAMPLES)
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def completion(context: click.Context, shell: str) -> Exit:
    """Print the script that lets SHELL complete verbs, options, properties, systems, charts and formats."""
    from click.shell_completion import get_completion_class

    from rovercheck.checker.commands.shared.output import write

    made = get_completion_class(shell)
    assert made is not None, "click knows these shells"
    write(made(context.find_root().command, {}, "rovercheck", VARIABLE).source(), None)
    return Exit.AS_EXPECTED
