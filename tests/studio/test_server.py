"""Only the studio's own page may connect: a page from elsewhere in the same browser may not change files here."""

import http.client
from collections.abc import Iterator
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import urlopen

import pytest
from support import needs

viser = needs.package("viser")

from jumpcad.errors import JumpcadError  # noqa: E402
from jumpcad.studio.server import OwnServer  # noqa: E402

KEY = "dGhlIHNhbXBsZSBub25jZQ=="
"""Of the example in RFC 6455, 1.3."""


@pytest.fixture(scope="module")
def server() -> Iterator[OwnServer]:
    made = OwnServer(0)
    yield made
    made.stop()


def handshake(server: OwnServer, origin: str | None, path: str | None = None) -> int:
    """Return the status of a request for a web socket that names an origin, with the token unless a path is given."""
    connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=10.0)
    headers = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": KEY,
        "Sec-WebSocket-Protocol": f"viser-v{viser.__version__}",
    } | ({"Origin": origin} if origin is not None else {})  # fmt: skip
    connection.request("GET", urlsplit(server.address).path if path is None else path, headers=headers)
    status = connection.getresponse().status
    connection.close()
    return status


def test_no_other_computer_reaches_it(server: OwnServer) -> None:
    """It listens at the address of this computer for itself (RFC 6890, 127.0.0.0/8), not at that of its network."""
    assert server.get_host() == "127.0.0.1"


def test_the_own_page_connects(server: OwnServer) -> None:
    for host in ("127.0.0.1", "localhost"):
        assert handshake(server, f"http://{host}:{server.get_port()}") == 101
    assert handshake(server, None) == 101


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "https://evil.example:8080", "null", "http://127.0.0.1.evil.example:8080",
     "http://localhost:1", "http://localhost.evil.example", "http://evil.example/127.0.0.1:8080", "https://localhost:8080"],
)  # fmt: skip
def test_other_pages_are_refused(server: OwnServer, origin: str) -> None:
    assert handshake(server, origin) == 403


def test_nobody_connects_or_reads_without_the_token(server: OwnServer) -> None:
    token = urlsplit(server.address).path
    for path in ("/", "", "/index.html", token[:-2], f"{token[:-1]}x/", f"/x{token}", f"//{token}", f"/?{token}"):
        assert handshake(server, None, path) == 403, path
    with urlopen(server.address) as page:
        assert b"<title>" in page.read()
        assert page.headers["Referrer-Policy"] == "no-referrer"
    with pytest.raises(HTTPError, match="403"):
        urlopen(server.address.replace(token, "/"))


def test_a_viser_that_cannot_be_guarded_serves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(OwnServer, "_checked", lambda _, answer: answer)
    with pytest.raises(JumpcadError, match="cannot guard its page"):
        OwnServer(0)
