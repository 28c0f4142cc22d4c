"""Build hook: puts the converted hand networks into the package, for wheels and editable installs alike."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class HandModelsHook(BuildHookInterface):  # type: ignore[misc,unused-ignore]
    """Runs `egotouch_sdk.hands.convert` before a wheel is packed; a source distribution stays free of third-party weights."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 (hatchling's signature)
        """Fill egotouch_sdk/models/hands; a failure ends the build with one message."""
        if self.target_name != "wheel":
            return
        sys.path.insert(0, self.root)
        from egotouch_sdk.errors import ModelError
        from egotouch_sdk.hands.convert.build import LITE_VARIABLE, build_hand_models

        folder = Path(self.root, "egotouch_sdk", "models", "hands")
        try:
            build_hand_models(folder, lite=os.environ.get(LITE_VARIABLE) == "1", report=self.app.display_info)
        except ModelError as error:
            self.app.abort(f"egotouch-sdk: {error}")
