"""What a method is asked to do. Each is a module of this folder and a line in `jumpcad.search.phases.METHODS`.

A method is a function that takes an `Evaluator` and a `Task` and returns when the task's evaluations are used up. All
else follows from its entry: the choices and help of `jumpcad optimize`, the plan of a study, what its file may hold.
"""

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

from jumpcad.search.phases import METHODS

if TYPE_CHECKING:
    from jumpcad.search.study.evaluator import Evaluator


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
    run
        Number of this run of the method: it may run several times in a study.
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
    run: int = 0
    screen: bool = False
    against: str = "spring-energy"


def run_method(name: str, evaluator: "Evaluator", task: Task) -> bool:
    """Search by a method; the trials are the evaluator's. Return whether it ended early, as little was left to gain."""
    module, function = METHODS[name].function.split(".")
    return bool(getattr(importlib.import_module(f"jumpcad.search.propose.{module}"), function)(evaluator, task))
