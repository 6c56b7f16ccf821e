"""Text as a reader of Markdown sees it."""

from jumpcad.files.markdown import plain


def test_signs_are_escaped_and_all_else_stays() -> None:
    assert plain("a|b <i> `x` [y] & \\") == r"a\|b \<i> \`x\` \[y\] \& " + "\\\\"
    assert plain("3 mm, 4 * 5_6 #1") == "3 mm, 4 * 5_6 #1"
