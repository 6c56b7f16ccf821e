"""The studio's server: on this computer alone, for whoever has its address, and for its own page alone."""

import contextlib
import hmac
import http.client
import io
import logging
import secrets
from collections.abc import Callable
from dataclasses import replace
from http import HTTPStatus
from typing import Any

import viser
from websockets.asyncio import server as sockets
from websockets.http11 import Request

from jumpcad.errors import JumpcadError

REFUSED = "Open the whole address that `jumpcad studio` printed.\n"
Process = Callable[[sockets.ServerConnection, Request], Any]


class OwnServer(viser.ViserServer):
    """A running server whose page and web socket lie below a token, which other users of this computer do not know.

    Browsers let any page connect to a web socket of this computer and say which page it was (RFC 6455, 10.2): only the
    studio's own may. The token is part of the path; a cookie would be sent to every port of this computer.
    """

    def __init__(self, port: int) -> None:
        self._token = secrets.token_urlsafe(24)
        logging.getLogger("websockets").setLevel(logging.CRITICAL)  # a connection that is no web socket is no bug
        theirs = sockets.serve

        def guarded(*given: Any, process_request: Process, **options: Any) -> sockets.serve:
            return theirs(*given, process_request=self._checked(process_request), **options)

        try:
            sockets.serve = guarded  # type: ignore[assignment, misc]  # viser takes it there, and hands on no options
            with contextlib.redirect_stdout(io.StringIO()):  # its banner has an address too
                super().__init__(host="127.0.0.1", port=port, label="jumpcad studio", verbose=False)
        finally:
            sockets.serve = theirs  # type: ignore[misc]
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", self.get_port(), timeout=10.0)) as anybody:
            anybody.request("GET", "/")
            status = anybody.getresponse().status
        if status != HTTPStatus.FORBIDDEN:
            self.stop()
            raise JumpcadError(f"the studio cannot guard its page with viser {viser.__version__}: install viser 1.1")

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.get_port()}/{self._token}/"

    def _checked(self, answer: Process) -> Process:
        """Return what answers requests below the token, from no page or the own one, as `answer` does; else 403."""

        def process(connection: sockets.ServerConnection, request: Request) -> Any:
            token, _, rest = request.path.removeprefix("/").partition("/")
            pages = [None, *(f"http://{host}:{self.get_port()}" for host in ("127.0.0.1", "localhost"))]
            known = hmac.compare_digest(token.partition("?")[0].encode(), self._token.encode())
            if not known or request.headers.get("Origin") not in pages:
                return connection.respond(HTTPStatus.FORBIDDEN, REFUSED)
            found = answer(connection, replace(request, path=f"/{rest}"))
            if found is not None:
                found.headers["Referrer-Policy"] = "no-referrer"  # nor do links tell the token
            return found

        return process
