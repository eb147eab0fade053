"""The site in the browser of the tests of pages."""

from tests.browser.conftest import browser, page

__all__ = ["browser", "page"]
