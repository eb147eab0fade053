"""What may be installed besides: each extra, what it adds, and the words when it is missing."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec


@dataclass(frozen=True)
class Extra:
    """A part of rovercheck that not everybody needs: what pip calls it, and the one package that it brings.

    ``module`` is what that package is imported as, ``adds`` what rovercheck does with it.
    """

    name: str
    package: str
    module: str
    adds: str

    @property
    def installed(self) -> bool:
        """Whether its package can be imported; nothing is."""
        return find_spec(self.module) is not None

    @property
    def command(self) -> str:
        """What installs it, beside the rovercheck that is there."""
        return f"pip install 'rovercheck[{self.name}]'"

    def needed(self, what: str) -> str:
        """What is said where it is missing: ``what`` names what was asked for."""
        return f"{what} needs {self.package}, which is not installed: {self.command}"


CERTIFICATES = Extra(
    "certificates", "bitwuzla", "bitwuzla", "the solver of certify and --certify, which checks proofs again"
)
PLOT = Extra("plot", "matplotlib", "matplotlib", "plots of simulate")
PARQUET = Extra("parquet", "pyarrow", "pyarrow", "Parquet logs in check-log")
FIRMWARE = Extra("firmware", "tree-sitter-c", "tree_sitter_c", "map init, which reads sources in C")
CLUSTER = Extra("cluster", "distributed", "distributed", "--scheduler, which searches on other machines")

EXTRAS: Mapping[str, Extra] = {one.name: one for one in (CERTIFICATES, PLOT, PARQUET, FIRMWARE, CLUSTER)}
"""All of them by name; ``rovercheck[all]`` brings them together (``pyproject.toml``)."""
