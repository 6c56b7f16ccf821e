"""Only the studio's own page may connect: a page from elsewhere in the same browser may not change files here."""

import http.client
from collections.abc import Iterator

import pytest
from support import needs

viser = needs.package("viser")

from jumpcad.studio.server import own_server  # noqa: E402

KEY = "dGhlIHNhbXBsZSBub25jZQ=="
"""Of the example in RFC 6455, 1.3."""


@pytest.fixture(scope="module")
def server() -> Iterator["viser.ViserServer"]:
    made = own_server(0)
    yield made
    made.stop()


def handshake(server: "viser.ViserServer", origin: str | None) -> int:
    """Return the status of a request for a web socket that names an origin."""
    connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=10.0)
    headers = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": KEY,
        "Sec-WebSocket-Protocol": f"viser-v{viser.__version__}",
    } | ({"Origin": origin} if origin is not None else {})  # fmt: skip
    connection.request("GET", "/", headers=headers)
    status = connection.getresponse().status
    connection.close()
    return status


def test_no_other_computer_reaches_it(server: "viser.ViserServer") -> None:
    """It listens at the address of this computer for itself (RFC 6890, 127.0.0.0/8), not at that of its network."""
    assert server.get_host() == "127.0.0.1"


def test_the_own_page_connects(server: "viser.ViserServer") -> None:
    for host in ("127.0.0.1", "localhost"):
        assert handshake(server, f"http://{host}:{server.get_port()}") == 101
    assert handshake(server, None) == 101


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "https://evil.example:8080", "null", "http://127.0.0.1.evil.example:8080",
     "http://localhost.evil.example", "http://evil.example/127.0.0.1:8080", "https://localhost:8080"],
)  # fmt: skip
def test_other_pages_are_refused(server: "viser.ViserServer", origin: str) -> None:
    assert handshake(server, origin) == 403
