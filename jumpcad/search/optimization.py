"""`optimize`: the whole search in one call."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from jumpcad.arguments import check_arguments
from jumpcad.design import Design, load_design
from jumpcad.search.methods import DEFAULT, EVALUATIONS, PAPER, UNTIL_PERCENT
from jumpcad.search.models import robot_model
from jumpcad.search.space import Space
from jumpcad.search.study.database import require_study
from jumpcad.search.study.pool import open_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.result import Result
from jumpcad.search.study.run import run_study
from jumpcad.search.study.variant import NOTHING
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop
from jumpcad.workshop.varied import Value


@check_arguments
def optimize(
    method: str = DEFAULT,
    evaluations: int = EVALUATIONS,
    seed: int = 0,
    objective: str | Callable[..., Any] | None = None,
    model: str = "printed",
    study: str | Path | None = None,
    fixed: Mapping[str, Value] = NOTHING,
    bounds: Mapping[str, tuple[float, float]] = NOTHING,
    choices: Mapping[str, Sequence[Value]] = NOTHING,
    around: Design | str | Path | None = None,
    only: Sequence[str] = (),
    within_percent: float | int | None = None,
    workshop: Workshop | str | Path | None = None,
    settings: Settings | str | Path | None = None,
    engine: str | None = None,
    workers: int | None = None,
    dask: str | None = None,
    limit_s: float | int = 60.0,
    preset: str = "recommended",
    batch: int = 1,
    prior: str | Path | None = None,
    until_percent: float | int = UNTIL_PERCENT,
    hours: float | int = 0.0,
    screen: bool = False,
    against: str | None = None,
    require: Mapping[str, tuple[float | None, float | None]] = NOTHING,
    start: Sequence[Design | str | Path] = (),
    cold: bool = False,
) -> Result:
    """Search for the design that jumps farthest, and pick one whose neighbours jump well too.

    The same search as `jumpcad optimize`, which has the same options.

    Parameters
    ----------
    method
        `ga`, `bo`, `ga+bo` (first `ga`, then `bo` on all that it saw), `paper` (the published study's stages), or
        `pareto` and `nsga2` for a front.
    evaluations
        How many designs are evaluated at most, those of the robust pick included: a quarter of them, at most 200.
    seed
        Random seed: the same call gives the same result.
    objective
        One of `jumpcad.search.OBJECTIVES` by name; if None, `range` for a front, `body_lengths` of the printed robot,
        `fitness` of the others. Or an own one: a function that takes the figures of a jump (a mapping of
        names to numbers) and returns the score, or `FILE.py:FUNCTION`.
    model
        The robot that is evaluated: `printed`, `capsule` or `published`.
    study
        A file (.db) in which every trial is kept, and from which the same call continues; none if None.
    fixed, bounds, choices
        By parameter: a value, a pair of limits in place of `PRINTED_BOUNDS`, allowed values. Robots that are not
        printed, and `paper`, have the study's, `SEARCH_BOUNDS`, which may be given as well. A key of the workshop is
        a parameter too: ``bounds={"body.plate_mm": (1.6, 2.4)}``, ``choices={"bought.spring": ["", "9271K619"]}``.
    around, only, within_percent
        Free only some parameters, or search near a design; see `Space.make`. That design is evaluated first.
    start
        Designs in the space, templates' names or files: they are evaluated first, and the search begins with them.
    cold
        Begin without the shipped designs, of which the best three in the space are else among the first ones of a
        printed robot's search.
    workshop, settings, engine
        Where `printed` is built and how it is simulated; see `robot_model`, which refuses what the model does not use.
    workers, dask, limit_s
        Processes (one for each core if None, none if 0) or the address of a Dask scheduler, and the timeout for each
        evaluation (s).
    preset, batch, prior
        Settings of the genetic algorithm, Bayesian proposals evaluated together, an earlier study to learn from.
    until_percent, hours
        End earlier: when the last Bayesian steps gain less than this share of the best score, or after this time (h);
        see `Request`. 0 for neither: all evaluations are spent.
    screen
        For `ga` on the printed robot: leave out candidates that, by a quick estimate, fail or are worse than the best
        known by more than the estimate's error. They count as evaluations.
    require
        At least and at most, None for neither, of figures of an evaluation or margins of limits, by name:
        ``{"touchdown_pitch_deg": (-30.0, 30.0)}``. What depends on the floor holds on slippery and rough ones. The
        winner keeps them, or there is none.
    against
        What `pareto` and `nsga2` weigh the objective against: one of `jumpcad.search.COSTS`, of which less is better
        (`electrical-energy`, `spring-energy`, `mass`, `winding-time`), or another objective, of which more is. If None,
        electrical energy of the printed robot, energy in the springs of the others.

    Returns
    -------
    Result
        `design`, `workshop`, `score` and `fitness` of the winner, the ranked `candidates`, all `trials`.

    Raises
    ------
    JumpcadError
        If an argument is wrong, or the study file holds another study, is damaged or in use.
    """
    path, learned = (None if one is None else Path(one) for one in (study, prior))
    require_study(path)
    centre = load_design(around) if isinstance(around, str | Path) else around
    begun = [load_design(one) if isinstance(one, str | Path) else one for one in start]
    robot = robot_model(model, workshop, settings, engine).requiring(require)
    space = Space.make(fixed, bounds, choices, centre, only, within_percent, robot.workshop, method == PAPER)
    request = Request(
        space, robot, objective, method, evaluations, seed, preset, batch, learned, until_percent, hours, screen,
        against, begun, centre, cold,
    )  # fmt: skip
    with open_pool(workers, dask, limit_s) as pool:
        return run_study(request, path, pool)
