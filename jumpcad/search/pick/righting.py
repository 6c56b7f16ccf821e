"""How a search's winner rights itself, simulated: where `rights_itself` is required, whose figure is an estimate."""

from typing import Annotated

from pydantic import Field, TypeAdapter

from jumpcad.building import build
from jumpcad.errors import JumpcadError
from jumpcad.files import TomlTable
from jumpcad.landing.landing import land
from jumpcad.search.models import RIGHTS_ITSELF, PrintedModel, RobotModel
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Count, Phase, Trial

KEY = "righting"
"""Key under which a study remembers it."""
TRIES = 50
"""Drops in any attitude, and landings of own jumps; they take half a minute."""


class _Shares(TomlTable):
    tries: float
    drops: Annotated[float, Field(ge=0, le=1)]
    landings: Annotated[float, Field(ge=0, le=1)]


class _Righting(TomlTable):
    trial: tuple[Phase, Count, Count, Count]
    shares: _Shares


_KIND = TypeAdapter(_Righting)


def simulated_righting(model: RobotModel, store: StudyStore, winner: Trial | None) -> dict[str, float]:
    """Return the shares of drops and of own landings after which the winner stands, and keep them in the study.

    Empty where nobody asked, or there is no winner or no MuJoCo.
    """
    if winner is None or not isinstance(model, PrintedModel) or not model.requires(RIGHTS_ITSELF):
        return {}
    if kept := kept_righting(store, winner):
        return kept
    try:
        varied = model.varied(winner.workshop) if winner.workshop else model
        found = land(build(winner.design, varied.workshop, name=""), TRIES, settings=model.settings)
    except JumpcadError as error:
        store.note_once(f"{RIGHTS_ITSELF}: not simulated: {error}")
        return {}
    shares = {"tries": float(TRIES), "drops": found.drops_righted, "landings": found.share_righted}
    store.remember(KEY, {"trial": list(winner.position), "shares": shares})
    return shares


def kept_righting(store: StudyStore, winner: Trial | None) -> dict[str, float]:
    """Return what a study keeps of the righting of this winner; empty where it was not simulated."""
    kept = store.recall(KEY, None, _KIND)
    if kept is None or winner is None or kept["trial"] != list(winner.position):
        return {}
    return dict(kept["shares"])
