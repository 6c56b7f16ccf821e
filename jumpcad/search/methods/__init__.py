"""The methods that propose designs: one module each, and one line in `METHODS`.

A method is a function that takes an `Evaluator` and a `Task` and returns when the task's evaluations are used up. All
else follows from its entry: the choices and help of `jumpcad optimize`, the plan of a study, what its file may hold.
"""

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jumpcad.search.evaluator import Evaluator


STEPS = 1_000_000
"""Steps of the study file that one run of a method may have; a study's next run of it starts there."""


@dataclass(frozen=True)
class Task:
    """What a method is asked to do.

    Parameters
    ----------
    evaluations
        Number of new designs, at most.
    seed
        Random seed.
    initial
        How many of them are spread evenly over the space first, for a method that learns.
    batch
        Designs that are proposed and evaluated together, for a method that learns.
    preset
        Settings of the genetic algorithm, by name.
    least_gain
        Share of the best score below which a method that learns ends; 0 for none.
    first_step
        Number of its first step in the study file: a method may run several times in a study.
    screen
        Whether a quick guess leaves out candidates of the genetic algorithm.
    against
        What a front weighs the score against: a name of `fronts.find_cost`.
    """

    evaluations: int
    seed: int
    initial: int = 0
    batch: int = 1
    preset: str = "recommended"
    least_gain: float = 0.0
    first_step: int = 0
    screen: bool = False
    against: str = "spring-energy"


@dataclass(frozen=True)
class Method:
    """An entry of the registry.

    Parameters
    ----------
    name
        Name on the command line; also the phase of the method's trials in a study file.
    function
        Where it is: `module.function` in `propose`. The module is imported when the method runs.
    meaning
        Description in the help.
    front
        Whether it searches a front of score against a cost, not one best design.
    learns
        Whether it fits a surrogate: it then starts with evenly spread designs, and each proposal carries the
        hyperparameters (`theta`) with which the next step starts.
    ends
        Whether it ends where its proposals promise less than a task's `least_gain`.
    shares
        Whether its parts have shares of the evaluations: a search with more of them is another one.
    least
        Fewest evaluations that it takes: each of its parts has one.
    runs
        How often it runs another method; each time has `STEPS` steps of its own in the study file.
    """

    name: str
    function: str
    meaning: str
    front: bool = False
    learns: bool = False
    ends: bool = False
    shares: bool = False
    least: int = 0
    runs: int = 1

    def run(self, evaluator: "Evaluator", task: Task) -> bool:
        """Search; the trials are the evaluator's. Return whether it ended early, as little was left to gain."""
        module, name = self.function.split(".")
        return bool(getattr(importlib.import_module(f"jumpcad.search.propose.{module}"), name)(evaluator, task))


METHODS = {
    method.name: method
    for method in (
        Method("ga", "genetic.run_genetic", "genetic algorithm"),
        Method("bo", "bayesian.run_bayesian", "Bayesian optimisation", learns=True, ends=True),
        Method(
            "pareto",
            "pareto.run_pareto",
            "front of two figures, such as range against electrical energy",
            front=True,
            learns=True,
        ),
        Method("paper", "paper.run_paper", "the published study's stages", shares=True, least=7, runs=3),
        Method("nsga2", "pareto.run_nsga2", "the same front by NSGA-II", front=True),
    )
}
SEQUENCES = {"ga+bo": ("ga", "bo")}
"""Two methods, one after the other; the second learns from the first."""
DEFAULT = "bo"
"""Of printed robots, it needs about 35 designs to come within a hundredth of the best known, after `ga` 100 to 150."""
EVALUATIONS, UNTIL_PERCENT = 250, 0.05
"""What a search may cost at most unless the user says something else, and the promised gain at which it ends."""
NAMES = (*SEQUENCES, *METHODS)
FRONTS = tuple(name for name, method in METHODS.items() if method.front)
