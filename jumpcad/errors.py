"""What can go wrong because of what a user asked for, in one line of text."""


class JumpcadError(Exception):
    """The request is wrong: one line that names the value, the limit and the way out.

    ``exit_code`` is what the command line returns for it.
    """

    exit_code = 2


class CannotBuildError(JumpcadError):
    """The request is well-formed, but the answer is no: this design cannot work or cannot be made."""

    exit_code = 1
