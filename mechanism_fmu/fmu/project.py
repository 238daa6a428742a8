"""What the project says of itself: in its checkout if this is one, else as an installed distribution."""

from __future__ import annotations

import tomllib
from importlib import metadata
from pathlib import Path

_CHECKOUT = Path(__file__).parents[2]
_PROJECT = _CHECKOUT / "pyproject.toml"


def dependencies() -> list[str]:
    """Requirements of the library, with their pins, e.g. "numpy>=2.0"; the same from a checkout and when installed."""
    if _PROJECT.is_file():
        pins: list[str] = tomllib.loads(_PROJECT.read_text(encoding="utf-8"))["project"]["dependencies"]
    else:
        pins = [pin for pin in metadata.requires("mechanism_fmu") or [] if "extra ==" not in pin]
    return [_in_order(pin) for pin in pins]


def _in_order(pin: str) -> str:
    """A requirement with its limits sorted: installers write them in an order of their own."""
    name = pin[: min((pin.index(sign) for sign in "<>=!~" if sign in pin), default=len(pin))]
    return name + ",".join(sorted(pin[len(name) :].split(",")))


def licence_text(distribution: str) -> str:
    """Text of the licence of an installed distribution, or of this project.

    Raises:
        FileNotFoundError: the distribution was installed without its licence.
    """
    if distribution == "mechanism_fmu" and _PROJECT.is_file():
        return (_CHECKOUT / "LICENSE").read_text(encoding="utf-8")
    text = metadata.distribution(distribution).read_text("licenses/LICENSE")
    if text is None:
        raise FileNotFoundError(f"The installed {distribution} has no licence file; install it again.")
    return text
