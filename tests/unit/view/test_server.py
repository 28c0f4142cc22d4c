import http.client
from collections.abc import Iterator
from urllib.parse import urlsplit

import cv2
import numpy as np
import pytest

from egotouch_sdk.errors import SourceError
from egotouch_sdk.view.server import ViewServer


@pytest.fixture
def server() -> Iterator[ViewServer]:
    view = ViewServer()
    yield view
    view.close()


def get(server: ViewServer, path: str, **headers: str) -> http.client.HTTPResponse:
    connection = http.client.HTTPConnection(urlsplit(server.url).netloc, timeout=30)
    connection.request("GET", path, headers=headers)
    return connection.getresponse()


def test_it_listens_on_loopback_only(server: ViewServer) -> None:
    assert urlsplit(server.url).hostname == "127.0.0.1"


def test_the_page_shows_the_stream(server: ViewServer) -> None:
    with get(server, "/") as response:
        assert (response.status, response.headers.get_content_type()) == (200, "text/html")
        assert b'src="/stream.mjpg"' in response.read()


def test_the_stream_delivers_the_picture(server: ViewServer) -> None:
    with get(server, "/stream.mjpg") as response:
        assert server.wait_for_viewer(30)
        server.show(np.full((48, 64, 3), (10, 120, 240), np.uint8))
        head = [response.readline() for _ in range(4)]
        assert head[1] == b"Content-Type: image/jpeg\r\n"
        jpeg = response.read(int(head[2].split(b":")[1]))
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    assert np.abs(image[24, 32].astype(int) - (10, 120, 240)).max() < 8


def test_a_late_viewer_sees_the_last_picture(server: ViewServer) -> None:
    server.show(np.zeros((48, 64, 3), np.uint8))
    with get(server, "/stream.mjpg") as response:
        assert response.readline().startswith(b"--")


@pytest.mark.parametrize(("path", "headers", "status"), [("/", {"Host": "evil.example"}, 403), ("/etc/passwd", {}, 404)])
def test_other_hosts_and_paths_are_refused(server: ViewServer, path: str, headers: dict[str, str], status: int) -> None:
    with get(server, path, **headers) as response:
        assert response.status == status


def test_nobody_looking_is_said_so(server: ViewServer) -> None:
    assert not server.wait_for_viewer(0.01)


def test_a_taken_port_is_a_source_error(server: ViewServer) -> None:
    with pytest.raises(SourceError, match="cannot serve the view on port"):
        ViewServer(urlsplit(server.url).port or 0)
