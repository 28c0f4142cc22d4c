"""Which model files stand behind a recording."""

from __future__ import annotations

from egotouch_sdk.config import TouchConfig
from egotouch_sdk.model_store import HANDS_DIR, read_manifest


def model_sha256(config: TouchConfig) -> dict[str, str]:
    """SHA-256 of each model file that a pipeline with these settings loads, by the file's name, as the manifests say.

    Raises `ModelError` when a manifest is missing.
    """
    from egotouch_sdk.hands.tracker import NETWORKS
    from egotouch_sdk.touch.manifest import TouchManifest
    from egotouch_sdk.touch.model import SHIPPED_MODEL

    touch = TouchManifest.read((config.touch.model_path or SHIPPED_MODEL).with_suffix(".json"))
    hands = read_manifest(HANDS_DIR / "manifest.json")["models"]
    entries = [hands[name] for name in NETWORKS[config.hands.model]]
    return {touch.file.name: touch.sha256} | {str(entry["file"]): str(entry["sha256"]) for entry in entries}
