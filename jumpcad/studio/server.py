"""The studio's server: on this computer alone, and for its own page alone."""

import contextlib
import functools
import io
import logging
import re
from collections.abc import Iterator
from unittest.mock import patch

import viser

OWN_PAGES = re.compile(r"http://(127\.0\.0\.1|localhost)(:\d+)?")
"""Origins of pages that this computer serves; a program that is no browser names none."""


def own_server(port: int) -> "viser.ViserServer":
    """Return a running server that pages from elsewhere, open in the same browser, cannot reach.

    Browsers let any page connect to a web socket of this computer and say which page it was (RFC 6455, 10.2).
    """
    logging.getLogger("websockets").setLevel(logging.CRITICAL)  # a connection that is no web socket is no bug
    with contextlib.redirect_stdout(io.StringIO()), _origins_checked():  # its banner has the address too
        return viser.ViserServer(host="127.0.0.1", port=port, label="jumpcad studio", verbose=False)


@contextlib.contextmanager
def _origins_checked() -> Iterator[None]:
    """Let the server that viser starts meanwhile check origins, for which viser has no option of its own."""
    from websockets.asyncio import server

    with patch.object(server, "serve", functools.partial(server.serve, origins=[None, OWN_PAGES])):
        yield
