"""Reading workshops: what a file may leave out, what it builds on, and what it may not name."""

import re

import pytest
from support.each import each

from jumpcad.catalogue import load_catalogue
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names, to_toml
from jumpcad.workshop import Workshop, load_workshop


@pytest.mark.parametrize("name", template_names("printers"))
def test_every_shipped_printer_can_be_chosen(name, written):
    fine = 'base = "fine"\n' if name.endswith("0.25") else ""
    assert load_workshop(written(f'{fine}printer = "{name}"')).printer.bed_mm[0] >= 180.0


def test_published_sizes_of_beds_and_densities():
    assert load_workshop("default").printer.bed_mm == (250.0, 210.0, 220.0)
    assert load_workshop("default").material("links").density_g_cm3 == 1.27
    assert load_workshop("default").material("body").density_g_cm3 == 1.24
    assert load_workshop("fine").printer.bed_mm == (180.0, 180.0, 180.0)


def test_a_file_overrides_any_subset(written):
    base = load_workshop("default")
    workshop = load_workshop(written("[fits]\nloose_mm = 0.35\n[materials.PETG]\ndensity_g_cm3 = 1.23\n"))
    assert workshop.fits == base.fits.model_copy(update={"loose_mm": 0.35})
    assert workshop.material("links") == base.material("links").model_copy(update={"density_g_cm3": 1.23})
    assert workshop.process == base.process


def test_files_build_on_each_other_by_relative_path(written):
    written("[fits]\nloose_mm = 0.4\n", "below.toml")
    assert load_workshop(written('base = "below.toml"\n[fits]\nsliding_mm = 0.25\n')).fits.loose_mm == 0.4


def test_a_printer_may_be_changed_in_part(written):
    printer = load_workshop(written("[printer]\nbed_mm = [100, 100, 100]\n")).printer
    assert (printer.bed_mm, printer.nozzle_mm) == ((100.0, 100.0, 100.0), 0.4)


@pytest.mark.parametrize("name", ["PA12", "pa12"])
def test_a_shipped_material_keeps_what_is_not_said_otherwise(written, name):
    """The default workshop prints nothing in PA12, of which only density and modulus are general."""
    strength = "strength_in_plane_mpa = 41.0\nstrength_interlayer_mpa = 23.0\n"
    text = f'[roles]\nlinks = "{name}"\n[materials.{name}]\n{strength}modulus_mpa = 1250.0\n'
    material = load_workshop(written(text)).material("links")
    assert (material.strength_in_plane_mpa, material.strength_interlayer_mpa) == (41.0, 23.0)
    assert (material.modulus_mpa, material.density_g_cm3) == (1250.0, 1.01)


def test_materials_of_ones_own_and_weighed_parts(written):
    text = """
    [roles]
    links = "ABS"
    [materials.ABS]
    density_g_cm3 = 1.04
    strength_in_plane_mpa = 35.0
    strength_interlayer_mpa = 15.0
    modulus_mpa = 1900.0
    [mass.weighed_g]
    foot = 11.2
    """
    workshop = load_workshop(written(text))
    assert sorted(workshop.materials) == ["ABS", "PETG", "PLA"]
    assert (workshop.material_name("links"), workshop.mass.weighed_g) == ("ABS", {"foot": 11.2})


@each("section", Workshop.model_fields)
def test_a_section_that_is_no_table_is_told_in_words(section, written):
    if section == "printer":  # alone it names a printer
        return
    with pytest.raises(JumpcadError, match=rf"my.toml:1: {section} = 'PLA': must be a table: \[{section}\]"):
        load_workshop(written(f'{section} = "PLA"'))
    with pytest.raises(JumpcadError, match=r"roles = 'PLA': must be a table: \[roles\] with links, body, gears$"):
        load_workshop(written('roles = "PLA"'))


def test_a_chain_of_workshops_has_an_end(written):
    for number in range(1500):
        written(f'base = "{number + 1}.toml"\n', f"{number}.toml")
    with pytest.raises(JumpcadError, match="more than 20 workshops build on each other"):
        load_workshop(written("", "0.toml").with_name("1.toml"))
    assert load_workshop(written("", "1499.toml").with_name("1490.toml")) == load_workshop("default")


@pytest.mark.parametrize("files", [1, 2, 3, 4])
def test_files_that_build_on_each_other_in_a_circle_are_told(files, written):
    for number in range(files):
        path = written(f'base = "{(number + 1) % files}.toml"\n', f"{number}.toml")
    with pytest.raises(
        JumpcadError, match=rf"{files - 1}\.toml: base = '0\.toml': leads back to a file that builds on"
    ):
        load_workshop(path.with_name("0.toml"))


def test_an_unknown_workshop_is_refused_with_the_known_ones():
    with pytest.raises(
        JumpcadError, match="one of the workshops best-jumper, best-steered, default, fine, first-robot, light"
    ):
        load_workshop("kitchen")


def test_a_part_of_ones_own_is_whole_or_like_a_shipped_one(written):
    """What is like another has its figures but for those of its own, and a source of its own."""
    shipped = load_catalogue().pads["rubber-2"].model_dump(exclude={"name"})
    whole = shipped | {"thickness_mm": 1.8, "source": "measured"}
    like = {"like": "rubber-2", "thickness_mm": 1.8, "source": "measured"}
    found = load_workshop(written(to_toml({"pads": {"whole": whole, "like": like}}))).pads
    assert found["whole"].model_dump(exclude={"name"}) == found["like"].model_dump(exclude={"name"}) == whole


def test_a_kit_brings_its_parts_and_the_file_may_choose_others(written):
    kit = load_catalogue().kits["strong-2s"]
    bought = load_workshop(written('[bought]\nkit = "strong-2s"\n')).bought
    assert (bought.battery, bought.regulator) == (kit.battery, kit.regulator) != ("", "")
    other = load_workshop(written('[bought]\nkit = "strong-2s"\nregulator = ""\n')).bought
    assert (other.battery, other.regulator) == (kit.battery, "")


@each(
    ("text", "message"),
    [
        (
            '[roles]\nlinks = "pettg"',
            r"'pettg' is neither a table under \[materials\] nor one of .*did you mean petg\?",
        ),
        ("[materials.PTEG]\nmodulus_mpa = 1.0", r"materials.PTEG: no role uses it.*did you mean PETG\?"),
        (
            "[materials.pla]\nmodulus_mpa = 3000.0",
            r"materials.pla: no role uses it.* PETG, PLA \(did you mean PLA\?\)$",
        ),
        ('printer = "mk5"', r"'mk5' is neither a TOML file nor one of the printers .*did you mean mk4\?"),
        ('base = "my.toml"', r"leads back to a file that builds on it"),
        ('[pads.own]\nlike = "rubber-3"', r"pads.own.like = 'rubber-3': is no shipped part of this kind .*rubber-2"),
        ('[pads.own]\nlike = "x"', rf"is no shipped part of this kind \({', '.join(load_catalogue().pads)}\)$"),
        ("[pads.own]\nlike = 2", r"pads.own.like = 2: is no shipped part of this kind"),
        ('[bought]\nkit = "strong-3s"', r"bought.kit = 'strong-3s': is none of the kits .*did you mean strong-2s\?"),
        ("[bought]\nkit = 2", r"bought.kit = 2: is none of the kits"),
        ("base = 3", r"base = 3: must be the name of a workshop or a path"),
        ("[materials]\nPETG = 3", r"my.toml:2: materials.PETG = 3: must be a table: \[materials.PETG\] with density_"),
        ('[pads.own]\nlike = "rubber-2"', r"pads.own.source: missing: say where the figures come from"),
    ],
)
def test_a_base_printer_or_material_that_is_not_there_is_one_line(text, message, refusal):
    assert re.search(message, refusal(text))


@each(
    ("base", "own", "named"),
    [
        ("[body]\nplate = 3", "", r"base.toml:2: body.plate: unknown key"),
        ("[body]\nplate_mm = 99.0", "[body]\nstop_pad = 'x'", r"base.toml:2: body.plate_mm = 99.0"),
        ("[body]\nplate_mm = 99.0", "body.plate_mm = 98.0", r"my.toml:2: body.plate_mm = 98.0"),
        ("", "[body]\nplate = 3", r"my.toml:3: body.plate: unknown key"),
        ("body = {plate = 3}", "", r"base.toml: body.plate: unknown key"),
        ("printer = 'PRINTER'", "", r"printer.toml:2: printer.nozzle: unknown key"),
    ],
)
def test_a_wrong_key_is_told_with_the_file_that_has_it(written, refusal, base, own, named):
    printer = written("name = 'mine'\nnozzle = 0.4\nbed_mm = [200, 200, 200]\n", "printer.toml")
    written(base.replace("PRINTER", str(printer)) + "\n", "base.toml")
    assert re.search(rf"(^|/)({named})", refusal(f"base = 'base.toml'\n{own}\n"))
