"""Files that the server hands to browsers."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

#: By file ending; whatever is not listed is not served. Windows' registry would give other answers than `mimetypes` elsewhere.
MIME_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".map": "application/json",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".ico": "image/x-icon",
    ".webp": "image/webp",
    ".woff2": "font/woff2",
    ".wasm": "application/wasm",
    ".glb": "model/gltf-binary",
    ".txt": "text/plain; charset=utf-8",
}
SHIPPED_PAGE = Path(__file__).parent / "page"

#: Nothing is loaded from elsewhere, nobody may frame the page; it may ask for the headset's camera and hands.
SECURITY_HEADERS = {
    "Content-Security-Policy": "default-src 'self'; connect-src 'self'; img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(self), xr-spatial-tracking=(self)",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-cache",
}


@dataclass(frozen=True, slots=True)
class Page:
    """One file: its MIME type and content."""

    mime_type: str
    body: bytes


class Pages:
    """The files of a folder, by the path under which they are served; read once, so that no request ever touches the disk.

    A folder with an `index.html` is served under its own path, which ends in a slash.
    """

    def __init__(self, folder: Path | None = SHIPPED_PAGE) -> None:
        self._pages: dict[str, Page] = {}
        for path in sorted(folder.rglob("*")) if folder else ():
            if path.is_file() and path.suffix.lower() in MIME_TYPES:
                relative = path.relative_to(folder or path).as_posix()
                self._pages[f"/{relative}"] = Page(MIME_TYPES[path.suffix.lower()], path.read_bytes())
        for served in tuple(self._pages):
            if served.endswith("/index.html"):
                self._pages[served.removesuffix("index.html")] = self._pages[served]

    def find(self, target: str) -> Page | None:
        """The file at a request's target, whose query does not matter."""
        return self._pages.get(target.partition("?")[0])

    def is_folder(self, target: str) -> bool:
        """True for the path of a folder with an `index.html` that lacks its slash."""
        return f"{target.partition('?')[0]}/" in self._pages
