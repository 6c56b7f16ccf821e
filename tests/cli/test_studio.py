"""What the studio opens: a bundle in the workshop that it was built in."""

from support.places import ROOT

from jumpcad.cli.studio import _design
from jumpcad.design import load_design
from jumpcad.workshop import load_workshop


def test_a_bundle_brings_its_own_workshop() -> None:
    design, workshop = _design(str(ROOT / "exports" / "kenan-2.0"), None)
    assert design == load_design("kenan-2.0")
    assert workshop == str(ROOT / "exports" / "kenan-2.0" / "workshop.toml")
    assert load_workshop(workshop).printer == load_workshop().printer


def test_a_template_comes_in_the_default_workshop() -> None:
    assert _design("best-bo", None) == (load_design("best-bo"), "default")
