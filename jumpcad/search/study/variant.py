"""`Variant`: the input of one evaluation, a design and the values of the workshop that the search varies."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any

from jumpcad.design import Design
from jumpcad.workshop.varied import Value

NOTHING: Mapping[Any, Any] = MappingProxyType({})

Key = tuple[Value, ...]


@dataclass(frozen=True)
class Variant:
    """A design, and by dotted key the values in which its workshop differs from the study's."""

    design: Design
    workshop: Mapping[str, Value] = field(default_factory=dict)

    @classmethod
    def of(cls, one: "Design | Variant") -> "Variant":
        """Return a variant as it is, and a design in the study's workshop."""
        return one if isinstance(one, Variant) else cls(one)

    @cached_property
    def key(self) -> Key:
        """Values that identify it: the design's vector, then the workshop's values."""
        return (*self.design.to_vector(), *self.workshop.values())

    def value(self, name: str) -> Value:
        """Return the value of a parameter: of the design, or of the workshop."""
        found: Value = self.workshop[name] if name in self.workshop else getattr(self.design, name)
        return found

    def changed(self, values: Mapping[str, Value]) -> "Variant":
        """Return the variant with other values of some parameters; the design's are validated (`JumpcadError`)."""
        ours = {name: values.get(name, value) for name, value in self.workshop.items()}
        numbers = {name: float(value) for name, value in values.items() if name not in ours}
        return Variant(Design(**{**self.design.model_dump(), **numbers}), ours)
