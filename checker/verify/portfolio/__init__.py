"""The portfolio: which engines a question is put to, in which order, and what their answers make together."""

from rovercheck.checker.verify.portfolio.disagreement import Disagreement
from rovercheck.checker.verify.portfolio.question import Callbacks, Found, PortfolioQuestion, Prior
from rovercheck.checker.verify.portfolio.turns import answers, as_found

__all__ = ["Callbacks", "Disagreement", "Found", "PortfolioQuestion", "Prior", "answers", "as_found"]
