"""The model card: the manifest in words."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from egotouch_sdk.errors import ModelError

MANIFEST_FILE = "touch.json"
CARD_FILE = "MODEL_CARD.md"

_INTRO = """# Touch model

FastViT-T8 trunk, 126 features with (R, theta), 128 hidden units; one patch gives a touch logit and a force in newtons
(EgoTouch, UIST 2024, section 4), and the standard error of that force. {memory}Folded to plain convolutions
for shipping. Version: **{version}**. Licence: {licence}.

| form | parameters | the paper's |
| --- | --- | --- |
| trained | {trained:,} | {paper[trained]} M |
| shipped | {shipped:,} | {paper[shipped]} M |

A touch begins at probability {threshold[down]:.3f} and ends below {threshold[up]:.3f}.
"""

_MEMORY = "A gated recurrent cell over the hidden units remembers each\nfinger's earlier frames. "

_LIMITS = """
## Limits

Trained and calibrated on rendered pictures only; no picture of a real person went into weights, calibration or threshold values.
Real pictures listed under "Measured" were looked at during development, as "What was tried" says, so they are no blind test.
Figures on rendered pictures say nothing about real skin by themselves. Forces come from a contact model, not from a sensor:
on the real thumb their order hardly follows the sensor, so do not rely on them yet.
Watches and rings were in the study only, not in training. Gloves, wet skin and very dim rooms are not covered.
A touch below half a newton in soft light looks to it like a fingertip a millimetre or two above the skin.
"""


def model_card(manifest: dict[str, Any]) -> str:
    """The model card (Markdown) of a manifest made by `export.build_manifest`."""
    parameters = manifest["parameters"]
    text = _INTRO.format(
        version=manifest["version"],
        licence=manifest["licence"],
        trained=parameters["trained"],
        shipped=parameters["shipped"],
        paper=parameters["paper_millions"],
        threshold=manifest["threshold"],
        memory=_MEMORY if "memory" in manifest["inputs"] else "",
    )
    if not manifest["training"]:
        return text + "\nRandom weights: this file only lets the pipeline run. Its answers mean nothing.\n"
    text += _LIMITS + _section("Training", manifest["training"])
    text += "".join(_section(f"Measured: {name.replace('_', ' ')}", facts) for name, facts in manifest["measured"].items())
    if manifest.get("history"):
        text += "\n## What was tried\n\n" + "".join(f"- {line}\n" for line in manifest["history"])
    return text


def add_measurements(folder: Path, measured: dict[str, Any], history: Sequence[str] = ()) -> None:
    """Add figures measured after training, and what was tried before, to the manifest and the model card in `folder`.

    The model file itself is not touched. Raises `ModelError` when there is no manifest.
    """
    path = folder / MANIFEST_FILE
    if not path.is_file():
        raise ModelError(f"there is no {MANIFEST_FILE} in {folder}", hint="Train or export a model there first")
    manifest = json.loads(path.read_text())
    manifest["measured"].update(measured)
    if history:
        manifest["history"] = list(history)
    path.write_text(json.dumps(manifest, indent=2) + "\n")
    (folder / CARD_FILE).write_text(model_card(manifest))


def _section(title: str, facts: dict[str, Any]) -> str:
    rows = "".join(f"| {key.replace('_', ' ')} | {_cell(value)} |\n" for key, value in facts.items())
    return f"\n## {title}\n\n| what | value |\n| --- | --- |\n{rows}"


def _cell(value: Any) -> str:
    if isinstance(value, str):
        return value.replace("|", "\\|")
    if isinstance(value, dict):
        return ", ".join(f"{k}: {_cell(v)}" for k, v in value.items())
    return f"{value:.4g}" if isinstance(value, float) else json.dumps(value)
