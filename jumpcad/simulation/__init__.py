"""Simulated jumps of a mechanism, by any of several engines: release, push-off, take-off, flight, audit.

The public names load when they are first used: the command line's help names the engines without loading one.
"""

from typing import TYPE_CHECKING

from jumpcad.face import lazy_exports

if TYPE_CHECKING:
    from jumpcad.simulation.engines import ENGINES as ENGINES
    from jumpcad.simulation.engines import default_engine as default_engine
    from jumpcad.simulation.jump import Jump as Jump
    from jumpcad.simulation.simulator import Settings as Settings
    from jumpcad.simulation.simulator import headline as headline
    from jumpcad.simulation.simulator import load_settings as load_settings
    from jumpcad.simulation.simulator import simulate as simulate
    from jumpcad.simulation.uncertain import Uncertainty as Uncertainty
    from jumpcad.simulation.uncertain import uncertain_jump as uncertain_jump
else:
    __getattr__, __dir__, __all__ = lazy_exports(__name__, {
        "jumpcad.simulation.engines": "ENGINES default_engine",
        "jumpcad.simulation.jump": "Jump",
        "jumpcad.simulation.simulator": "Settings headline load_settings simulate",
        "jumpcad.simulation.uncertain": "Uncertainty uncertain_jump",
    })  # fmt: skip
