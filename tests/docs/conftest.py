"""The site in the browser of the tests of pages."""

from tests.browser.conftest import page

__all__ = ["page"]
