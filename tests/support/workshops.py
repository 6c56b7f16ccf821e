"""The default workshop with some of its values changed."""

from typing import Any

from jumpcad.workshop import Workshop, load_workshop


def changed(**sections: dict[str, Any]) -> Workshop:
    """Return the default workshop with some values of some sections changed, which are not checked."""
    workshop = load_workshop("default")
    parts = {name: getattr(workshop, name).model_copy(update=values) for name, values in sections.items()}
    return workshop.model_copy(update=parts)
