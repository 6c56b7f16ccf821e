"""Workshops as users write them."""

from collections.abc import Callable
from pathlib import Path

import pytest

from jumpcad.errors import JumpcadError
from jumpcad.workshop import load_workshop


@pytest.fixture
def written(tmp_path: Path) -> Callable[..., Path]:
    """Return a function that writes `my.toml`, or a file of another name."""

    def write(text: str, name: str = "my.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def refusal(written: Callable[..., Path]) -> Callable[[str], str]:
    """Return a function that returns the one line that rejects a workshop."""

    def refuse(text: str) -> str:
        with pytest.raises(JumpcadError) as caught:
            load_workshop(written(text))
        assert "\n" not in str(caught.value)
        assert caught.value.exit_code == 2
        return str(caught.value)

    return refuse
