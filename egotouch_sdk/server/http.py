"""Answers to plain HTTP requests on the server's port: the client page, /healthz, /metrics and the debug view's /debug.jpg."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from hmac import compare_digest
from http import HTTPStatus

from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from egotouch_sdk.server.debug_video import DebugVideo
from egotouch_sdk.server.door import Door
from egotouch_sdk.server.metrics import Metrics
from egotouch_sdk.server.pages import SECURITY_HEADERS, Pages

#: Paths on which WebSockets are accepted.
SOCKET_PATHS = frozenset({"/", "/ws"})


def is_socket_request(headers: Mapping[str, str]) -> bool:
    """True when the client asks for a WebSocket."""
    return headers.get("Upgrade", "").lower() == "websocket"


class HttpFront:
    """Everything the server says over plain HTTP.

    `token` protects /metrics and the debug view's /debug.jpg where clients need one too: `Authorization: Bearer <token>`.
    """

    def __init__(
        self,
        pages: Pages,
        door: Door,
        metrics: Metrics,
        health: Callable[[], Mapping[str, object]],
        token: str = "",
        video: DebugVideo | None = None,
    ) -> None:
        self._pages = pages
        self._door = door
        self._metrics = metrics
        self._health = health
        self._token = token
        self._video = video

    def answer(self, request: Request) -> Response | None:
        """The response; None for a WebSocket, which goes on."""
        path = request.path.partition("?")[0]
        if is_socket_request(request.headers):
            return None if path in SOCKET_PATHS else _response(HTTPStatus.NOT_FOUND, b"WebSockets are at / and /ws\n")
        if self._door.refusal(request.headers) is not None:
            return _response(HTTPStatus.MISDIRECTED_REQUEST, b"This server is not known by that name\n")
        if path == "/healthz":
            return _response(HTTPStatus.OK, json.dumps(self._health()).encode() + b"\n", "application/json")
        if path == "/metrics" or (path == "/debug.jpg" and self._video is not None):
            if not self._may_look(request.headers.get("Authorization", "")):
                return _response(HTTPStatus.UNAUTHORIZED, b"Send the token: Authorization: Bearer <token>\n")
            return self._send_video() if path == "/debug.jpg" else self._send_metrics()
        page = self._pages.find(request.path)
        if page is None and self._pages.is_folder(request.path):
            return _response(HTTPStatus.PERMANENT_REDIRECT, b"", location=f"{path}/")
        if page is None:
            return _response(HTTPStatus.NOT_FOUND, b"There is nothing here\n")
        return _response(HTTPStatus.OK, page.body, page.mime_type)

    def _may_look(self, authorization: str) -> bool:
        return not self._token or compare_digest(authorization.encode(), f"Bearer {self._token}".encode())

    def _send_video(self) -> Response:
        jpeg = self._video.newest() if self._video else None
        return _response(HTTPStatus.NO_CONTENT, b"") if jpeg is None else _response(HTTPStatus.OK, jpeg, "image/jpeg")

    def _send_metrics(self) -> Response:
        return _response(HTTPStatus.OK, self._metrics.text().encode(), "text/plain; version=0.0.4; charset=utf-8")


def _response(status: HTTPStatus, body: bytes, mime_type: str = "text/plain; charset=utf-8", location: str | None = None) -> Response:
    headers = Headers(SECURITY_HEADERS | {"Content-Type": mime_type, "Content-Length": str(len(body)), "Connection": "close"})
    if location is not None:
        headers["Location"] = location
    return Response(status.value, status.phrase, headers, body)
