"""Prices that ship: what a shop shows on a date, and estimates for the rest."""

from functools import cache
from typing import Annotated, Literal

from pydantic import Field

from jumpcad.files import TomlTable, find_template, read_toml
from jumpcad.files.records import Name, Text

Euros = Annotated[float, Field(gt=0, le=1e4)]


class Price(TomlTable):
    """Price of a pack, mostly of one piece; without a shop it is an estimate."""

    price: Euros
    pack: Annotated[int, Field(ge=1, le=1000)] = 1
    currency: Literal["EUR", "USD"] = "EUR"
    shop: Text = ""
    date: Text = ""


class Prices(TomlTable):
    """Prices by the beginnings of articles' names, of filament, and of a dollar."""

    eur_per_usd: Euros
    filament_eur_per_kg: Euros
    pieces: dict[Name, Price]

    def eur(self, article: str) -> tuple[float, str, int] | None:
        """Return the price of one piece (€), the shop with its date, or `estimate`, and how many are sold together."""
        ends = range(len(article), 0, -1)  # the longest beginning first
        found = next((self.pieces[article[:end]] for end in ends if article[:end] in self.pieces), None)
        if found is None:
            return None
        price = found.price / found.pack * (self.eur_per_usd if found.currency == "USD" else 1.0)
        return price, f"{found.shop}, {found.date}" if found.shop else ESTIMATE, found.pack


ESTIMATE = "estimate"


@cache
def shipped_prices() -> Prices:
    """Return the prices that ship."""
    return Prices(**read_toml(find_template("hardware", "prices"))[0])
