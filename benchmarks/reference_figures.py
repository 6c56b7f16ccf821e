"""The page of all figures of a jump."""

from reference_page import page, table

from jumpcad.dimensions import unit_of_key
from jumpcad.evaluation import FIGURES
from jumpcad.search.models import MODELS, robot_model


def figures() -> str:
    """Return the page of the figures that a search knows, with their units and the robots that have them."""
    has = {model: set(robot_model(model).figure_names) for model in MODELS}
    rows = [
        (f"`{name}`", unit_of_key(name), words, ", ".join(model for model in MODELS if name in has[model]))
        for name, words in FIGURES.items()
    ]
    words = (
        "The figures of a jump, by the names that `jumpcad optimize --require` and an own objective use; "
        "`jumpcad list figures` prints them. `--require` takes the names of [limits](checks.md) too: their margins. "
        "The published robot has `base_distance_m` and `base_height_m` besides."
    )
    return page("Figures", words, table(("figure", "unit", "meaning", "`--model`"), rows))
