"""`egotouch doctor`: what is installed, what is wrong, and how to mend it."""

from __future__ import annotations

import argparse
import platform
import re
import socket
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from enum import StrEnum
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

from egotouch_sdk import __version__
from egotouch_sdk.cli.options import Subparsers, add_command
from egotouch_sdk.cli.output import print_json
from egotouch_sdk.errors import EgoTouchError, MissingExtraError

EXAMPLES = """\
  egotouch doctor              a report for people; exit code 1 when something is broken
  egotouch doctor --json       the same for programs
"""
RUNTIME_PACKAGES = ("numpy", "onnxruntime", "opencv-python-headless", "protobuf", "pydantic", "websockets")
DISTRIBUTION = "egotouch-sdk"
#: Extras that are bundles of others, or tools for working on the project itself.
NO_FEATURES = {"all", "browser", "dev"}
#: A requirement of an extra in the installed package's metadata, such as `textual>=1; extra == "debug"`.
EXTRA_REQUIREMENT = re.compile(r"(?P<name>[\w.-]+).*;.*extra == ['\"](?P<extra>[\w.-]+)['\"]")
#: Camera indexes tried where the system does not list its cameras.
CAMERAS_TRIED = 3


class Verdict(StrEnum):
    """How one check went."""

    OK = "ok"
    NOTE = "note"
    BROKEN = "broken"


@dataclass(frozen=True, slots=True)
class Finding:
    """One line of the report, with the next step where something is missing."""

    check: str
    verdict: Verdict
    detail: str
    hint: str = ""


def add_parser(subparsers: Subparsers) -> None:
    """Add `doctor` to the command line."""
    parser = add_command(subparsers, "doctor", "check packages, models, network and cameras, and say how to mend what is wrong", EXAMPLES)
    parser.add_argument("--json", action="store_true", help='one JSON object {"findings": [...], "broken": n}')
    parser.add_argument("--no-cameras", action="store_true", help="do not open any camera")
    parser.set_defaults(handler=doctor)


def doctor(options: argparse.Namespace) -> int:
    """Run all checks; 1 when anything that every user needs is broken."""
    checks: list[Callable[[], Iterator[Finding]]] = [_packages, _hand_models, _touch_model, _demo_clip, _extras, _network]
    if not options.no_cameras:
        checks.append(_cameras)
    findings = [finding for check in checks for finding in check()]
    broken = sum(finding.verdict is Verdict.BROKEN for finding in findings)
    if options.json:
        print_json({"findings": [asdict(finding) for finding in findings], "broken": broken})
    else:
        for finding in findings:
            print(f"{finding.verdict.value:<7} {finding.check:<24} {finding.detail}")
            if finding.hint:
                print(f"{'':<32} -> {finding.hint}")
        print(f"\n{'Everything that is needed works.' if not broken else f'{broken} broken; see the arrows above.'}")
    return 1 if broken else 0


def _packages() -> Iterator[Finding]:
    system = f"Python {platform.python_version()}, {platform.system()} {platform.machine()}"
    yield Finding(DISTRIBUTION, Verdict.OK, f"{__version__}, {system}")
    for name in RUNTIME_PACKAGES:
        try:
            yield Finding(name, Verdict.OK, version(name))
        except PackageNotFoundError:
            yield Finding(name, Verdict.BROKEN, "not installed", f"pip install {name}")


def _hand_models() -> Iterator[Finding]:
    from egotouch_sdk.inference import create_session
    from egotouch_sdk.model_store import HANDS_DIR, hand_model, read_manifest

    try:
        for name, entry in read_manifest(HANDS_DIR / "manifest.json")["models"].items():
            create_session(hand_model(name))
            yield Finding(name, Verdict.OK, f"sha256 {entry['sha256'][:16]}, loads")
    except EgoTouchError as error:
        yield Finding("hand networks", Verdict.BROKEN, error.message, error.hint)


def _touch_model() -> Iterator[Finding]:
    from egotouch_sdk.touch import TouchModel

    try:
        manifest = TouchModel().manifest
    except EgoTouchError as error:
        yield Finding("touch model", Verdict.BROKEN, error.message, error.hint)
        return
    yield Finding("touch model", Verdict.OK, f"{manifest.name} {manifest.version}, sha256 {manifest.sha256[:16]}, loads")


def _demo_clip() -> Iterator[Finding]:
    from egotouch_sdk.cli.demo import ASSETS
    from egotouch_sdk.sources import VideoFileSource

    try:
        with VideoFileSource(ASSETS / "demo.mp4") as clip:
            yield Finding("demo clip", Verdict.OK, f"{clip.frame_count} frames, {clip.width_px}x{clip.height_px}")
    except EgoTouchError as error:
        yield Finding("demo clip", Verdict.BROKEN, error.message, "Install the package again")


def _extras() -> Iterator[Finding]:
    for extra, names in _packages_of_extras().items():
        missing = [name for name in names if not _installed(name)]
        if missing:
            hint = MissingExtraError(extra, extra).hint
            yield Finding(f"extra [{extra}]", Verdict.NOTE, f"not installed ({', '.join(missing)}); only needed for that feature", hint)
        else:
            yield Finding(f"extra [{extra}]", Verdict.OK, ", ".join(f"{name} {version(name)}" for name in names))


def _packages_of_extras() -> dict[str, list[str]]:
    """The packages that each extra brings, as the installed package says itself."""
    found: defaultdict[str, list[str]] = defaultdict(list)
    try:
        requirements = requires(DISTRIBUTION) or []
    except PackageNotFoundError:
        requirements = []
    for requirement in filter(None, map(EXTRA_REQUIREMENT.match, requirements)):
        if requirement["extra"] not in NO_FEATURES:
            found[requirement["extra"]].append(requirement["name"])
    return dict(sorted(found.items()))


def _network() -> Iterator[Finding]:
    from egotouch_sdk.cli.serve import DEFAULT_PORT
    from egotouch_sdk.server.network import lan_addresses

    addresses = lan_addresses()
    if addresses:
        yield Finding("local network", Verdict.OK, f"headsets would reach `egotouch serve 0 --lan` at {', '.join(addresses)}")
    else:
        yield Finding("local network", Verdict.NOTE, "this machine is on none", "Join the headset's network to use --lan")
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as the server does: an earlier one's last connections do not count
        try:
            probe.bind(("127.0.0.1", DEFAULT_PORT))
        except OSError:
            yield Finding(f"port {DEFAULT_PORT}", Verdict.NOTE, "in use", "Stop the other program, or serve on another one with --port")
        else:
            yield Finding(f"port {DEFAULT_PORT}", Verdict.OK, "free for `egotouch serve`")


def _installed(name: str) -> bool:
    try:
        version(name)
    except PackageNotFoundError:
        return False
    return True


def _cameras() -> Iterator[Finding]:
    from egotouch_sdk.sources import CameraSource

    devices: list[str | int] = list(range(CAMERAS_TRIED))
    if platform.system() == "Linux":
        devices = [str(path) for path in sorted(Path("/dev").glob("video*"))]
    answered = 0
    for device in devices:
        try:
            with CameraSource(device, stall_timeout_s=2.0) as camera:
                frame = next(iter(camera))
        except EgoTouchError as error:
            if platform.system() == "Linux":
                yield Finding(f"camera {device}", Verdict.NOTE, error.message, "Another program may use it, or it is no video input")
            continue
        answered += 1
        yield Finding(f"camera {device}", Verdict.OK, f"{frame.width_px}x{frame.height_px}")
    if not answered:
        yield Finding("cameras", Verdict.NOTE, "none answers", "Plug one in, or use a file: egotouch run clip.mp4")
