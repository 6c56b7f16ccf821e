"""What articles of the catalogue share: name, source, limits of figures; prices that ship (mm, g, N·m)."""

from collections.abc import Iterable
from functools import cache
from typing import Annotated, Any, Literal, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field
from pydantic_core import PydanticCustomError

from jumpcad.files import Contradiction, TomlTable, find_template, read_toml
from jumpcad.files.records import Name, Text

ESTIMATE = "estimate"
STEEL_G_CM3 = 7.85
"""Density of steel (EN 1991-1-1, table A.4: 77 to 78.5 kN/m³)."""


def _not_blank(text: str) -> str:
    if not text.strip():
        raise PydanticCustomError("value_error", "is empty: say where the figures come from")
    return text


def _ascending(volts: tuple[float, float]) -> tuple[float, float]:
    if volts[0] >= volts[1]:
        raise PydanticCustomError("value_error", "must be [lowest, highest] in volts")
    return volts


# Lower limits keep quotients finite: they are below the figures of any article.
Length = Annotated[float, Field(ge=0.01, le=500)]
Side = Annotated[float, Field(ge=0.5, le=500)]
Mass = Annotated[float, Field(ge=1e-3, le=5000)]
Positive = Annotated[float, Field(ge=1e-4, le=1e5)]
Volts = Annotated[tuple[Positive, Positive], Field(strict=False), AfterValidator(_ascending)]
"""The lowest and the highest permitted voltage."""
Euros = Annotated[float, Field(gt=0, le=1e4)]
Source = Annotated[Text, AfterValidator(_not_blank)]
Confidence = Literal["stated", "derived", "memory"]
"""Read in the source; computed from what a source states; or known without a source at hand: to be confirmed."""


class Article(TomlTable):
    """A part to buy; its name is that of its table."""

    name: Annotated[Name, Field(exclude=True)]
    source: Source

    def contradictions(self) -> Iterable[Contradiction]:
        """Return values that are allowed alone but not together."""
        return ()

    def _follows(self, instead_of: str = "", **values: float) -> None:
        """Set values that were not given and follow from others; what they take the place of is then forgotten."""
        for key, value in values.items():
            if key not in self.model_fields_set:
                self.__dict__.update({key: value} | dict.fromkeys(filter(None, [instead_of])))


AnyArticle = TypeVar("AnyArticle", bound=Article)


def _with_names(tables: Any) -> Any:
    """Return tables of articles, each with its key for a name."""
    if not isinstance(tables, dict):
        return tables
    return {key: {"name": key} | table if isinstance(table, dict) else table for key, table in tables.items()}


OwnParts = Annotated[dict[Name, AnyArticle], BeforeValidator(_with_names)]
"""Articles of one kind that a user adds, by name."""


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


@cache
def shipped_prices() -> Prices:
    """Return the prices that ship."""
    return Prices(**read_toml(find_template("hardware", "prices"))[0])
