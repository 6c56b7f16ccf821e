"""Names that all of a search shares: its methods, and the phases of a study, which say what proposed a trial."""

from collections import ChainMap
from dataclasses import dataclass


@dataclass(frozen=True)
class Method:
    """An entry of the registry: a function of an `Evaluator` and a `Stage`, which returns when that is done.

    All else follows from the entry: choices and help of `jumpcad optimize`, the plan of a study, what its file may
    hold. The name is also the phase of its trials; the module of `module.function`, in `jumpcad.search.propose`, is
    imported when it runs. What `learns` fits a surrogate: it starts with evenly spread designs, and each proposal
    carries the hyperparameters (`theta`) with which the next step starts.
    """

    name: str
    function: str
    meaning: str
    front: bool = False  # it searches a front of score against a cost, not one best design
    learns: bool = False
    ends: bool = False  # where its steps gain less than a stage's `least_gain`
    shares: bool = False  # of the evaluations, for its parts: a search with more of them is another one
    least: int = 0  # evaluations: each of its parts has one


FRONT = "front of two figures, such as range against electrical energy"
PAPER = "paper"
"""The method that repeats the study's stages, within its bounds."""
METHODS = {
    method.name: method
    for method in (
        Method("ga", "genetic.run_genetic", "genetic algorithm"),
        Method("bo", "bayesian.run_bayesian", "Bayesian optimisation", learns=True, ends=True),
        Method("pareto", "pareto.run_pareto", FRONT, front=True, learns=True),
        Method(PAPER, "paper.run_paper", "the published study's stages", shares=True, least=7),
        Method("nsga2", "pareto.run_nsga2", "the same front by NSGA-II", front=True),
    )
}
SEQUENCES = {"ga+bo": ("ga", "bo")}
"""Two methods, one after the other; the second learns from the first."""
DEFAULT = "bo"
"""Of printed robots, it needs about 35 designs to come within a hundredth of the best known, after `ga` 100 to 150."""
EVALUATIONS, UNTIL_PERCENT = 250, 0.05
"""What a search may cost at most unless the user says something else, and the gain at which it ends."""
NAMES = (*SEQUENCES, *METHODS)
FRONTS = tuple(name for name, method in METHODS.items() if method.front)

PRESETS = ("recommended", "published")
"""Settings of the genetic algorithm."""
MOST_PICK, LEAST_PICK = 200, 6
"""Most evaluations of the robust pick; with fewer than the least it examines nothing."""

EXPLORED = ("sample", "sweep")
"""Phases of a view; the random designs of `paper` are samples too."""
AROUND = ("bounds", "robust")
"""Phases that examine designs near the best."""
START = "start"
STAGES = ChainMap({START: Method(START, "initial_designs.run_start", "the designs to begin with")}, METHODS)
"""What a study is planned as."""
SEARCH_PHASES = (*EXPLORED, START, *METHODS)
PHASES = (*SEARCH_PHASES, *AROUND)
"""All phases in the order of a study."""
LEARNING_PHASES = tuple(name for name, method in METHODS.items() if method.learns)
"""Phases that, after a first step, start from the hyperparameters of the step before."""
