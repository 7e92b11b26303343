"""Numbers and names in messages and files."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal
from difflib import get_close_matches


def plain(value: float) -> str:
    """All digits of a number, without an exponent, as the FMU's own tool writes them."""
    return format(Decimal(repr(value)), "f").removesuffix(".0")


def short(value: float) -> str:
    """The same, with an exponent where it saves more than four characters."""
    sign, digits, exponent = Decimal(repr(value)).normalize().as_tuple()
    if not isinstance(exponent, int):
        return repr(value)
    first, *rest = map(str, digits)
    power = f"{'-' * sign}{first}{'.' * bool(rest)}{''.join(rest)}e{exponent + len(rest)}"
    return power if len(plain(value)) > len(power) + 4 else plain(value)


def suggest(name: str, known: Iterable[str]) -> str:
    """The nearest names, or all of them."""
    known = list(known)
    near = get_close_matches(name, known)
    return f"did you mean {' or '.join(near)}?" if near else f"choose from {', '.join(known)}"
