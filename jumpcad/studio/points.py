"""The designs of a study that the studio opens: every trial by its number, the best ones and the front in a list."""

from functools import cached_property
from pathlib import Path

from jumpcad.building import build
from jumpcad.errors import CannotBuildError, JumpcadError
from jumpcad.search.fronts import described_cost, front
from jumpcad.search.models import PrintedModel
from jumpcad.search.study.objective import described_objective
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.trial import Trial, feasible_trials, searched, trial_numbers
from jumpcad.workshop import Workshop, load_workshop

STUDYS = "of the study"
"""The workshop of a point, in the studio's list of workshops."""
BEST = 10
"""Number of best trials in the list."""


class Points:
    """The trials of a study file, numbered from 1 in the order of the study, as `jumpcad study --export` lists them."""

    def __init__(self, file: Path) -> None:
        self.file = file
        with StudyStore.read(file) as store:
            self.trials, identity = store.trials(), store.identity
        if not self.trials:
            raise JumpcadError(f"{file}: this study has no trial yet")
        self._unit, self._cost = described_objective(identity).unit, described_cost(identity)
        self._held = identity["model"].get("workshop")
        self._numbers = trial_numbers(self.trials)

    @cached_property
    def workshop(self) -> Workshop:
        """The workshop of the study; the default for robots that are made in none."""
        if self._held is None:
            return load_workshop()
        try:
            return Workshop(**self._held)
        except JumpcadError as error:
            raise JumpcadError(f"{self.file}: its workshop cannot be used: {error}") from None

    @cached_property
    def listed(self) -> dict[str, int]:
        """Numbers of the best trials and of the front, by what a list says of them; the best one is the first."""
        proposed = searched(self.trials)
        cost, unit = self._cost, self._cost.figure.unit
        words = [(f"best {place}", trial) for place, trial in enumerate(feasible_trials(proposed)[:BEST], start=1)]
        words += [(f"front, {cost.shown(cost.of(one)):.4g} {unit}", one) for one in front(proposed, cost)]
        numbers = [(word, trial, self._numbers[trial.position]) for word, trial in words]
        return {f"{word}: {self._score(trial)} (trial {number})": number for word, trial, number in numbers}

    def listed_as(self, number: int, otherwise: str) -> str:
        """Return what the list first says of a trial."""
        return next((text for text, listed in self.listed.items() if listed == number), otherwise)

    @property
    def best(self) -> int:
        if not self.listed:
            raise JumpcadError(f"{self.file}: no design of this study jumps; --trial N opens one that does not")
        return next(iter(self.listed.values()))

    def trial(self, number: int) -> Trial:
        if not 1 <= number <= len(self.trials):
            raise JumpcadError(f"{self.file}: has no trial {number}: its trials are 1 to {len(self.trials)}")
        return self.trials[number - 1]

    def workshop_of(self, trial: Trial) -> Workshop:
        if not trial.workshop:
            return self.workshop
        return PrintedModel(workshop=self.workshop).varied(trial.workshop).workshop or self.workshop

    def require_built(self, number: int) -> None:
        """Reject a trial whose robot cannot be built."""
        trial = self.trial(number)
        try:
            build(trial.design, self.workshop_of(trial), self.file.stem)
        except CannotBuildError as error:
            raise JumpcadError(f"{self.file}: trial {number} cannot be built: {error}") from None

    def to_text(self, number: int) -> str:
        """Return number, score and place of a trial in words."""
        trial = self.trial(number)
        outcome = self._score(trial) if trial.score is not None else f"rejected: {' '.join(trial.evaluation.reasons)}"
        return f"trial {number} of {len(self.trials)} ({trial.phase} {trial.step}.{trial.place}): {outcome}"

    def _score(self, trial: Trial) -> str:
        return f"{trial.score:.4g} {self._unit}"
