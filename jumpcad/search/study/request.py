"""`Request`: what a study is asked for, and in which stages it is searched."""

import hashlib
import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_fields
from jumpcad.design import Design
from jumpcad.dimensions import counted
from jumpcad.errors import JumpcadError
from jumpcad.files import did_you_mean
from jumpcad.files.complaints import shown
from jumpcad.search import methods
from jumpcad.search.fronts import ELECTRICAL_ENERGY, SPRING_ENERGY, Cost, find_cost
from jumpcad.search.methods import FRONTS, METHODS, NAMES, PAPER, SEQUENCES, STAGES, Method
from jumpcad.search.models import COSTLY, PrintedModel, RobotModel
from jumpcad.search.space import Space, require_things
from jumpcad.search.study.code_hash import versions
from jumpcad.search.study.objective import Objective, find_objective
from jumpcad.search.study.trial import Trial
from jumpcad.search.study.variant import Variant
from jumpcad.workshop import load_workshop

MOST_EVALUATIONS = 1_000_000
"""About a day of one core, at 80 ms an evaluation (docs/speed.md)."""
MOST_FIRST = 50
"""Most evaluations of the first of two methods: with 190 of 240, the second found the best design in 10 (measured)."""
LEARNING_VERSIONS = ("scipy", "scikit-learn", "pygad")
"""Packages that decide what is proposed next, in addition to those that decide an evaluation."""


@dataclass(frozen=True, repr=False)
class Request:
    """What a study is asked for, as by `jumpcad.optimize`; the model computes what method and objective need."""

    space: Space
    model: RobotModel
    objective: str | Callable[..., Any] | Objective | None = None
    method: str = methods.DEFAULT
    evaluations: int = methods.EVALUATIONS
    seed: int = 0
    preset: str = "recommended"
    batch: int = 1
    prior: Path | None = None
    until_percent: float = methods.UNTIL_PERCENT
    hours: float = 0.0
    screen: bool = False
    against: str | None = None
    start: Sequence[Design] = ()
    around: Design | None = None
    cold: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        for name, kind, known in ((self.preset, "presets", methods.PRESETS), (self.method, "methods", NAMES)):
            if name not in known:
                hint = did_you_mean(name, known)
                raise JumpcadError(f"{name!r} is not one of the {kind} {', '.join(known)}{hint}")
        if self.against is not None and not self.is_front:
            raise JumpcadError(f"against: does not apply to {self.method}, only to {', '.join(FRONTS)}")
        aim = self.objective
        if not isinstance(aim, Objective):
            usual = "range" if self.is_front else self.model.default_objective
            aim = find_objective(usual if aim is None else aim)
            object.__setattr__(self, "objective", aim)
        of_workshop = {one.name: one for one in self.space.of_workshop}
        if isinstance(self.model, PrintedModel):
            learns = self.model.stand_in or self.screen or self.method not in ("ga", "nsga2")
            scored = tuple(name for name in COSTLY if aim.uses(name, self.model.figure_names))
            object.__setattr__(self, "model", replace(self.model, stand_in=learns, scored=scored))
            required = [one.name for one in self.model.requirements]
            require_things(self.model.workshop or load_workshop(), of_workshop, required, surely=True)
        for name, value, least, most in (
            ("evaluations", self.evaluations, 1, MOST_EVALUATIONS),
            ("batch", self.batch, 1, MOST_EVALUATIONS),
            ("until_percent", self.until_percent, 0, 100),
            ("hours", self.hours, 0, 1e6),
        ):
            if not least <= value <= most:  # nor is NaN
                limit = f"most {most}" if value > most else f"least {least}"
                raise JumpcadError(f"{name} = {shown(value)} must be at {limit}")
        self.aim.require(self.model.figure_names)
        if self.is_front and self.cost.of_design is None:
            self.cost.figure.require(self.model.figure_names, "against")
        if self.is_front and self.cost.figure is self.aim:
            raise JumpcadError(f"against = {self.against!r} is the objective itself: name another figure")
        if self.is_front and self.cost is SPRING_ENERGY and "bought.spring" in of_workshop:
            raise JumpcadError("bought.spring: a front against spring energy takes springs made to order; leave it out")
        for name, takes in TAKE.items():
            value = getattr(self, name)
            if value not in (getattr(Request, name), 0.0) and not takes(_methods(self.method)):
                takers = ", ".join(other for other in NAMES if takes(_methods(other)))
                raise JumpcadError(f"{name} = {shown(value)}: does not apply to {self.method}, only to {takers}")
        if (self.screen or self.cold) and not isinstance(self.model, PrintedModel):
            raise JumpcadError(f"{'screen' if self.screen else 'cold'}: applies to the printed robot; leave it out")
        if self.screen and (of_workshop or (self.model.workshop and self.model.workshop.bought.spring)):
            raise JumpcadError("screen: applies to one workshop with springs made to order; leave it out")
        for one in self._begun(self.start):
            if outside := self.space.outside(one):
                raise JumpcadError(
                    f"start: {outside} is outside of the search: widen it by a bound, or leave the design out"
                )
        if len(self.first) > self.searched:
            raise JumpcadError(
                f"evaluations = {self.evaluations} leave {self.searched} for the search, which begins with "
                f"{len(self.first)} designs: ask for more"
            )
        for stage in plan_stages(self):
            if stage.evaluations < (least := STAGES[stage.method].least):
                raise JumpcadError(
                    f"evaluations = {self.evaluations} leave {stage.evaluations} for {stage.method}, whose parts take "
                    f"{least} at least: ask for more"
                )

    def __repr__(self) -> str:
        evaluations, free = counted(self.evaluations, "evaluation"), counted(self.space.dimension, "parameter free")
        return f"<Request {self.title}: {evaluations}, {free}>"

    @property
    def title(self) -> str:
        """Method, robot and objective in words."""
        against = f" against {self.cost.name}" if self.is_front else ""
        return f"{self.method} on the {self.model.name} robot, {self.aim.name}{against}"

    @property
    def pick(self) -> int:
        """How many of the evaluations examine neighbours of the best designs, and, but for a front, their bounds."""
        share = min(self.evaluations // 4, methods.MOST_PICK)
        return share if share >= methods.LEAST_PICK else 0

    @property
    def first(self) -> tuple[Variant, ...]:
        """What is evaluated first: the design that the space is around, if it lies in it, and those to begin with."""
        around = () if self.around is None or self.left_out else (self.around,)
        return tuple({one.key: one for one in self._begun((*around, *self.start))}.values())

    @property
    def left_out(self) -> str:
        """Why the design that the space is around is not evaluated; mostly nothing."""
        outside = self.around and self.space.outside(self.space.begun(self.around, self.model.workshop))
        return f"around: {outside} is outside of the search, so that design is not evaluated" if outside else ""

    def _begun(self, designs: Iterable[Design]) -> list[Variant]:
        return [self.space.begun(one, self.model.workshop) for one in designs]

    @property
    def searched(self) -> int:
        """How many of the evaluations the search has."""
        return self.evaluations - self.pick

    @property
    def estimated(self) -> bool:
        """Whether proposals are tried on estimated robots: of printed robots, in one workshop."""
        return isinstance(self.model, PrintedModel) and not self.space.varies_workshop

    @property
    def aim(self) -> Objective:
        assert isinstance(self.objective, Objective)
        return self.objective

    @property
    def cost(self) -> Cost:
        """What a front weighs the objective against."""
        usual = ELECTRICAL_ENERGY if isinstance(self.model, PrintedModel) else SPRING_ENERGY
        return usual if self.against is None else find_cost(self.against)

    @property
    def is_front(self) -> bool:
        """Whether a front is searched, not one best design."""
        return self.method in FRONTS

    def identity(self, prior: Sequence[Trial]) -> dict[str, Any]:
        """Return all that decides the trials of the study, except their number."""
        learned = json.dumps([[trial.key, trial.score] for trial in prior])
        return {
            "model": self.model.describe(), **self.aim.describe(), **(self.cost.describe() if self.is_front else {}),
            "method": self.method, "space": self.space.describe(), "seed": self.seed, "preset": self.preset,
            "batch": self.batch,
            **({"screen": self.model.estimate_engine} if self.screen and isinstance(self.model, PrintedModel) else {}),
            "making": asdict(self.model.making),
            **({"start": [one.key for one in self.first]} if self.first else {}),
            **({"cold": True} if self.cold else {}),
            "prior": hashlib.sha256(learned.encode()).hexdigest() if prior else None,
            "versions": self.model.versions() | versions(*LEARNING_VERSIONS),
        }  # fmt: skip

    def default_name(self) -> str:
        """Return a file name that is the same for equal requests and different for others."""
        shared = self.method in SEQUENCES or METHODS[self.method].shares
        record = [self.identity([]), str(self.prior), self.evaluations if shared else 0]
        digest = hashlib.sha256(json.dumps(record, sort_keys=True).encode()).hexdigest()
        return f"study-{self.method.replace('+', '-')}-{digest[:8]}.db"


@dataclass(frozen=True)
class Stage:
    """One run of a method for a request, with at most so many new designs; it may run several times in a study.

    A method that learns spreads its `initial` designs evenly over the space, and ends where less than a share
    `least_gain` of the best score is gained; 0 for none.
    """

    request: Request
    method: str
    evaluations: int
    initial: int = 0
    run: int = 0
    least_gain: float = 0.0


def _methods(name: str) -> tuple[Method, ...]:
    """Return the methods that run one after the other under a name."""
    return tuple(METHODS[one] for one in SEQUENCES.get(name, (name,)))


TAKE: Mapping[str, Callable[[Sequence[Method]], bool]] = {
    "preset": lambda methods: any(method.name == "ga" for method in methods),
    "batch": lambda methods: any(method.learns for method in methods),
    "until_percent": lambda methods: methods[-1].ends,
    "screen": lambda methods: [method.name for method in methods] == ["ga"],
    "cold": lambda methods: methods[0].name not in (PAPER, "nsga2"),
}
"""Options that some methods take alone, and which."""


def default_initial(space: Space, evaluations: int, prior: int = 0, estimated: bool = False) -> int:
    """Return the number of first designs: three per free parameter, at most half of all, minus the prior trials.

    Half as many where scores are `estimated`: measured, with eight parameters 12 gave better designs after 30
    evaluations than 24 after 60.
    """
    each = 1.5 if estimated else 3.0
    return max(0, min(math.ceil(each * space.dimension), evaluations // 2) - prior)


def plan_stages(request: Request, prior: int = 0) -> list[Stage]:
    """Return the stages of a request that learns from `prior` earlier trials.

    Of a sequence, the first method gets a third of the evaluations, at most `MOST_FIRST`: Bayesian optimisation learns
    from them as from evenly spread designs, and more of them are wasted. Only the last stage ends where little is
    gained: what came before would have led it elsewhere.
    """
    first, parts = len(request.first), _methods(request.method)
    total = request.searched - first
    shares = [min(total // 3, MOST_FIRST)] if len(parts) > 1 else []
    shares.append(total - sum(shares))
    learns = len(parts) == 1 and parts[0].learns
    initial = default_initial(request.space, total, prior, request.estimated) if learns else 0
    stages = [Stage(request, method.name, share, initial) for method, share in zip(parts, shares, strict=True)]
    least_gain = request.until_percent / 100.0 if parts[-1].ends else 0.0
    begin = [Stage(request, methods.START, first)] if first else []
    return [*begin, *stages[:-1], replace(stages[-1], least_gain=least_gain)]
