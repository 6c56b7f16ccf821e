"""Sections that grow by what they lack, or at once by what is known to help."""

import math

import pytest

from jumpcad.findings import Finding
from jumpcad.strength.growth import POWERS, Growth, grown_mm, in_hundredths


def test_a_weak_section_grows_by_what_it_lacks_at_most_by_a_tenth() -> None:
    """And by two thousandths more; by a whole step where the lack is not known, by the most of what is asked."""

    def weak(grows: str, use: float | None) -> Finding:
        value = None if use is None else 100.0 * use
        return Finding("f", "error", -1.0, "MPa", "", "", value, None if use is None else 100.0, grows)

    grown = Growth(leg=1.2).more([weak("leg", 1.05), weak("toe", 1.5), weak("rail", None), weak("toe", 1.01)])
    assert (grown.leg, grown.toe, grown.rail) == pytest.approx((1.2 * 1.002 * 1.05, 1.1, 1.1))
    assert (grown.lever, grown.front, grown.plate, grown.dog, grown.stop) == (1.0,) * 5
    assert Growth().more([]) == Growth()
    holds = Finding("f", "info", 30.0, "MPa", "", "", 70.0, 100.0, "leg")
    assert Growth(leg=1.2).more([holds]) == Growth(leg=1.2)  # it does not shrink


def test_a_section_leaps_to_where_the_limit_is_once_it_is_known_what_growing_helps() -> None:
    """A stress that falls with a power of the height: on the third try it is 2/1000 of height below its limit."""

    def weak(use: float, name: str = "f") -> Finding:
        return Finding(name, "error", -1.0, "MPa", "", "", 100.0 * use, 100.0, "leg")

    for power, use in ((0.6, 1.08), (1.0, 1.4), (2.0, 1.8), (3.0, 2.2)):
        first = [weak(use)]
        second = Growth().leap(first, {})
        assert second == Growth().more(first)
        third = second.leap([weak(use * second.leg**-power)], Growth().uses(first))
        assert third.leg == pytest.approx(1.002 * use ** (1.0 / power))
    # by a half at most; as at first where growing has not helped, or the section has not grown
    grown, uses = Growth(leg=1.1), {("f", "leg"): (1.0, 2.0)}
    assert grown.leap([weak(1.9)], uses).leg == pytest.approx(1.1 * 1.5)
    # 0.3 is the power of no section: something else holds its size
    for use in (2.0 * 1.1**-0.3, 2.0, 2.1, math.inf):
        assert grown.leap([weak(use)], uses).leg == pytest.approx(1.1 * 1.1)
    assert Growth().leap([weak(1.05)], uses).leg == pytest.approx(1.002 * 1.05)
    assert grown.leap([weak(1.05, "g")], uses).leg == pytest.approx(1.1 * 1.002 * 1.05)
    assert Growth().uses([Finding("f", "error", -1.0, "MPa", "", "", grows="leg")]) == {}


@pytest.mark.parametrize(("name", "power"), POWERS.items())
def test_what_is_known_to_fall_with_a_power_of_its_section_is_met_at_once(name: str, power: float) -> None:
    """Unless it lacks so much that the section would grow by more than a half, or has fallen otherwise before."""

    def weak(use: float | None) -> Finding:
        return Finding(name, "error", -1.0, "MPa", "", "", use and 100.0 * use, 100.0, "stop")

    grown = Growth(stop=1.2).leap([weak(1.15)], {})
    assert (grown.stop / 1.2) ** power == pytest.approx(1.15 * 1.002**power)
    assert Growth().leap([weak(4.0)], {}).stop == pytest.approx(1.5)
    assert Growth().leap([weak(None)], {}).stop == pytest.approx(1.1)
    assert Growth().more([weak(1.15)]).stop == pytest.approx(1.1)
    fallen = {(name, "stop"): (1.0, 1.05 * 1.2)}  # with a power of 1
    assert Growth(stop=1.2).leap([weak(1.05)], fallen).stop == pytest.approx(1.2 * 1.002 * 1.05)


def test_what_does_not_grow_keeps_its_size_and_the_rest_is_rounded_up_to_hundredths() -> None:
    assert grown_mm(4.0037, 1.0) == 4.0037
    assert grown_mm(4.0037, 1.3) == 5.21  # 5.20481
    assert (in_hundredths(5.2), in_hundredths(5.2 + 1e-9), in_hundredths(5.2001)) == (5.2, 5.2, 5.21)
