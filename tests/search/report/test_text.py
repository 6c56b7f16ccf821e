"""Tables of a study's page, and one design's figures in the units of its names."""

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.search.report.text import broken, escape_html


def test_texts_are_escaped_and_break_after_underscores() -> None:
    assert escape_html("<b> & c") == "&lt;b&gt; &amp; c"
    with pytest.raises(JumpcadError):  # XML has no way to write it
        escape_html("bell\x07")
    assert broken("body_joint_mm") == "body_<wbr />joint_<wbr />mm"
