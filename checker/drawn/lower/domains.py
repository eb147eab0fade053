"""The file of domains beside a model: what no file of Simulink says of its inputs and data.

```toml
beside = ["parameters.m"]        # further files that the model uses
free = ["Plant/Lag", "sin"]      # blocks, functions and expressions whose values are free inputs
step = 0.1                       # seconds, where the model does not say it

[domains]
"probe.level" = { low = 0, high = 30, resolution = 0.25 }
mode = { values = [0, 1, 7] }
axis = { low = -1, high = 1, resolution = "1/255" }
```
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

from rovercheck.checker.io.toml_lines import line_of
from rovercheck.spec_model.lang.domain import Domain, chosen, fixed
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean
from rovercheck.spec_model.lang.place import Place

KEYS = ("beside", "domains", "free", "step")
PARTS = ("low", "high", "resolution", "values", "unit")


@dataclass(frozen=True)
class DomainsFile:
    """What a file of domains says; ``path`` is where it would be, if there is none."""

    path: Path
    domains: Mapping[str, Domain] = field(default_factory=dict)
    beside: tuple[Path, ...] = ()
    step: str = ""
    free: tuple[str, ...] = ()


def domains_path(model: Path) -> Path:
    """Where the domains of a model are: ``NAME.domains.toml`` beside it."""
    return model.with_name(f"{model.stem}.domains.toml")


def read_domains(path: Path) -> DomainsFile:
    """What a file says; nothing if there is none.  Raises ``ModelError`` with the line of what is wrong."""
    if not path.exists():
        return DomainsFile(path)
    try:
        text = path.read_text(encoding="utf-8")
        told = tomllib.loads(text, parse_float=Decimal)
    except OSError as error:
        raise ModelError(f"{path}: {error.strerror}.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ModelError(f"{path}: this is no TOML: {error}") from error
    faults = [f"{path}: {key} means nothing. {did_you_mean(key, KEYS)}" for key in told if key not in KEYS]
    given = told.get("domains", {})
    domains = {}
    if not isinstance(given, dict):
        faults.append(f"{path}: `domains` is a table; write [domains], and below it a line for each datum.")
        given = {}
    for name, one in given.items():
        try:
            domains[name] = _domain(one)
        except ModelError as error:
            faults.append(f"{Place(str(path), line_of(text, ('domains', name)) or 1)}: {name}: {error}")
    beside = told.get("beside", [])
    if not isinstance(beside, list) or not all(isinstance(one, str) for one in beside):
        faults.append(f'{path}: `beside` is a list of files, as in beside = ["types.sldd"].')
        beside = []
    free = told.get("free", [])
    if not isinstance(free, list) or not all(isinstance(one, str) for one in free):
        faults.append(
            f"{path}: `free` is a list of blocks, by their paths, functions and expressions, as in "
            'free = ["Plant/Lag", "sin"].'
        )
        free = []
    step = told.get("step", "")
    if isinstance(step, bool) or not isinstance(step, int | Decimal | str):
        faults.append(f"{path}: `step` is a number of seconds, as in step = 0.02.")
    if faults:
        raise ModelError("\n".join(faults))
    files = tuple(path.parent / one for one in beside)
    return DomainsFile(path, domains, files, str(step), tuple(dict.fromkeys(free)))


def _domain(told: object) -> Domain:
    """One domain.  Raises ``ModelError``."""
    how = "write { low = 0, high = 10, resolution = 0.5 }, or { values = [0, 1, 7] }"
    if not isinstance(told, dict):
        raise ModelError(f"{brief(told)} is no domain; {how}.")
    for key in told:
        if key not in PARTS:
            raise ModelError(f"{key} means nothing. {did_you_mean(key, PARTS)}")
    unit = told.get("unit", "")
    if "values" in told:
        values = told["values"]
        if not isinstance(values, list) or not values or not all(map(_is_number, values)):
            raise ModelError(f"values = {brief(values)}: write a list of numbers, at least one.")
        return chosen([Fraction(one) for one in values], unit)
    if "low" not in told or "high" not in told:
        raise ModelError(f"it has no ends; {how}.")
    for key in ("low", "high", "resolution"):
        if not _is_number(told.get(key, 1)):
            raise ModelError(f"{key} = {brief(told[key])} is no number.")
    return fixed(Fraction(told["low"]), Fraction(told["high"]), Fraction(told.get("resolution", 1)), unit)


def _is_number(value: object) -> bool:
    if isinstance(value, str):
        return bool(re.fullmatch(r"-?[0-9]+/0*[1-9][0-9]*", value))
    return isinstance(value, int | Decimal) and not isinstance(value, bool)


def _toml_number(value: Fraction) -> str:
    """A number as TOML has it; a fraction that no decimal is as a text."""
    if value.denominator == 1:
        return str(value.numerator)
    shown = repr(float(value))
    return shown if Fraction(shown) == value else f'"{value}"'


def _toml_key(name: str) -> str:
    """A name as a key of TOML, in quotes where it needs them."""
    plain = name.replace("_", "").replace("-", "")
    if plain.isascii() and plain.isalnum():
        return name
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'


def lines_of(domains: Mapping[str, Domain]) -> Iterator[str]:
    """Domains as lines of such a file."""
    for name, one in domains.items():
        resolution = getattr(one.sort, "resolution", Fraction(1))
        if one.dense:
            ends = f"low = {_toml_number(one.low * resolution)}, high = {_toml_number(one.high * resolution)}"
            step = "" if resolution == 1 else f", resolution = {_toml_number(resolution)}"
            yield f"{_toml_key(name)} = {{ {ends}{step} }}"
        else:
            values = ", ".join(_toml_number(raw * resolution) for raw in one.values)
            yield f"{_toml_key(name)} = {{ values = [{values}] }}"


__all__ = ["DomainsFile", "domains_path", "lines_of", "read_domains"]
