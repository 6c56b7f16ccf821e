"""Workshops that make no sense, or in which nothing can be made: one line that names a way out, and no bundle."""

import re
from pathlib import Path

from support.commands import Run
from support.each import each

WRONG = {
    "clearance beyond the wall": ("[fits]\nsliding_mm = -0.9", r"w.toml:2: fits.sliding_mm = -0.9: must be at least"),
    "clearances out of order": ("[fits]\nsliding_mm = 0.05", r"must be at least fits.press_mm = 0.1, the tighter fit"),
    "no nozzle": ("[printer]\nnozzle_mm = 0", r"w.toml:2: printer.nozzle_mm = 0: must be at least 0.1"),
    "no bed": ("[printer]\nbed_mm = [0, 200, 200]", r"printer.bed_mm.0 = 0: must be at least 10"),
    "unknown motor": ('[bought]\nmotors = ["n20-99"]', r"n20-99.: is no motor in the catalogue: choose .*did you mean"),
    "negative backlash": ("[fits]\nbacklash_circumferential_mm = -0.2", r"= -0.2: must be at least 0"),
    "axle without bearing": ("[bought]\naxle_mm = 4", r"bought.axle_mm = 4: change one of them, or run the hub on its"),
    "axle without spacer": (
        '[bought]\naxle_mm = 5\nleg_bearing = ""',
        r"bought.axle_mm = 5 is more than 4.4, the most with which spacers of 6.4 mm keep a .*: use a thinner axle",
    ),
}
HOPELESS = {
    "bed smaller than the cam": (
        "[printer]\nbed_mm = [20, 20, 20]",
        r"part \w+ of [\d.×]+ mm does not fit the bed of 20.0×20.0×20.0 mm at any angle: choose a larger printer",
    ),
    "motor that turns the cam at no ratio": (
        '[bought]\nmotors = ["n20-30"]\n[safety]\nmotor_stall_share = 0.01',
        r"no motor turns the cam: it needs \d+ mN·m, the strongest allowed motor may give [\d.]+ mN·m, and no .*: "
        r"lower stiffness_nmm_per_deg or compression_ratio, or allow a stronger motor",
    ),
}
CASES = {name: (*case, 2) for name, case in WRONG.items()} | {name: (*case, 1) for name, case in HOPELESS.items()}


@each("case", CASES)
def test_a_workshop_that_cannot_be_is_one_line_and_nothing_written(run: Run, tmp_path: Path, case: str) -> None:
    text, words, exit_code = CASES[case]
    (tmp_path / "w.toml").write_text(text)
    code, out, err = run("build", "kenan-2.0", "--workshop", "w.toml", "--no-pictures")
    assert (code, out) == (exit_code, "")
    assert err.startswith("jumpcad: ")
    assert err.count("\n") == 1
    assert re.search(words, err), err
    assert [path.name for path in tmp_path.iterdir()] == ["w.toml"]
