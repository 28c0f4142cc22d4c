"""The annotated view as a page on this machine's loopback address (the headless OpenCV build has no windows)."""

from __future__ import annotations

from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Condition, Thread
from typing import Any

import cv2

from egotouch_sdk.errors import SourceError
from egotouch_sdk.view.palette import Image

HOST = "127.0.0.1"
JPEG_QUALITY = 85
_BOUNDARY = "egotouch-frame"
_PAGE = b"""<!doctype html><html lang="en"><meta charset="utf-8"><title>egotouch</title>
<style>html{background:#121418;height:100%}body{margin:0;height:100%;display:grid;place-items:center}
img{max-width:100vw;max-height:100vh}</style>
<img src="/stream.mjpg" alt="Camera picture with hands, touch state and force over time">"""


class ViewServer:
    """Serves the newest picture as a motion JPEG stream to any browser on this machine.

    Listens on 127.0.0.1 only and refuses requests under another host name, so no web site can read the picture.
    Raises `SourceError` when `port` is taken (0 picks a free one).
    """

    def __init__(self, port: int = 0) -> None:
        self._changed = Condition()
        self._jpeg: bytes | None = None
        self._count = 0
        self._closed = False
        self.viewers = 0
        try:
            self._server = _Server((HOST, port), self)
        except OSError as error:
            raise SourceError(f"cannot serve the view on port {port} ({error.strerror})", hint="Choose another with --port") from error
        self.url = f"http://{HOST}:{self._server.server_address[1]}/"
        self._thread = Thread(target=self._server.serve_forever, kwargs={"poll_interval": 0.1}, name="egotouch-view", daemon=True)
        self._thread.start()

    def show(self, image: Image) -> None:
        """Make `image` (BGR) the newest picture."""
        ok, jpeg = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
        if ok:
            with self._changed:
                self._jpeg = jpeg.tobytes()
                self._count += 1
                self._changed.notify_all()

    def wait_for_viewer(self, timeout_s: float) -> bool:
        """True once a browser looks at the stream; False when none came in time."""
        with self._changed:
            return self._changed.wait_for(lambda: self.viewers > 0, timeout_s)

    def close(self) -> None:
        """End all streams and stop listening; may be called twice."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._server.shutdown()
        self._server.server_close()

    def next_picture(self, seen: int) -> tuple[bytes, int] | None:
        """The next picture after number `seen`, with its number; None when the view has ended."""
        with self._changed:
            self._changed.wait_for(lambda: self._count > seen or self._closed)
            return None if self._closed or self._jpeg is None else (self._jpeg, self._count)

    def count_viewer(self, change: int) -> None:
        """Note that a browser came (+1) or went (-1)."""
        with self._changed:
            self.viewers += change
            self._changed.notify_all()


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, address: tuple[str, int], view: ViewServer) -> None:
        super().__init__(address, _Handler)
        self.view = view


class _Handler(BaseHTTPRequestHandler):
    server: _Server

    def do_GET(self) -> None:
        if self.headers.get("Host", "").rsplit(":", 1)[0] not in (HOST, "localhost"):
            self.send_error(HTTPStatus.FORBIDDEN)
        elif self.path == "/":
            self._send_page()
        elif self.path == "/stream.mjpg":
            self._send_stream()
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
        """Keep the terminal for events."""

    def _send_page(self) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.send_header("Content-Length", str(len(_PAGE)))
        self.end_headers()
        self.wfile.write(_PAGE)

    def _send_stream(self) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", f"multipart/x-mixed-replace; boundary={_BOUNDARY}")
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        view = self.server.view
        view.count_viewer(+1)
        seen = 0
        try:
            while (newest := view.next_picture(seen)) is not None:
                jpeg, seen = newest
                head = f"--{_BOUNDARY}\r\nContent-Type: image/jpeg\r\nContent-Length: {len(jpeg)}\r\n\r\n"
                self.wfile.write(head.encode() + jpeg + b"\r\n")
        except OSError:
            pass  # the browser closed the page
        finally:
            view.count_viewer(-1)
