"""The touch network: FastViT-T8 trunk, then the EgoTouch head with (R, theta).

Head: EgoTouch, UIST 2024, section 4: trunk -> 126 features, (R, theta) appended -> 128 -> ReLU -> touch logit and force.
"""

from __future__ import annotations

import copy
import math

import torch
from torch import Tensor, nn

from egotouch_sdk.observation import FORCE_MAX_N
from egotouch_sdk.training.fastvit import STAGE_DEPTHS, STAGE_WIDTHS, Block, FoldableConv, RepMixer, SqueezeExcite, downsample, stem

#: Width of the last expansion before pooling, as a multiple of the last stage (FastViT authors' configuration).
EXPANSION_RATIO = 2
#: Widths of the EgoTouch head (UIST 2024, section 4).
FEATURES = 126
HIDDEN = 128
#: Bounds of the logarithm of the standard error as a share of 3.5 N: 0.02 N to 3.5 N.
LOG_SIGMA_RANGE = (-5.0, 0.0)


class TouchNetwork(nn.Module):
    """Patches and (R, theta) in, touch logit and force out.

    `patch` (N, 3, 100, 100) float32, normalised by `egotouch_sdk.patches.normalise`; `polar` (N, 2) = (r_palms, theta_rad).
    Returns `touch_logit` (N,), `force_n` (N,) in newtons, unbounded while training, clamped to 0..3.5 in evaluation mode, and
    `force_sigma_n` (N,), the standard error of that force on touches; it is read off the hidden values and never shapes them.
    A touch has no handedness: with `mirrored`, in evaluation mode, the outputs are the mean over the patch and its mirror image (theta
    negated), at twice the cost.
    `drop_path` is the largest share of skipped residuals, `dropout` the share of dropped features, both in training only.
    """

    def __init__(self, drop_path: float = 0.0, dropout: float = 0.0, mirrored: bool = False) -> None:
        super().__init__()
        self.mirrored = mirrored
        rates = iter(torch.linspace(0, drop_path, sum(STAGE_DEPTHS)).tolist())
        layers: list[nn.Module] = [stem()]
        for stage, (depth, width) in enumerate(zip(STAGE_DEPTHS, STAGE_WIDTHS, strict=True)):
            layers += [Block(width, next(rates)) for _ in range(depth)]
            if stage + 1 < len(STAGE_WIDTHS):
                layers.append(downsample(width, STAGE_WIDTHS[stage + 1]))
        self.trunk = nn.Sequential(*layers)
        last = STAGE_WIDTHS[-1]
        self.expand = FoldableConv(last, EXPANSION_RATIO * last, (3, 1), groups=last)
        self.excite = SqueezeExcite(EXPANSION_RATIO * last)
        self.features = nn.Linear(EXPANSION_RATIO * last, FEATURES)
        self.dropout = nn.Dropout(dropout)
        self.hidden = nn.Linear(FEATURES + 2, HIDDEN)
        self.outputs = nn.Linear(HIDDEN, 2)
        self.spread = nn.Linear(HIDDEN, 1)

    def embed(self, patch: Tensor, polar: Tensor) -> Tensor:
        """The 128 hidden values (N, 128) that all outputs are read from."""
        pooled = self.excite(self.expand(self.trunk(patch))).mean((2, 3))
        place = torch.stack([polar[:, 0], polar[:, 1] / math.pi], 1)
        joined = torch.cat([self.dropout(self.features(pooled)), place], 1)
        return torch.relu(self.hidden(joined))

    def decide(self, hidden: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Touch logit (N,), force (N,) and its standard error (N,) in newtons of the hidden values."""
        logit, force = self.outputs(hidden).unbind(1)
        force_n = force * FORCE_MAX_N
        sigma_n = self.spread(hidden.detach())[:, 0].clamp(*LOG_SIGMA_RANGE).exp() * FORCE_MAX_N
        return logit, force_n if self.training else force_n.clamp(0.0, FORCE_MAX_N), sigma_n

    def forward(self, patch: Tensor, polar: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        if self.training or not self.mirrored:
            return self.decide(self.embed(patch, polar))
        mirrored = polar * polar.new_tensor([1.0, -1.0])
        both = self.decide(self.embed(torch.cat([patch, patch.flip(3)]), torch.cat([polar, mirrored])))
        logit, force_n, sigma_n = (value.reshape(2, -1).mean(0) for value in both)
        return logit, force_n, sigma_n

    def use_fast_layout(self) -> TouchNetwork:
        """Keep activations channel-last, about a third faster on CPUs; the first block stays as it is (torch 2.13 crashes on it)."""
        self.to(memory_format=torch.channels_last)
        self.trunk[0][0].to(memory_format=torch.contiguous_format)
        return self


def reparameterise(network: TouchNetwork) -> TouchNetwork:
    """A copy in evaluation mode with every block folded into plain convolutions; outputs stay the same up to rounding."""
    shipped = copy.deepcopy(network).eval()
    with torch.no_grad():
        for module in list(shipped.modules()):
            if isinstance(module, RepMixer):
                module.fold()
        for module in list(shipped.modules()):
            if isinstance(module, FoldableConv):
                module.fold()
    return shipped


def count_parameters(network: nn.Module) -> int:
    """Number of learned values."""
    return sum(parameter.numel() for parameter in network.parameters())
