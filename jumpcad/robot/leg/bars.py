"""Where the bars of legs with printed ends begin and end, in the legs' own frames (mm)."""

from dataclasses import dataclass

from jumpcad.catalogue import LegBar
from jumpcad.errors import CannotBuildError
from jumpcad.findings import higher

SOCKET_HEIGHTS = 5.0
"""Length of the socket that carries the leg's bending moment, in heights of the bar; judgement: pultruded carbon has
little shear strength, and the shorter the socket, the larger the forces by which it transmits the moment."""
END_SOCKET_MM = 8.0
"""Length of the other sockets, at eyes without a moment; judgement: twice the bar's height or more."""
END_PLAY_MM = 0.2
"""Gap between the bar's ends and the sockets' floors; judgement: bars cut by hand, and room for displaced glue."""
FREE_MM = 5.0
"""Least length between the sockets; judgement: less is not worth a bar."""


@dataclass(frozen=True)
class BarPlace:
    """One bar: its sockets' floors and mouths along the leg, in order from the body to the foot."""

    bar: LegBar
    floor_mm: float
    mouth_mm: float
    far_mouth_mm: float
    far_floor_mm: float

    @property
    def length_mm(self) -> float:
        """Length to cut."""
        return self.far_floor_mm - self.floor_mm - 2.0 * END_PLAY_MM

    @property
    def middle_mm(self) -> float:
        """Its middle along the leg."""
        return (self.floor_mm + self.far_floor_mm) / 2.0


def bar_place(what: str, bar: LegBar, first_mm: float, least_mouth_mm: float, last_mm: float, bends: bool) -> BarPlace:
    """Return the place of a bar from `first_mm` to `last_mm` along a leg, the first socket's mouth not before a limit.

    `bends` tells whether the first socket carries a bending moment.
    """
    socket = SOCKET_HEIGHTS * bar.height_mm if bends else END_SOCKET_MM
    mouth, far = max(first_mm + socket, least_mouth_mm), last_mm - END_SOCKET_MM
    if far - mouth < FREE_MM:
        raise CannotBuildError(
            f"bought.leg = {bar.name!r}: {far - mouth:.1f} mm of the {what} are free between the bar's sockets; "
            f"{FREE_MM:g} mm are needed",
            "leg_bar", far - mouth - FREE_MM,
            ways=('bought.leg = ""', *higher("carrying_link_mm"), "choose a lower bar"),
        )  # fmt: skip
    return BarPlace(bar, first_mm, mouth, far, last_mm)
