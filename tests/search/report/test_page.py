"""The page of a study: valid, self-contained, the same bytes, and what the study holds."""

import re
import shlex
from dataclasses import replace
from functools import cache
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest
from support.bumps import REST, Bump, studied
from support.shops import SHOP, Shop
from support.studies import IDENTITY, trials

from jumpcad.design import load_design
from jumpcad.search.fronts import SPRING_ENERGY, front, hypervolume
from jumpcad.search.report import page as study_page
from jumpcad.search.report.figures import PICTURES
from jumpcad.search.report.page import _moments, plot_study, write_study_page
from jumpcad.search.report.shown_design import LINKS, joints_mm
from jumpcad.search.robust_pick import Candidate
from jumpcad.search.space import Space
from jumpcad.search.study.objective import Evaluation, find_objective
from jumpcad.search.study.pool import local_pool
from jumpcad.search.study.request import Request
from jumpcad.search.study.run import run_study
from jumpcad.search.study.store import StudyStore
from jumpcad.search.study.summary import StudySummary
from jumpcad.search.study.trial import Trial, write_table
from jumpcad.search.study.variant import Tolerances

SPACE = Space.parse(fix=REST, bound=["compression_ratio=0.1:0.8"])


class Never(Bump):
    """No design jumps."""

    def __call__(self, design):
        return Evaluation("too_weak")


class Below(Bump):
    """Scores are negative."""

    def __call__(self, design):
        found = super().__call__(design)
        return Evaluation(found.verdict, {name: value - 100.0 for name, value in found.metrics.items()})


def parsed(page):
    """Return the page's tree; any tag that is not closed, and any stray character, is an error."""
    return ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))


def text(element):
    return "".join(element.itertext())


def tables(page):
    """Return the rows of every table by its first heading."""
    found = {}
    for table in parsed(page).iter("table"):
        rows = [[text(cell) for cell in row] for row in table.iter("tr")]
        found.setdefault(rows[0][0], rows)
    return found


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    folder = tmp_path_factory.mktemp("studies")
    for method, evaluations in (("bo", 40), ("nsga2", 60), ("ga", 60)):
        studied(folder / f"{method}.db", SPACE, method, evaluations).close()
    return folder


@cache
def known_page_of(path):
    return page_of(path)


def page_of(path, name="study"):
    with StudyStore.read(path) as store:
        return write_study_page(store, name)


@pytest.mark.thorough
def test_is_xml_that_asks_for_nothing_else(studies):
    for method in ("bo", "nsga2", "ga"):
        page = known_page_of(studies / f"{method}.db")
        root = parsed(page)
        without_pictures = re.sub(r'src="data:[^"]*"', "", page)
        assert re.findall(r"https?:|src=|url\(|@import", without_pictures) == []
        links = {unquote(link.get("href")) for link in root.iter("a")}
        named = {f"#{element.get('id')}" for element in root.iter() if element.get("id")}
        assert links, method
        assert links <= named


def test_the_same_study_has_the_same_page(studies):
    """Of a front: it has the most on it. The pictures of both kinds of search are drawn again below."""
    assert page_of(studies / "nsga2.db") == known_page_of(studies / "nsga2.db")


def test_says_what_was_asked_and_found(studies):
    page = known_page_of(studies / "bo.db")
    found = tables(page)
    asked = {row[0]: row for row in found["parameter"]}
    assert asked["compression_ratio"][2] == "0.1 … 0.8"
    assert asked["carrying_link_mm"][1:] == ["length of the main leg, l2", "fixed at 100 mm", "100 mm"]
    assert float(asked["compression_ratio"][3]) == pytest.approx(0.5, abs=0.05)  # the top of the bump
    cards = cards_of(page)
    assert (cards["method"], cards["robot"], cards["seed"]) == ("bo", "bump", "0")
    with StudyStore.read(studies / "bo.db") as store:
        searched = [trial for trial in store.trials() if trial.phase == "bo"]
        around = len(store.trials()) - len(searched)
    assert int(cards["designs of the search"]) == len(searched)
    assert int(cards["designs around the best"]) == around > 0
    ((reason, meaning, _, count),) = found["reason"][1:]
    assert (reason, count) == ("loop", str(sum(trial.design.compression_ratio > 0.7 for trial in searched)))
    assert "do not reach each other" in meaning
    best = found["design"][1]
    assert float(best[2]) == pytest.approx(9.0, abs=0.05)
    assert "of" in best[5]  # rejected of its neighbours


def test_a_design_is_found_in_the_exported_table_by_the_trials_number(studies, tmp_path):
    """Heading, point, line and command name the same trial; the page opens on the highest score."""
    for method in ("nsga2", "bo"):
        file = studies / f"{method}.db"
        with StudyStore.read(file) as store:
            write_table(store.trials(), tmp_path / f"{method}.csv")
        heading, *lines = (tmp_path / f"{method}.csv").read_text().splitlines()
        column = heading.split(",").index("compression_ratio")
        page = known_page_of(file)
        root = parsed(page)
        points = list(next(root.iter("svg")).iter("a"))
        rows = [row[:3] for row in tables(page)["design"][1:]]
        sections = [one for one in root.iter("section") if one.get("class") == "design"]
        for section, point, (design, trial, _) in zip(sections, points, rows, strict=True):
            assert section.findtext("h3").startswith(f"Design {design} (trial {trial}):")
            assert point.get("aria-label") == point.findtext("title")
            assert point.get("aria-label").startswith(f"design {design} (trial {trial}):")
            assert shlex.split(section.findtext("p/code")) == ["jumpcad", "studio", str(file), "--trial", trial]
            shown = {text(row[0]): text(row[1]) for row in section.iter("tr")}
            assert float(shown["compression_ratio"]) == pytest.approx(
                float(lines[int(trial) - 1].split(",")[column]), rel=1e-4
            )
        design, trial, _ = max(rows, key=lambda row: float(row[2])) if method == "nsga2" else rows[0]
        assert next(one for one in root.iter("div") if one.get("id") == "robots").get("data-first") == design
        assert f"The page opens on design {design} (trial {trial}), the" in " ".join(page.split())


def test_shown_designs_are_drawn_at_their_joints_to_one_scale(studies):
    """Every link is a line between its joints, upwards counted down as SVG does; all lies in one common box."""
    with StudyStore.read(studies / "nsga2.db") as store:
        best = front([trial for trial in store.trials() if trial.phase == "nsga2"])
    sides = [svg for svg in parsed(known_page_of(studies / "nsga2.db")).iter("svg") if svg.get("class") == "side"]
    assert len(sides) == len(best) > 3
    boxes = set()
    for svg, trial in zip(sides, best, strict=True):
        boxes.add(svg.get("viewBox"))
        left, top, width, height = map(float, svg.get("viewBox").split())
        for group, (pose, at) in zip(svg.iter("g"), joints_mm(trial.design).items(), strict=True):
            assert group.get("class") == pose
            for path, ends in zip(group.iter("path"), LINKS.values(), strict=True):
                wanted = [number for end in ends for number in (at[end][0], -at[end][1])]
                drawn = [float(number) for number in re.findall(r"-?[\d.]+", path.get("d"))]
                assert drawn == pytest.approx(wanted, abs=0.051)
                assert all(left < x < left + width for x in drawn[::2])
                assert all(top < y < top + height for y in drawn[1::2])
    assert len(boxes) == 1


def test_values_of_the_workshop_are_told_names_by_numbers(tmp_path):
    """The best battery of the shop is the second of two; its plates are best 1.6 mm thick."""
    with local_pool(0) as pool:
        run_study(Request(SHOP, Shop(), method="ga", evaluations=60), tmp_path / "s.db", pool)
    page = page_of(tmp_path / "s.db")
    asked = {row[0]: row for row in tables(page)["parameter"]}
    assert asked["bought.battery"][2:] == ["one of lipo-2s-180, lipo-1s-300", "lipo-1s-300"]
    assert asked["body.plate_mm"][2] == "1.2 … 2.4 mm"
    words = " ".join(text(parsed(page)).split())
    assert "bought.battery: 1 is lipo-2s-180, 2 is lipo-1s-300. Best: lipo-1s-300." in words
    first = next(one for one in parsed(page).iter("section") if one.get("id") == "design-1")
    shown = {text(row[0]): text(row[1]) for row in first.iter("tr")}
    assert shown["bought.battery"] == "lipo-1s-300"
    assert shown["body.plate_mm"][:4] == asked["body.plate_mm"][3][:4]


@pytest.mark.parametrize("model", [Never(), Below()], ids=["nothing jumps", "negative scores"])
def test_studies_without_a_usual_best_have_a_page(tmp_path, model):
    with local_pool(0) as pool:
        run_study(Request(SPACE, model, method="ga", evaluations=30), tmp_path / "s.db", pool)
    page = page_of(tmp_path / "s.db")
    said = text(parsed(page).find("body"))
    if isinstance(model, Never):
        assert "None of" in said
        assert "too_weak" in said
    else:
        assert tables(page)["design"][1][2].startswith("-9")


def test_an_empty_study_and_strange_texts_have_a_page(tmp_path):
    request = Request(SPACE, Bump())
    with StudyStore.write(tmp_path / "s.db", request.identity([])) as store:
        store.note("a <script>alert(1)</script> & \x07 note")
    page = page_of(tmp_path / "s.db", "a <b> & c")
    assert parsed(page).findtext("body/h1") == "a <b> & c"
    assert "a <script>alert(1)</script> &" in text(parsed(page).find("body"))
    assert page.count("<script>") == 1


DESIGN = load_design("best-ga")


def shown_trial(score, place, phase="ga", **changes):
    """Return a trial of best-ga with other parameters that took a quarter of a second."""
    design = DESIGN.model_copy(update=changes)
    verdict = Evaluation("tips") if score is None else Evaluation("jump", {"fitness": score})
    return Trial(phase, 0, place, design, verdict, score, "m", 0.25)


TRIALS = [
    shown_trial(1.5, 0, compression_ratio=0.3), shown_trial(3.25, 1), shown_trial(None, 2, rest_angle_deg=66.0),
    shown_trial(2.0, 3, compression_ratio=0.4),
]  # fmt: skip
PICK = [replace(shown_trial(2.5, 0, "robust", c_coef=1.01), duration_s=2.25)]


def made_up(method="ga", candidates=(), **changes):
    """Return an open study of four trials and one neighbour, and what is known of it."""
    identity = IDENTITY | {"method": method, "space": SPACE.describe(), "seed": 11, "objective": "range"} | changes
    store = StudyStore.write(None, identity)
    store.append([*TRIALS, *PICK])
    store.remember("stages", [{"method": "ga", "evaluations": 3}, {"method": "bo", "evaluations": 4}])
    winner = candidates[0].trial if candidates else TRIALS[1]
    numbers = {trial.position: n for n, trial in enumerate([*TRIALS, *PICK], start=1)}
    return store, StudySummary(SPACE, find_objective("range"), list(TRIALS), winner, list(candidates), [], numbers)


def words(store, found, monkeypatch):
    """Return the words of the page of what is known of a study."""
    monkeypatch.setattr(study_page, "summary", lambda store: found)
    return " ".join(re.sub(r"<[^>]*>", " ", re.sub("<wbr />", "", write_study_page(store, "study"))).split())


def cards_of(page):
    """Return the main data of a study."""
    return {text(card[0]): text(card[1]) for card in parsed(page).iter("div") if len(card) and card[0].tag == "dt"}


def test_the_main_data_of_a_study_stand_on_its_cards(monkeypatch):
    """Designs of the search, of those that were planned, how many jump; those around the best; time of all."""
    store, found = made_up(versions={"numpy": "2.0.1", "code": "0123456789abcdef"})
    candidate = Candidate(TRIALS[3], 1.0, 2.0, {}, 4)
    with store:
        store.note("a worker was lost")
        said = words(store, found, monkeypatch)
        cards = cards_of(write_study_page(store, "study"))
        robust = words(store, replace(found, winner=TRIALS[3], candidates=[candidate]), monkeypatch)
    assert cards == {
        "method": "ga", "robot": "hill", "designs of the search": "4 of 7", "of them jump": "3",
        "designs around the best": "1", "seed": "11", "time of all evaluations": "3 s",
    }  # fmt: skip
    assert "The best of 4 designs: range of the jump 3.25 m." in said
    assert "searched by ga, 3 designs, then bo, 4 designs." in said
    assert "Notes of the run a worker was lost Evaluated with numpy 2.0.1, code 0123456789ab." in said
    assert "The most robust of the best designs: range of the jump 2 m." in robust


def test_a_front_is_told_from_end_to_end_and_where_half_of_it_is_reached(monkeypatch):
    """Scores 1, 1.9, 2.1 and 4: the third is the first with half of the highest; of scores below 0 no half is told."""
    scored = zip((1.0, 1.9, 2.1, 4.0), (0.2, 0.3, 0.4, 0.5), strict=True)
    shown = [shown_trial(score, n, compression_ratio=ratio) for n, (score, ratio) in enumerate(scored)]
    low, half, high = (f"{shown[n].design.spring_energy_j:.3g} J" for n in (0, 2, 3))
    rises = [replace(one, evaluation=Evaluation("jump", {"com_rise_m": 1.0 / (n + 2)})) for n, one in enumerate(shown)]
    below = [replace(one, score=one.score - 9.0) for one in shown]
    for against, these, said in (
        ("spring-energy", shown, f"1 m with {low} to 4 m with {high}; half of the highest score comes with {half}."),
        ("spring-energy", below, f"-8 m with {low} to -5 m with {high}."),
        ("rise", rises, "1 m with 0.5 m to 4 m with 0.2 m; "),
    ):  # fmt: skip
        store, found = made_up("nsga2", against=against)
        numbers = {trial.position: n for n, trial in enumerate(these, start=1)}
        with store:
            assert f"Here it goes from {said}" in words(
                store, replace(found, trials=these, numbers=numbers), monkeypatch
            )


def test_designs_that_are_shown_are_the_front_the_candidates_or_the_best():
    """Of a long front a hundred, evenly chosen, with both ends."""
    _, found = made_up()
    assert study_page._shown(found, None) == [TRIALS[1], TRIALS[3], TRIALS[0]]
    assert study_page._shown(found, SPRING_ENERGY) == [TRIALS[0], TRIALS[3], TRIALS[1]]
    candidate = Candidate(TRIALS[3], 1.0, 2.0, {}, 4)
    assert study_page._shown(replace(found, candidates=[candidate]), None) == [TRIALS[3]]
    alike = shown_trial(3.2, 4, rest_angle_deg=DESIGN.rest_angle_deg + 0.1)  # as the best, but for 0.1°
    assert study_page._shown(replace(found, trials=[*TRIALS, alike]), None) == [TRIALS[1], TRIALS[3], TRIALS[0]]
    many = [shown_trial(1.0 + n, n, compression_ratio=0.2 + 0.001 * n) for n in range(199)]
    places = [trial.place for trial in study_page._shown(replace(found, trials=many), SPRING_ENERGY)]
    assert places == list(range(0, 199, 2))


def test_candidates_stand_in_a_row_with_their_neighbours(monkeypatch):
    """Number, trial, score; what nine of ten reach of both kinds, how many are rejected; energy; free parameters."""
    candidates = [Candidate(TRIALS[3], 1.25, 1.75, {"tips": 2, "loop": 1}, 16), Candidate(TRIALS[1], 0.5, 0.25, {}, 8)]
    making = Tolerances(0.4, rate=0.05, mass=0.04, floor=0.15, printed=True)
    store, found = made_up(candidates=candidates, making=vars(making))
    with store:
        assert "lengths ±0.4 mm, springs ±10 %, mass ±8 %, friction ±30 %" in words(store, found, monkeypatch)
        rows = tables(write_study_page(store, "study"))["design"]
        monkeypatch.setattr(study_page, "summary", lambda store: replace(found, candidates=[]))
        assert "rejected" not in tables(write_study_page(store, "study"))["design"][0]  # nothing is known of neighbours
    energies = [f"{trial.design.spring_energy_j:.4f}" for trial in (TRIALS[3], TRIALS[1])]
    angle = f"{DESIGN.rest_angle_deg:.4g}"
    assert rows == [
        ["design", "trial", "score (m)", "±1 %", "as made", "rejected", "springs (J)", "compression_ratio",
         "rest_angle_deg (°)"],
        ["1", "4", "2", "1.25", "1.75", "3 of 16", energies[0], "0.4", angle],
        ["2", "2", "3.25", "0.5", "0.25", "0 of 8", energies[1], f"{DESIGN.compression_ratio:.4g}", angle],
    ]  # fmt: skip


def test_the_area_of_a_long_front_is_that_of_all_its_designs(monkeypatch):
    """A hundred of them are shown."""
    store, found = made_up("nsga2")
    many = [shown_trial(1.0 + n, n, compression_ratio=0.1 + 0.005 * n) for n in range(150)]
    numbers = {trial.position: n for n, trial in enumerate(many, start=1)}
    whole = replace(found, trials=many, numbers=numbers)
    with store:
        said = words(store, whole, monkeypatch)
    assert f"{hypervolume(many):.4g}" != f"{hypervolume(study_page._shown(whole, SPRING_ENERGY)):.4g}"
    assert f"The area below its line, up to 1.5 J, is {hypervolume(many):.4g} m·J (hypervolume)" in said
    assert "100 of its 150 designs are shown, evenly chosen along it." in said
    assert said.count("jumpcad studio F.db --trial") == 100  # the study is kept in memory: in a file of any name
    assert "The page opens on design 100 (trial 150), the one with the highest score" in said


def test_a_page_has_all_its_sections_in_their_order(studies):
    """A front has no winner, and of its bounds nothing is known; two free parameters have pictures of the process."""
    headings = [text(one) for one in parsed(known_page_of(studies / "bo.db")).iter("h2")]
    assert headings == [
        "The best designs", "What was asked", "History", "Slices", "Parallel lines", "What the method knew at first",
        "What the method knew at last", "Importance", "Active bounds", "Why designs were rejected",
    ]  # fmt: skip
    fronts = [text(one) for one in parsed(known_page_of(studies / "nsga2.db")).iter("h2")]
    assert fronts == [
        "The front", "What was asked", *headings[2:5], "Importance", "Active bounds", "Why designs were rejected"
    ]  # fmt: skip


def pictures(store, folder, names):
    """Return the pictures of a study by their files' names; those that it must have are there."""
    drawn = plot_study(store, folder)
    assert {path.stem for path in drawn} == names <= set(PICTURES)
    assert all(ElementTree.parse(one).getroot().tag.endswith("svg") for one in drawn)
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.thorough
@pytest.mark.usefixtures("quick_proposals")
def test_a_study_has_its_pictures(tmp_path):
    """Of the method that has all kinds."""
    names = {"history", "slices", "parallel", "pareto", "acquisition-first", "acquisition"}
    with studied(tmp_path / "s.db", Space.parse(fix=REST), "pareto") as store:
        pictures(store, tmp_path / "a", names)


@pytest.mark.thorough
@pytest.mark.usefixtures("quick_proposals")
def test_one_free_parameter_has_no_parallel_lines_and_no_front_without_one_and_they_repeat(tmp_path):
    with studied(tmp_path / "s.db", Space.parse(fix=[*REST, "rest_angle_deg=50"])) as store:
        names = {"history", "slices", "acquisition-first", "acquisition"}
        assert pictures(store, tmp_path / "a", names) == pictures(store, tmp_path / "b", names)


def test_the_first_picture_has_what_was_known_before_it_and_the_last_one_every_design():
    """Of five designs the third and the fourth were proposed; what others look at is none of it."""
    proposed = [{}, {}, {"theta": {}}, {"theta": {}}, {}]
    found = [replace(one, phase="bo", proposal=note) for one, note in zip(trials(5), proposed, strict=True)]
    assert _moments(found) == [("acquisition-first", 2, 2), ("acquisition", 3, 5)]
    assert _moments(found[:2]) == _moments([replace(one, phase="robust") for one in found]) == []
