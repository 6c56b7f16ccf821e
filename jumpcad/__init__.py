"""From eight numbers to a jumping robot that can be printed, simulated and trusted.

The public names load when they are first used, so that `import jumpcad` and the command line start quickly: only when
the latter runs does it answer an interrupt in one line.
"""

from jumpcad.face import __version__ as __version__
from jumpcad.face import lazy_exports

TYPE_CHECKING = False  # type checkers take it for true; to import typing takes longer than all else here
if TYPE_CHECKING:
    from jumpcad import search as search
    from jumpcad.api import build as build
    from jumpcad.api import capsule_robot as capsule_robot
    from jumpcad.api import check as check
    from jumpcad.api import evaluate as evaluate
    from jumpcad.api import export as export
    from jumpcad.api import simulate as simulate
    from jumpcad.bundle.manifest import Bundle as Bundle
    from jumpcad.bundle.variants import variants as variants
    from jumpcad.comparison import compare as compare
    from jumpcad.design import PRINTED_BOUNDS as PRINTED_BOUNDS
    from jumpcad.design import SEARCH_BOUNDS as SEARCH_BOUNDS
    from jumpcad.design import Design as Design
    from jumpcad.design import load_design as load_design
    from jumpcad.environment import JumpEnv as JumpEnv
    from jumpcad.errors import CannotBuildError as CannotBuildError
    from jumpcad.errors import JumpcadError as JumpcadError
    from jumpcad.evaluation import EvaluationResult as EvaluationResult
    from jumpcad.findings import Finding as Finding
    from jumpcad.landing.course import go as go
    from jumpcad.landing.landing import land as land
    from jumpcad.landing.series import jumps as jumps
    from jumpcad.paper import published as published
    from jumpcad.robot.robot import Robot as Robot
    from jumpcad.search.optimization import optimize as optimize
    from jumpcad.settings import Settings as Settings
    from jumpcad.settings import load_settings as load_settings
    from jumpcad.simulation import Jump as Jump
    from jumpcad.simulation.robot_file import load_robot as load_robot
    from jumpcad.workshop import Workshop as Workshop
    from jumpcad.workshop import load_workshop as load_workshop
else:
    __getattr__, __dir__, __all__ = lazy_exports(__name__, {
        "jumpcad": "search",
        "jumpcad.face": "__version__",
        "jumpcad.api": "build capsule_robot check evaluate export simulate",
        "jumpcad.bundle.manifest": "Bundle",
        "jumpcad.bundle.variants": "variants",
        "jumpcad.comparison": "compare",
        "jumpcad.design": "PRINTED_BOUNDS SEARCH_BOUNDS Design load_design",
        "jumpcad.environment": "JumpEnv",
        "jumpcad.errors": "CannotBuildError JumpcadError",
        "jumpcad.evaluation": "EvaluationResult",
        "jumpcad.findings": "Finding",
        "jumpcad.landing.course": "go",
        "jumpcad.landing.landing": "land",
        "jumpcad.landing.series": "jumps",
        "jumpcad.paper": "published",
        "jumpcad.robot.robot": "Robot",
        "jumpcad.search.optimization": "optimize",
        "jumpcad.settings": "Settings load_settings",
        "jumpcad.simulation": "Jump",
        "jumpcad.simulation.robot_file": "load_robot",
        "jumpcad.workshop": "Workshop load_workshop",
    })  # fmt: skip
