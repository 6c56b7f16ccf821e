"""Search for designs: a study file of trials, the methods that propose designs, the robust pick, views of the space.

`optimize` does all of it in one call. The other names are its parts: `run_study` runs a `Request` on a `Pool` into a
`StudyStore`; an `Evaluator` evaluates designs for a method, or for a view like `sweep`.
"""

from typing import TYPE_CHECKING

from jumpcad.face import lazy_exports

if TYPE_CHECKING:
    from jumpcad.search.explore import components as components
    from jumpcad.search.explore import feasibility_map as feasibility_map
    from jumpcad.search.explore import importance as importance
    from jumpcad.search.explore import sample as sample
    from jumpcad.search.explore import sweep as sweep
    from jumpcad.search.fronts import COSTS as COSTS
    from jumpcad.search.fronts import energy_j as energy_j
    from jumpcad.search.models import CapsuleModel as CapsuleModel
    from jumpcad.search.models import PrintedModel as PrintedModel
    from jumpcad.search.models import RobotModel as RobotModel
    from jumpcad.search.models import robot_model as robot_model
    from jumpcad.search.optimization import optimize as optimize
    from jumpcad.search.report import plots as plots
    from jumpcad.search.report.figures import save_figure as save_figure
    from jumpcad.search.report.page import plot_study as plot_study
    from jumpcad.search.space import Space as Space
    from jumpcad.search.study.evaluator import Evaluator as Evaluator
    from jumpcad.search.study.objective import OBJECTIVES as OBJECTIVES
    from jumpcad.search.study.objective import find_objective as find_objective
    from jumpcad.search.study.pool import Pool as Pool
    from jumpcad.search.study.pool import dask_pool as dask_pool
    from jumpcad.search.study.pool import local_pool as local_pool
    from jumpcad.search.study.request import Request as Request
    from jumpcad.search.study.result import Result as Result
    from jumpcad.search.study.run import run_study as run_study
    from jumpcad.search.study.store import StudyStore as StudyStore
    from jumpcad.search.study.trial import Trial as Trial
    from jumpcad.search.study.trial import to_frame as to_frame
    from jumpcad.search.study.trial import write_table as write_table
else:
    __getattr__, __dir__, __all__ = lazy_exports(__name__, {
        "jumpcad.search.explore": "components feasibility_map importance sample sweep",
        "jumpcad.search.fronts": "COSTS energy_j",
        "jumpcad.search.models": "CapsuleModel PrintedModel RobotModel robot_model",
        "jumpcad.search.optimization": "optimize",
        "jumpcad.search.report": "plots",
        "jumpcad.search.report.figures": "save_figure",
        "jumpcad.search.report.page": "plot_study",
        "jumpcad.search.space": "Space",
        "jumpcad.search.study.evaluator": "Evaluator",
        "jumpcad.search.study.objective": "OBJECTIVES find_objective",
        "jumpcad.search.study.pool": "Pool dask_pool local_pool",
        "jumpcad.search.study.request": "Request",
        "jumpcad.search.study.result": "Result",
        "jumpcad.search.study.run": "run_study",
        "jumpcad.search.study.store": "StudyStore",
        "jumpcad.search.study.trial": "Trial to_frame write_table",
    })  # fmt: skip
