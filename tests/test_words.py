"""Pages that users read are written in sentences of at most 34 words and 6 figures.

Code, headings, tables and the parts of a step are left out. Items of lists may have more figures, but not more words.
"""

import re
from collections.abc import Iterator

from support.places import ROOT

MOST_WORDS, MOST_FIGURES = 34, 6
PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    ROOT / "CONTRIBUTING.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "decisions").glob("*.md")),
    *sorted((ROOT / "exports").rglob("*.md")),
]
NO_TEXT = re.compile(r"^(`{3,}).*?^\1|^#.*?$|^\|.*?$|^\*[^*]+\*$", re.S | re.M)
UNSEEN = re.compile(r"<!--.*?-->|!\[[^]]*\]\(.*?\)|(?<=\])\(.*?\)", re.S)
ITEM = re.compile(r"\s*(?:[-*]|\d+\.) ")
END = re.compile(r"(?<=[.!?])[*_”\"')]*\s+(?=[^a-z\s])")
FIGURE = re.compile(r"\d+(?:[.,]\d+)*")


def sentences(page: str) -> Iterator[tuple[str, bool]]:
    """Yield the sentences of a page, and whether each stands in a list."""
    for block in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", NO_TEXT.sub("\n\n", UNSEEN.sub("", page))):
        for sentence in END.split(" ".join(block.split())):
            yield sentence, ITEM.match(block + " ") is not None


def too_long(page: str) -> list[str]:
    """Return the sentences of a page that a reader would have to read twice."""
    return [
        f"{words} words, {figures} figures: {sentence}"
        for sentence, listed in sentences(page)
        for words in [len(sentence.split())]
        for figures in [0 if listed else len(FIGURE.findall(re.sub("`[^`]*`", "", sentence)))]
        if words > MOST_WORDS or figures > MOST_FIGURES
    ]


def test_no_sentence_has_to_be_read_twice() -> None:
    found = {str(page.relative_to(ROOT)): too_long(page.read_text(encoding="utf-8")) for page in PAGES}
    assert {name: sentences for name, sentences in found.items() if sentences} == {}


def test_long_sentences_and_many_figures_are_seen() -> None:
    ends = "It is so (see there). `This` too: a.b, 0.5 mm.\n"
    assert too_long(ends * 30) == []
    assert len(too_long(f"Short.\n{'word ' * 34}long. Short.")) == 1
    assert len(too_long(f"- short\n- {'word ' * 34}long")) == 1
    assert len(too_long("It has 1, 2, 3, 4, 5, 6 and 7.5 of them.")) == 1
    many = "1 2 3 4 5 6 7 8"
    assert too_long(f"- It has {many}.\n\n| {many} |\n\n```\n{many}\n```\n") == []
