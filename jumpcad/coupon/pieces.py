"""The fit coupon: a gauge of holes and pegs in every material, and a gear pair at several backlashes (mm).

Engraved are the offsets as they are written in a workshop's fits: `.10` in the gauge is a hole 0.10 mm larger per side
than its axle or bearing, `.15` on a pinion a circumferential backlash of 0.15 mm. All pieces lie flat on the bed, with
no overhangs, so that they print without support.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from jumpcad.drive.gears import Gear, GearPair, gear_pair
from jumpcad.parts.holes import HoleSizes
from jumpcad.parts.part import Piece
from jumpcad.solids.outline import Region, disc, engravable, hole, polygon, rectangle, stadium, text, union
from jumpcad.solids.stack import Stack
from jumpcad.strength.bearings import hub_bearings
from jumpcad.workshop import Workshop

STEP_MM = 0.05
"""Between neighbours of a series: the repeatability of holes from desktop printers (practice)."""
LONGEST_SERIES = 15
"""Holes of a series at most, beyond which its steps are doubled; judgement: three rows of `COLUMNS`."""
BEYOND = 2
"""Steps by which a series extends beyond the workshop's fits; judgement."""
PEGS_MM = (4.0, 6.0, 8.0)
"""Diameters of the pegs; judgement: those of eyes and bosses, and far enough apart to tell a scale from an offset."""
PEG_HEIGHT_MM = 8.0
"""Judgement: the jaws of callipers hold it above its foot."""
GAUGE_MM, HOLDER_MM = 3.0, 6.0
"""Thickness of the gauge, about a body plate's, and of the gears' holder, longer than a gear is wide; judgement."""
COLUMNS = 5
"""Holes of a row; judgement: a gauge that any bed holds."""
MARGIN_MM, LETTERS_MM, LABEL_GAP_MM, TITLE_MM = 3.0, 3.5, 2.0, 5.0
"""Around holes and to the edge, height of labels, from hole to label, height of titles; judgement: read without a
glass, printed by a nozzle of 0.4 mm."""
ENGRAVED_MM = 0.6
"""Depth of the letters; judgement: three layers of 0.2 mm."""
MODULE_MM, PINION_TEETH, WHEEL_TEETH, FACE_MM = 1.25, 15, 20, 5.0
"""A gear pair as in robots: usual module and face width, no undercut, space for letters inside the pinion's root."""
PINION_LETTERS_MM = 3.0
MOST_BACKLASH_MM = 0.4
"""Around which backlash the pinions are at most: at 0.5 mm their tips are 0.18 mm thick, at 0.7 mm there is none."""


@dataclass(frozen=True)
class Series:
    """The offsets of a coupon: per side for axle and bearing, circumferential backlashes; each ascending (mm).

    `bearing_mm` is empty in a workshop whose legs have no bearing.
    """

    axle_mm: tuple[float, ...]
    bearing_mm: tuple[float, ...]
    backlash_mm: tuple[float, ...]


def series_of(holes: HoleSizes) -> Series:
    """Return the offsets around a workshop's fits."""
    fits = holes.fits
    seats = _offsets(fits.press_mm, fits.press_mm) if holes.bearing else ()
    backlash = min(fits.backlash_circumferential_mm, MOST_BACKLASH_MM)
    free = tuple(step for step in _offsets(backlash, backlash) if step >= 0.0)
    return Series(_offsets(fits.press_mm, fits.loose_mm), seats, free)


def coupon_pair() -> GearPair:
    """Return the coupon's gears without backlash; the printed pinions are those of `pinion`, with thinner teeth."""
    return gear_pair(PINION_TEETH, WHEEL_TEETH, MODULE_MM, FACE_MM, 0.0)


def pinion(backlash_mm: float) -> Gear:
    """Return the pinion whose thinner teeth give the pair its whole circumferential backlash."""
    return replace(coupon_pair().pinion, thinning_mm=backlash_mm)


def engraved(offset_mm: float) -> str:
    """Return an offset as it is engraved: `.05`, `-.05`, `1.00`."""
    return f"{offset_mm:.2f}".replace("0.", ".", 1)


def coupon_holes(workshop: Workshop) -> HoleSizes:
    """Return the bores of a workshop's coupon, with the lightest bearing of its hubs."""
    return HoleSizes.of(workshop, hub_bearings(workshop)[0])


def pieces(holes: HoleSizes, materials: Sequence[str], gear_material: str) -> list[Piece]:
    """Return all pieces: a gauge in every material; of the gears' material a wheel, a holder, and pinions."""
    steps, pair = series_of(holes), coupon_pair()
    made = [Piece(f"gauge_{name}", name, holes.chamfered(gauge(holes, steps, name))) for name in materials]
    running = hole(holes.running(holes.axle_mm))
    wheel = Stack.of([(0.0, FACE_MM, polygon(pair.wheel.profile_mm) - running)])
    ends = (0.0, 0.0), (pair.centre_distance_mm, 0.0)
    bar = stadium(*ends, holes.press(holes.axle_mm) + 4.0 * holes.fits.wall_mm)
    holder = Stack.of([(0.0, HOLDER_MM, bar)]).through(*(hole(holes.press(holes.axle_mm), end) for end in ends))
    made.append(Piece("gear_holder", gear_material, holes.chamfered(holder)))
    made.append(Piece("gear_wheel", gear_material, holes.chamfered(wheel)))
    for backlash in steps.backlash_mm:
        gear = Stack.of([(0.0, FACE_MM, polygon(pinion(backlash).profile_mm) - running)])
        letters = centred(engraved(backlash), PINION_LETTERS_MM)
        middle = (holes.axle_mm + coupon_pair().pinion.root_radius_mm) / 2.0
        gear = gear.minus([engraving(FACE_MM, letters.translate((0.0, middle - PINION_LETTERS_MM / 2.0)))])
        made.append(Piece(f"pinion_{round(100.0 * backlash):02d}", gear_material, holes.chamfered(gear)))
    return made


@dataclass(frozen=True)
class GaugeRow:
    """A row of holes or pegs: its letter, empty if it continues the row above, and (label, diameter) of each."""

    letter: str
    places: tuple[tuple[str, float], ...]
    pegs: bool = False

    @property
    def size_mm(self) -> float:
        """The largest diameter."""
        return max(diameter for _, diameter in self.places)


def gauge_rows(holes: HoleSizes, steps: Series) -> list[GaugeRow]:
    """Return the rows of a gauge from the back: holes for the axle (A), for the bearing's outside (B), pegs (P)."""
    rows = []
    seat = holes.bearing.outer_mm if holes.bearing else 0.0
    for letter, nominal, offsets in (("A", holes.axle_mm, steps.axle_mm), ("B", seat, steps.bearing_mm)):
        for start in range(0, len(offsets), COLUMNS):
            places = tuple((engraved(step), nominal + 2.0 * step) for step in offsets[start : start + COLUMNS])
            rows.append(GaugeRow("" if start else letter, places))
    return [*rows, GaugeRow("P", tuple((f"{peg:g}", peg) for peg in PEGS_MM), pegs=True)]


def row_middles_mm(rows: Sequence[GaugeRow]) -> Iterator[float]:
    """Yield where the middles of a gauge's rows are along y."""
    y = -2.0 * MARGIN_MM - TITLE_MM
    for row in rows:
        yield y - row.size_mm / 2.0
        y -= row.size_mm + LABEL_GAP_MM + LETTERS_MM + MARGIN_MM


def gauge(holes: HoleSizes, steps: Series, title: str) -> Stack:
    """Return the plate with the material's name, the rows of holes and the row of pegs."""
    rows = gauge_rows(holes, steps)
    across = max(row.size_mm for row in rows) + 2.0 * MARGIN_MM
    left = TITLE_MM + 2.0 * MARGIN_MM
    named = [text(title, TITLE_MM)] if engravable(title).strip() else []
    letters = [name.translate((MARGIN_MM, -MARGIN_MM - TITLE_MM)) for name in named]
    cut: list[Region] = []
    pegs: list[Region] = []
    line = 0.0
    for row, middle in zip(rows, row_middles_mm(rows), strict=True):
        line = middle - row.size_mm / 2.0 - LABEL_GAP_MM - LETTERS_MM
        if row.letter:
            letters.append(text(row.letter, TITLE_MM).translate((MARGIN_MM, middle - TITLE_MM / 2.0)))
        for column, (label, diameter) in enumerate(row.places):
            x = left + across * (column * (2 if row.pegs else 1) + 0.5)  # space for the jaws of callipers
            letters.append(centred(label, LETTERS_MM).translate((x, line)))
            (pegs if row.pegs else cut).append((disc if row.pegs else hole)(diameter, (x, middle)))
    y = line - MARGIN_MM
    size = left + COLUMNS * across, -y
    plate = rectangle(size, (size[0] / 2.0, y / 2.0), MARGIN_MM)
    solid = Stack.of([(0.0, GAUGE_MM, plate - union(cut)), (0.0, GAUGE_MM + PEG_HEIGHT_MM, union(pegs))])
    return solid.minus([engraving(GAUGE_MM, union(letters))])


def _offsets(low_mm: float, high_mm: float) -> tuple[float, ...]:
    """Return multiples of a step from `BEYOND` steps below a fit to as many above another.

    The step is `STEP_MM`, doubled until there are at most `LONGEST_SERIES`.
    """
    step = STEP_MM
    while (count := round((high_mm - low_mm) / step) + 1 + 2 * BEYOND) > LONGEST_SERIES:
        step *= 2.0
    first = math.floor(low_mm / step + 0.5) - BEYOND
    return tuple(round((first + number) * step, 3) for number in range(count))


def centred(label: str, height_mm: float) -> Region:
    """Return letters of a height, centred at x = 0."""
    letters = text(label, height_mm)
    left, _, right, _ = letters.bounds()
    return letters.translate((-(left + right) / 2.0, 0.0))


def engraving(top_mm: float, letters: Region) -> tuple[float, float, Region]:
    """Return letters as a slab to engrave into a top face."""
    return top_mm - ENGRAVED_MM, top_mm, letters
