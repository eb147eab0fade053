"""The portfolio: which engines a question is put to, in which order, and what their answers make together."""

from checker.verify.portfolio.answers import answers, as_found
from checker.verify.portfolio.disagreement import Disagreement
from checker.verify.portfolio.question import Callbacks, Found, Hint, PortfolioQuestion

__all__ = ["Callbacks", "Disagreement", "Found", "Hint", "PortfolioQuestion", "answers", "as_found"]
