"""Interrupts that wait for the end of a block, and one that a library took for an error."""

import signal
from collections.abc import Iterator

import pytest

from jumpcad import process
from jumpcad.process import deferred_interrupts, raise_if_seen

pytestmark = pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="no masks of signals on Windows")


@pytest.fixture(autouse=True)
def none_seen(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Begin without an interrupt, with Python's own handler: what runs in the background ignores them."""
    monkeypatch.setattr(process, "seen", [])
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def blocked() -> bool:
    return signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, set())


def test_an_interrupt_in_a_block_comes_at_its_end() -> None:
    """Ctrl-C waits, also in a block within it, and is there when the outer one has ended."""
    steps = []
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012  what is reached is the point
        with deferred_interrupts():
            assert (blocked(), len(process.deferring)) == (True, 1)
            with deferred_interrupts():
                signal.raise_signal(signal.SIGINT)  # to this thread
                steps.append("inner")
            assert (blocked(), len(process.deferring)) == (True, 1)
            steps.append("outer")
        steps.append("after it")
    assert steps == ["inner", "outer"]
    assert (blocked(), process.deferring) == (False, [])


def test_what_the_command_has_seen_is_raised_at_the_end_of_a_block() -> None:
    """Its handler only writes it down meanwhile."""
    with pytest.raises(KeyboardInterrupt), deferred_interrupts():
        process.seen.append(signal.SIGINT)
    with deferred_interrupts():
        process.seen.clear()


def test_an_error_in_a_block_is_not_hidden_by_an_interrupt() -> None:
    with pytest.raises(ZeroDivisionError), deferred_interrupts():  # noqa: PT012  the interrupt comes first
        process.seen.append(signal.SIGINT)
        _ = 1 / 0
    assert (blocked(), process.deferring) == (False, [])


def test_a_command_that_was_interrupted_ends_where_it_is_asked() -> None:
    raise_if_seen()
    process.seen.append(signal.SIGTERM)
    with pytest.raises(KeyboardInterrupt):
        raise_if_seen()
