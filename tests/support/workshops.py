"""Workshops with some of their values changed."""

from typing import Any

from jumpcad.workshop import Workshop, load_workshop


def workshop_with(workshop: Workshop | None = None, /, **sections: dict[str, Any]) -> Workshop:
    """Return a workshop, the default one if none is given, with some values of some sections changed, unchecked."""
    workshop = workshop or load_workshop("default")
    parts = {name: getattr(workshop, name).model_copy(update=values) for name, values in sections.items()}
    return workshop.model_copy(update=parts)
