"""The planar engine's tuples hold numbers of one type each: another type would be compiled anew."""

from collections.abc import Iterator
from typing import Any, get_args, get_origin, get_type_hints

from jumpcad.robot import Robot
from jumpcad.simulation import Settings
from jumpcad.simulation import planar_kernel as kernel
from jumpcad.simulation.planar import PlanarWorld


def wrong(value: Any, kind: Any, path: str = "") -> Iterator[str]:
    """Yield the path and the type of everything in a tuple that is not of the type that its class names."""
    if get_origin(kind) is tuple:
        for index, (item, of) in enumerate(zip(value, get_args(kind), strict=True)):
            yield from wrong(item, of, f"{path}[{index}]")
    elif hasattr(kind, "_fields"):
        for name, of in get_type_hints(kind).items():
            yield from wrong(getattr(value, name), of, f"{path}.{name}")
    elif type(value) is not kind:
        yield f"{path} is a {type(value).__name__}"


def test_what_the_kernel_returns_has_the_types_of_its_classes(kenan: Robot) -> None:
    world = PlanarWorld(kenan, Settings())
    found = world.push_off()
    links = kernel.links_at(world.model, found.moment.leg_rad)
    inertia = kernel.inertia_at(world.model, links, 1 + 0j)
    for value in (world.moment, found, links, inertia):
        module_type = next(kind for kind in type(value).__mro__ if hasattr(kind, "_fields"))
        assert list(wrong(value, module_type)) == []
