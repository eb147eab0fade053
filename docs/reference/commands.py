"""The command line reference, from the help that the program itself prints."""

import click

from rovercheck.checker.cli import app

HEAD = """# Command line

What `rovercheck COMMAND --help` says, for every command. [Exit codes](exit-codes.md) are the same for all.

| Command | Does |
|---|---|
"""


def page() -> str:
    """Every verb with its options, as Markdown."""
    verbs = [app.commands[name] for name in sorted(app.commands)]
    rows = "".join(
        f"| [`{v.name}`](#{v.name}) | {v.get_short_help_str(200)} |\n" for v in verbs if not v.hidden
    )
    return HEAD + rows + "".join(_verb(verb) for verb in verbs if not verb.hidden)


def _verb(verb: click.Command) -> str:
    above = click.Context(app, info_name="rovercheck", **app.context_settings)
    context = click.Context(verb, info_name=verb.name, parent=above)
    usage = " ".join(verb.collect_usage_pieces(context))
    options = [record for p in _options(verb, context) if (record := p.get_help_record(context))]
    rows = "".join(f"| `{_cell(name)}` | {_cell(text)} |\n" for name, text in options)
    return (
        f"\n## {verb.name}\n\n{_prose(verb.help)}\n\n```text\n{context.command_path} {usage}\n```\n\n"
        f"| Option | Means |\n|---|---|\n{rows}\n{_prose(verb.epilog)}\n"
    )


def _options(verb: click.Command, context: click.Context) -> list[click.Option]:
    return [param for param in verb.get_params(context) if isinstance(param, click.Option)]


def _prose(text: str | None) -> str:
    r"""Paragraphs; what follows the mark ``\b`` keeps its lines, as it does in the terminal."""
    paragraphs = (text or "").split("\n\n")
    return "\n\n".join(_kept(p) if p.strip().startswith("\b") else p for p in paragraphs)


def _kept(paragraph: str) -> str:
    head, *lines = [line for line in paragraph.splitlines() if line.strip() not in ("", "\b")]
    if not lines:
        return f"```console\n{head.strip()}\n```"
    code = "\n".join(line.strip() for line in lines)
    return f"{head.strip()}\n\n```console\n{code}\n```"


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")  # as in the other pages: see the hooks
