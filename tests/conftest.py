"""Settings of the whole test suite: how Hypothesis draws.

``ci``, the default, draws the same examples in every run and keeps nothing on disk.  ``nightly``
(``pytest --hypothesis-profile=nightly``) draws new ones, many more, and remembers what failed.
"""

import os

from hypothesis import HealthCheck, settings

os.environ["ROVERCHECK_CACHE"] = ""  # what is tested is compiled anew

settings.register_profile(
    "ci",
    derandomize=True,
    deadline=None,
    database=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile(
    "nightly",
    max_examples=2000,
    deadline=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("ci")
