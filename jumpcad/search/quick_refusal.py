"""Robots that fall over or are too weak by an estimate of their masses, whatever its error: nothing of them is built.

Only one direction of each error can refuse wrongly: less energy is needed than estimated, or the centre of mass is
farther ahead. `benchmarks/refuse.py` found at most 13 % less and 12.1 mm in 2,301 robots; a reserve is added.
"""

from dataclasses import replace

from jumpcad.design import Design
from jumpcad.findings import Finding
from jumpcad.mechanism.feasibility import statics_findings
from jumpcad.mechanism.variants import with_spring_factor
from jumpcad.search.quick_mass import known, quick_robot
from jumpcad.settings import Settings
from jumpcad.workshop import Workshop

LIGHTER, AHEAD_MM = 0.18, 16.0
"""Largest errors: by which share less energy may be needed, and how far ahead the centre of mass may be."""


def quick_refusal(design: Design, workshop: Workshop, settings: Settings) -> tuple[Finding, ...]:
    """Return which of `tips` and `too_weak` are violated for certain; none where nothing can be said.

    The margins are those of the estimate. The design has passed the checks of its geometry.
    """
    if not known(design, workshop):
        return ()
    robot = with_spring_factor(quick_robot(design, workshop), settings.spring_efficiency)
    return tuple(_estimated(one) for one in statics_findings(robot, settings.gravity_m_s2) if is_certain(one))


def is_certain(finding: Finding) -> bool:
    """Tell whether a limit of the statics is violated whatever the error of the estimate.

    The centre of mass is never too far ahead: the body hangs behind the ankle.
    """
    assert finding.value is not None
    assert finding.limit is not None
    if finding.name == "tips":
        return finding.margin < -AHEAD_MM
    return finding.value < (1.0 - LIGHTER) * finding.limit


def _estimated(finding: Finding) -> Finding:
    error = f"{AHEAD_MM:g} mm" if finding.name == "tips" else f"{100.0 * LIGHTER:g} % of what is needed"
    return replace(finding, message=f"{finding.message}; by an estimate of the masses, at most {error} too strict")
