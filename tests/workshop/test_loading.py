"""Workshops: what a file may leave out, what it may not say, and how it is told."""

import json
from dataclasses import FrozenInstanceError

import pytest
from pydantic import ValidationError

import jumpcad
from jumpcad.errors import JumpcadError
from jumpcad.files import template_names, to_toml
from jumpcad.workshop import Workshop, load_workshop


@pytest.fixture
def written(tmp_path):
    def write(text, name="my.toml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.mark.parametrize("name", template_names("workshops"))
def test_a_written_workshop_reads_back_the_same(name, written):
    workshop = load_workshop(name)
    path = written(workshop.to_toml())
    assert load_workshop(path) == workshop
    assert load_workshop(path).to_toml() == workshop.to_toml()


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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[printer]\nnozzle_mm = 0", r"my.toml:2: printer.nozzle_mm = 0: must be at least 0.1"),
        (
            "[process]\nlayer_height_mm = 0.35",
            r"my.toml:2: process.layer_height_mm = 0.35: must be at most 0.32",
        ),
        ("[process]\nline_width_mm = 0.2", r"nozzle of 0.4 mm lays lines of 0.32…0.8 mm"),
        ("[process]\ninfill = nan", r"process.infill = nan: must be a finite number"),
        ("[fits]\nwall_mm = 0.85", r"fits.wall_mm = 0.85: must be at least 0.9, two lines"),
        ("[fits]\npress_mm = -0.6", r"fits.press_mm = -0.6: must be at least -0.2"),
        ("[fits]\nsliding_mm = 0.05", r"fits.sliding_mm = 0.05: must be at least fits.press_mm = 0.1"),
        (
            "[fits]\nm3_tap_mm = 3.1\nm3_clearance_mm = 3",
            r"fits.m3_clearance_mm = 3.0: must be at least fits.m3_tap_mm = 3.1",
        ),
        ("[fits]\nfirst_layer_chamfer_mm = 0.7", r"leaves nothing of a wall of 1.2: must be less than 0.6"),
        ("[fits]\nlose_mm = 0.4", r"fits.lose_mm: unknown key \(did you mean loose_mm\?\)"),
        ('[roles]\nlinks = "PA12"', r"materials.PA12.strength_in_plane_mpa: missing"),
        (
            '[roles]\nlinks = "pettg"',
            r"'pettg' is neither a table under \[materials\] nor one of .*did you mean petg\?",
        ),
        ("[materials.PTEG]\nmodulus_mpa = 1.0", r"materials.PTEG: no role uses it.*did you mean PETG\?"),
        ('printer = "mk5"', r"'mk5' is neither a TOML file nor one of the printers .*did you mean mk4\?"),
        ('base = "my.toml"', r"leads back to a file that builds on it"),
        ("base = 3", r"base = 3: must be the name of a workshop or a path"),
        ("process = 3", r"process = 3: must be"),
        ("[mass.weighed_g]\nfoot = -1", r"weighed_g.foot = -1: must be more than 0"),
        ("[prices_eur]\nnut = 0", r"prices_eur.nut = 0: must be more than 0"),
        ("[materials.PETG]\nprice_eur_per_kg = -20.0", r"PETG.price_eur_per_kg = -20.0: must be more than 0"),
        ('[mass]\nmodel = "guess"', r"mass.model = 'guess': must be 'printed' or 'solid'"),
    ],
)
def test_nonsense_is_refused_in_one_line(text, message, written):
    with pytest.raises(JumpcadError, match=message) as caught:
        load_workshop(written(text))
    assert "\n" not in str(caught.value)
    assert caught.value.exit_code == 2


@pytest.mark.parametrize("name", ["PLA", "PA12 CF15", "PETG (grey)", "机器人", "Ähnlich-1.75", "_x"])
def test_names_of_materials_are_of_any_script(name, written):
    text = f'[roles]\nlinks = "{name}"\n[materials."{name}"]\n' + to_toml(
        load_workshop("default").material("links").model_dump(exclude_none=True)
    )
    assert load_workshop(written(text)).material_name("links") == name


@pytest.mark.parametrize(
    "name",
    ["x/../../../report", "x\\y", ".hidden", "=HYPERLINK(1)", "+1", "-1", "@x", "a\u0001", "[/x]", "a\nb", "", " a",
     "a|b", "a<b", "P" * 51, "\u202ex"],
)  # fmt: skip
def test_names_that_could_become_paths_formulas_or_markup_are_refused(name, written):
    quoted = json.dumps(name)  # TOML writes such texts as JSON does
    for text in (
        f"[roles]\nlinks = {quoted}\n[materials.{quoted}]\ndensity_g_cm3 = 1.2\n",
        f"[mass.weighed_g]\n{quoted} = 1.0\n",
        f"[prices_eur]\n{quoted} = 1.0\n",
        f"[bought]\nmotors = [{quoted}]\n",
        f"[bought]\nroller = {quoted}\n",
    ):
        with pytest.raises(JumpcadError, match="a name has 1 to 50 letters, digits, blanks") as caught:
            load_workshop(written(text))
        assert str(caught.value).isprintable()


@pytest.mark.parametrize("text", ["a\x07", "a\x1b[31m", "a\nb", "a\u2028b", "a\u202eb", "a" * 1001])
def test_free_text_is_one_line_that_steers_no_terminal(text, written):
    for key in ("printer.name", "printer.source", "materials.PETG.source"):
        with pytest.raises(JumpcadError, match=f"{key} = .*: (holds the control character U|has 1001 characters)"):
            load_workshop(written(f"{key} = {json.dumps(text)}"))


@pytest.mark.parametrize("section", Workshop.model_fields)
def test_a_section_that_is_no_table_is_told_in_words(section, written):
    if section == "printer":  # alone it names a printer
        return
    with pytest.raises(JumpcadError, match=rf"my.toml:1: {section} = 'PLA': must be a table: \[{section}\]"):
        load_workshop(written(f'{section} = "PLA"'))
    with pytest.raises(JumpcadError, match=r"roles = 'PLA': must be a table: \[roles\] with links, body, gears$"):
        load_workshop(written('roles = "PLA"'))


def test_fits_that_no_printer_needs_are_refused(written):
    fits = ("press_mm", "sliding_mm", "loose_mm", "hole_allowance_diameter_mm")
    with pytest.raises(JumpcadError) as caught:
        load_workshop(written("[fits]\n" + "".join(f"{key} = -0.5\n" for key in fits)))
    assert all(f"fits.{key} = -0.5: must be at least" in str(caught.value) for key in fits)


def test_a_chain_of_workshops_has_an_end(written):
    for number in range(1500):
        written(f'base = "{number + 1}.toml"\n', f"{number}.toml")
    with pytest.raises(JumpcadError, match="more than 20 workshops build on each other"):
        load_workshop(written("", "0.toml").with_name("1.toml"))
    assert load_workshop(written("", "1499.toml").with_name("1490.toml")) == load_workshop("default")


def test_links_that_lead_round_in_a_circle(written):
    path = written('base = "loop.toml"\n')
    path.with_name("loop.toml").symlink_to("loop.toml")
    with pytest.raises(JumpcadError, match="loop"):
        load_workshop(path)


def test_an_unknown_workshop_is_refused_with_the_known_ones():
    with pytest.raises(JumpcadError, match="one of the workshops default, fine, light"):
        load_workshop("kitchen")


def test_a_workshop_cannot_be_changed():
    workshop = jumpcad.load_workshop()
    assert isinstance(workshop, Workshop)
    with pytest.raises((ValidationError, FrozenInstanceError)):
        workshop.fits.loose_mm = 1.0
