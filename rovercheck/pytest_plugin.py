"""The pytest plugin: each property of a model is a test; nothing is loaded unless a model is asked for.

``rovercheck_models`` in the configuration of pytest names models (files, folders, ``rover``);
``--rovercheck`` collects every ``*_model.py`` and ``model_*.py`` that pytest comes across.
"""

from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from rovercheck.checker.pytest_plugin.collect import Models

PATTERNS = ("*_model.py", "model_*.py")
WHOLE = "rovercheck_whole"
_models: pytest.StashKey["Models"] = pytest.StashKey()


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("rovercheck", "rovercheck: properties of charts as tests")
    group.addoption(
        "--rovercheck", action="store_true", help=f"Collect models too: files named {' or '.join(PATTERNS)}."
    )
    group.addoption("--rovercheck-timeout", type=float, metavar="SEC", help="Seconds per search.")
    group.addoption("--rovercheck-depth", type=int, metavar="N", help="Ticks to look ahead at most.")
    group.addoption("--rovercheck-engine", default="auto", metavar="NAME", help="Search with this engine.")
    group.addoption("--rovercheck-full", action="store_true", help="Also the properties that take long.")
    parser.addini(
        "rovercheck_models", "Models whose properties are tests: Python files, folders, or rover.", "args"
    )


def pytest_configure(config: pytest.Config) -> None:
    marker = "rovercheck(id, system, area): a property that a model checker decides."
    config.addinivalue_line("markers", marker)
    named, anywhere = config.getini("rovercheck_models"), config.getoption("rovercheck")
    if not named and not anywhere:
        return
    from rovercheck.checker.pytest_plugin.collect import models_of

    config.stash[_models] = models_of(config, named, PATTERNS if anywhere else ())


@pytest.hookimpl(optionalhook=True)
def pytest_configure_node(node: Any) -> None:
    """Tell a worker of xdist whether the command line names what to collect: its own always does."""
    node.workerinput[WHOLE] = whole(node.config)


def whole(config: pytest.Config) -> bool:
    """Whether pytest was started without naming files, so that all configured models are meant."""
    told = getattr(config, "workerinput", {})
    return bool(told.get(WHOLE, config.args_source is not pytest.Config.ArgsSource.ARGS))


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    models = parent.config.stash.get(_models, None)
    return None if models is None else models.met(file_path, parent)


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Add the configured models to what a session without named files collects."""
    report = yield
    models = collector.config.stash.get(_models, None)
    if models is not None and isinstance(collector, pytest.Session) and report.passed:
        report.result = [*(report.result or ()), *models.meant(collector)]
    return report
