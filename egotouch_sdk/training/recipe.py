"""Every choice of a training run, in one frozen object that goes into the manifest."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from egotouch_sdk.errors import ConfigError
from egotouch_sdk.observation import PATCH_PX


@dataclass(frozen=True, slots=True)
class Recipe:
    """Settings of one training run.

    `Recipe.paper()` is the paper's: Adam 3e-4, batch 128, 8 epochs, weighted binary cross-entropy + 5 x squared force error
    (EgoTouch, UIST'24, section 4). The defaults keep its loss and add what a small rendered set needs.
    `epochs` counts passes over the renders, every pass with new cameras. Over `warmup_share` of the steps the learning rate
    rises, then it falls along a cosine. `average_decay` is the decay per step of the averaged weights that are shipped, 0 for none.
    `picture_px` below 100 shrinks the pictures: 64 is 2.4 times faster and good for a first stage to start the real run from.
    `label_smoothing` moves targets towards one half. `hover_weight` weighs an auxiliary hover-height output, dropped on export,
    `sigma_weight` the standard error of the force, which learns from the network's errors and does not move them.
    `remembers` adds a memory of a finger's earlier frames, trained on films; `still_weight` then weighs the loss of each frame judged
    alone, as a finger's first frame is. Without a memory each pass takes `frames_per_film` frames of a film at random: neighbours teach
    nearly the same.
    `held_out_share` of the patches, whole participants, choose the threshold and never train.
    """

    epochs: int = 16
    picture_px: int = PATCH_PX
    batch: int = 64
    learning_rate: float = 1.5e-3
    weight_decay: float = 0.05
    warmup_share: float = 0.1
    force_weight: float = 5.0
    hover_weight: float = 2.0
    sigma_weight: float = 1.0
    label_smoothing: float = 0.04
    drop_path: float = 0.05
    dropout: float = 0.1
    average_decay: float = 0.995
    remembers: bool = False
    still_weight: float = 0.5
    frames_per_film: int = 4
    held_out_share: float = 0.12
    held_out_views: int = 2
    seed: int = 1

    def __post_init__(self) -> None:
        for name, least in (("epochs", 1), ("batch", 2), ("held_out_views", 1), ("frames_per_film", 1)):
            if getattr(self, name) < least:
                raise ConfigError(f"recipe has {name}={getattr(self, name)}, need {least} or more")
        if not 32 <= self.picture_px <= PATCH_PX:
            raise ConfigError(f"recipe has picture_px={self.picture_px}, need 32..{PATCH_PX}")
        weights = (self.weight_decay, self.force_weight, self.hover_weight, self.sigma_weight, self.still_weight)
        if self.learning_rate <= 0 or min(weights) < 0:
            raise ConfigError("recipe has a learning rate that is not positive or a negative weight")
        for name in ("warmup_share", "label_smoothing", "drop_path", "dropout", "average_decay", "held_out_share"):
            if not 0.0 <= getattr(self, name) < 1.0:
                raise ConfigError(f"recipe has {name}={getattr(self, name)}, need 0 or more and below 1")

    @classmethod
    def stills(cls) -> Recipe:
        """The shipped model's earlier stages, on patches with a GPU: larger batches, averaged over more steps."""
        return cls(epochs=34, batch=256, learning_rate=2e-3, warmup_share=0.05, average_decay=0.999, held_out_share=0.07)

    @classmethod
    def films(cls) -> Recipe:
        """The shipped model's last stage, on films of 12 frames with a GPU."""
        return cls(
            epochs=24, batch=32, learning_rate=1.2e-3, warmup_share=0.04, average_decay=0.998, held_out_share=0.03, held_out_views=1
        )

    @classmethod
    def paper(cls) -> Recipe:
        """The paper's own recipe, without our additions."""
        return cls(
            epochs=8, batch=128, learning_rate=3e-4, weight_decay=0.0, warmup_share=0.0, hover_weight=0.0,
            sigma_weight=0.0, label_smoothing=0.0, drop_path=0.0, dropout=0.0, average_decay=0.0,
        )  # fmt: skip

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready fields."""
        return asdict(self)
