"""Fill `egotouch_sdk/models/hands/` with the converted networks and their manifest."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from egotouch_sdk.hands.convert.wheel import MEDIAPIPE_VERSION, open_wheel, read_member, sha256

#: Set to 1 to convert the smaller "lite" networks as well.
LITE_VARIABLE = "EGOTOUCH_LITE"
MANIFEST_NAME = "manifest.json"
#: Activation ranges for the 8-bit network, from `calibrate`.
RANGES_FILE = Path(__file__).with_name("activation_ranges.json")


@dataclass(frozen=True, slots=True)
class HandNetwork:
    """One network inside the mediapipe wheel."""

    name: str
    member: str
    sha256: str
    outputs: tuple[str, ...]
    int8: bool = False

    @property
    def file(self) -> str:
        """File name of the converted network."""
        return f"{self.name}.onnx"


_PALM_OUTPUTS = ("boxes", "scores")
_LANDMARK_OUTPUTS = ("landmarks", "presence", "handedness", "world")


def _network(kind: str, size: str, outputs: tuple[str, ...], digest: str) -> HandNetwork:
    name = f"{kind}_{size}"
    return HandNetwork(name, f"mediapipe/modules/{kind}/{name}.tflite", digest, outputs)


_FULL_LANDMARKS = "11c272b891e1a99ab034208e23937a8008388cf11ed2a9d776ed3d01d0ba00e3"
FULL = (
    _network("palm_detection", "full", _PALM_OUTPUTS, "1b14e9422c6ad006cde6581a46c8b90dd573c07ab7f3934b5589e7cea3f89a54"),
    _network("hand_landmark", "full", _LANDMARK_OUTPUTS, _FULL_LANDMARKS),
    replace(_network("hand_landmark", "full", _LANDMARK_OUTPUTS, _FULL_LANDMARKS), name="hand_landmark_full_int8", int8=True),
)
LITE = (
    _network("palm_detection", "lite", _PALM_OUTPUTS, "e9a4aaddf90dda56a87235303cf00e4c2d3fb28725f68fd88772997dac905c18"),
    _network("hand_landmark", "lite", _LANDMARK_OUTPUTS, "048edd3645c9bf7397d19a9f6e3a42957d6e414c9bea6598030a2e9b624156e6"),
)


def build_hand_models(folder: Path, *, lite: bool = False, report: Callable[[str], None] = print) -> None:
    """Make `folder` hold every wanted network and a manifest; does nothing when it already does.

    Raises `ModelError`, with the next step, when the wheel cannot be had or holds something else.
    """
    wanted = FULL + LITE if lite else FULL
    if is_complete(folder, wanted):
        return
    from egotouch_sdk.hands.convert.quantise import quantise
    from egotouch_sdk.hands.convert.tflite_to_onnx import convert

    ranges = json.loads(RANGES_FILE.read_text(encoding="utf-8"))["hand_landmark_full"]
    folder.mkdir(parents=True, exist_ok=True)
    report(f"hand networks: taking {len(wanted)} from mediapipe {MEDIAPIPE_VERSION}")
    entries = {}
    with open_wheel() as wheel:
        for network in wanted:
            model = convert(read_member(wheel, network.member, network.sha256), network.outputs, network.name)
            if network.int8:
                model = quantise(model, ranges)
            data = model.SerializeToString(deterministic=True)
            (folder / network.file).write_bytes(data)
            entries[network.name] = _entry(network, data)
            report(f"hand networks: {network.file} ({len(data) / 1e6:.1f} MB)")
    manifest = {
        "format": 1,
        "source": f"mediapipe {MEDIAPIPE_VERSION} (Python package index), Copyright The MediaPipe Authors",
        "licence": "Apache-2.0",
        "changes": "converted from TFLite to ONNX, input is uint8 BGR; weights unaltered, but rounded to 8 bits in *_int8",
        "converter_sha256": _converter_sha256(),
        "models": entries,
    }
    (folder / MANIFEST_NAME).write_text(json.dumps(manifest, indent=2) + "\n", encoding="utf-8")


def is_complete(folder: Path, wanted: Iterable[HandNetwork]) -> bool:
    """True when the folder's files are what this converter makes of the pinned networks."""
    try:
        manifest = json.loads((folder / MANIFEST_NAME).read_text(encoding="utf-8"))
        return bool(manifest["converter_sha256"] == _converter_sha256()) and all(
            manifest["models"][network.name] == _entry(network, (folder / network.file).read_bytes()) for network in wanted
        )
    except (OSError, ValueError, KeyError, TypeError):
        return False


def _entry(network: HandNetwork, data: bytes) -> dict[str, Any]:
    return {
        "file": network.file,
        "sha256": sha256(data),
        "outputs": list(network.outputs),
        "source_member": network.member,
        "source_sha256": network.sha256,
    }


def _converter_sha256() -> str:
    """Fingerprint of this sub-package's own code, so that an edited converter runs again."""
    sources = [*sorted(Path(__file__).parent.glob("*.py")), RANGES_FILE]
    return sha256(b"".join(path.read_bytes().replace(b"\r\n", b"\n") for path in sources))
