"""The portfolio: which engines a question is put to, in which order, and what their answers make together."""

from rovercheck.checker.verify.portfolio.disagreement import Disagreement
from rovercheck.checker.verify.portfolio.question import Callbacks, Found, Hint, PortfolioQuestion
from rovercheck.checker.verify.portfolio.turns import answers, as_found

__all__ = ["Callbacks", "Disagreement", "Found", "Hint", "PortfolioQuestion", "answers", "as_found"]
