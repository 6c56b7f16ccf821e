"""Shared sizes, from what they are said to follow from: norms of fasteners, printed lines and layers, other sizes."""

from support.each import each

from jumpcad import dimensions
from jumpcad.dimensions import unit_of_key


def test_gravity_is_the_standard_one_rounded() -> None:
    assert round(9.80665, 2) == dimensions.GRAVITY_M_S2


@each(
    ("key", "unit"),
    [("stiffness_nmm_per_deg", "N·mm/°"), ("rate_nm_per_rad", "N·m/rad"), ("rate_n_per_mm", "N/mm"), ("mass_g", "g"),
     ("density_g_cm3", "g/cm³"), ("price_eur_per_kg", "EUR/kg"), ("pad_area_mm2", "mm²"), ("bed_mm", "mm"),
     ("limit_nm", "N·m"), ("capacity_mah", "mAh"), ("stall_ma", "mA"), ("bears_a", "A"), ("name", ""), ("mm", "")],
)  # fmt: skip
def test_a_key_says_its_unit(key: str, unit: str) -> None:
    assert unit_of_key(key) == unit
