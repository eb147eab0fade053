"""``rovercheck robustness``: what an implementation does with inputs that no model admits."""

from collections.abc import Iterator
from pathlib import Path
from shlex import quote

from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.checker.commands.robustness import RobustnessOptions
from rovercheck.checker.commands.robustness.document import document, shown
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, text_width, write
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.text_wrap import filled, whole
from rovercheck.checker.commands.shared.variant import pick_variant
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.robustness.odd_inputs import odd_runs, told
from rovercheck.checker.robustness.replay import HostileImplementation, file_of, opened, replay_test
from rovercheck.checker.robustness.rules import RobustnessRules, read_rules
from rovercheck.checker.robustness.search import RobustnessFinding, RobustnessResult, RobustnessSearch
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.errors import did_you_mean

MOST_STEPS = 12
"""Steps of a finding that are told; its test has all."""


def robustness(options: RobustnessOptions) -> Exit:
    """Try odd inputs on an implementation, and tell what does not hold.

    Raises ``UsageError`` for a board that does not exist and an implementation that cannot be started,
    ``ModelError`` for rules without meaning.
    """
    board = _board(options)
    rules = read_rules(options.rules, board) if options.rules is not None else RobustnessRules()
    tell = _silent if options.as_json else _told
    tell(f"{board.name}: {options.impl}")
    try:
        with opened(options.impl, board, rules, sanitize=not options.no_sanitizers) as hostile:
            watched = _sanitized(hostile, options)
            tell(f"  {watched}")
            search = RobustnessSearch(board, hostile.implementation, rules, hostile.logs)
            with ProgressLine() as line:
                result = search.run(
                    odd_runs(board, rules.nonsense, options.runs, options.seed),
                    lambda r: line.show(f"{board.name}: run {r.runs} | {len(r.findings)} findings"),
                )
    except ImplementationError as error:
        raise UsageError(str(error)) from error
    files = _written(result, options, rules)
    for number, one in enumerate(result.findings, 1):
        tell("\n".join(["", *_finding(number, one, result), *_file(files.get(number))]))
    tell("\n" + _summary(result))
    code = _code(result)
    if options.as_json:
        print(json_text(document(result, options.impl, watched, files, code), ascii=True))
    return code


def _told(text: str) -> None:
    out.print(text, markup=False)


def _silent(_: str) -> None:
    """JSON says it."""


def _code(result: RobustnessResult) -> Exit:
    if result.findings:
        return Exit.FAILED
    if result.interrupted:
        return Exit.INTERRUPTED
    return Exit.AS_EXPECTED if result.compared else Exit.INCONCLUSIVE


def _board(options: RobustnessOptions) -> Board:
    if options.model is not None:
        own = pick_variant((), None, (), options.model).own
        assert own is not None
        return of_model(own, options.system)
    known = boards()
    if options.system is None:
        raise UsageError("Of which board is it? Write --system board1 or board2, or --model FILE.")
    if options.system not in known:
        raise UsageError(f"No board {options.system!r}. {did_you_mean(options.system, known)}")
    return known[options.system]


def _sanitized(hostile: HostileImplementation, options: RobustnessOptions) -> str:
    if hostile.sanitized.flags:
        return "compiled with AddressSanitizer and UndefinedBehaviorSanitizer"
    if not options.impl.startswith("c:"):
        return "no C, so that no sanitizers watch it"
    missing = hostile.sanitized.missing
    return f"without sanitizers ({missing}): overflows and accesses out of bounds may go unseen"


def _written(result: RobustnessResult, options: RobustnessOptions, rules: RobustnessRules) -> dict[int, Path]:
    """A test of each finding, if they are wanted."""
    if options.output is None:
        return {}
    try:
        options.output.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        place = whole(options.output)
        raise UsageError(f"Cannot make {place}: {error.strerror}. Choose another --output.") from error
    found = {}
    for number, one in enumerate(result.findings, 1):
        found[number] = options.output / file_of(one, result.board)
        write(replay_test(one, result.board, options.impl, rules), found[number])
    return found


def _finding(number: int, one: RobustnessFinding, result: RobustnessResult) -> Iterator[str]:
    runs = result.met[one.breach.kind, one.breach.where]
    text = f"{number}. ✗ {one.breach.kind} in step {one.breach.step}: {one.breach.says}"
    yield filled(text, text_width(), "", "   ")
    yield f"   in {counted(runs, 'run', 'runs')}, first: {one.origin}"
    steps = list(told(result.board, one.inputs))
    for step, changed in steps[:MOST_STEPS]:
        values = ", ".join(f"{name} = {shown(result.board, name, value)}" for name, value in changed.items())
        yield filled(f"     step {step:>3}  {values}", text_width(), "", "               ")
    if len(steps) > MOST_STEPS:
        yield f"     ... and {len(steps) - MOST_STEPS} more steps, in the test"
    if not steps:
        yield "     with every input at rest"


def _file(file: Path | None) -> list[str]:
    return [f"   pytest {quote(str(file))}"] if file is not None else []


def _summary(result: RobustnessResult) -> str:
    tried = f"{counted(result.runs, 'run', 'runs')}, {counted(result.steps, 'step', 'steps')}"
    stopped = ", interrupted" if result.interrupted else ""
    if result.findings:
        found = counted(len(result.findings), "finding", "findings")
        return f"✗ {result.board.name}: {found} in {tried}{stopped}."
    return f"✓ {result.board.name}: all that must hold held in {tried}{stopped}."
