"""The portfolio: which engines a question is put to, in which order, and what their answers make together."""

from checker.verify.portfolio.answers import answers, as_found
from checker.verify.portfolio.disagreement import Disagreement
from checker.verify.portfolio.question import Found, Hint, Question, Told

__all__ = ["Disagreement", "Found", "Hint", "Question", "Told", "answers", "as_found"]
