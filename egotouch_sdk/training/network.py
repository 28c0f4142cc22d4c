"""The touch network: FastViT-T8 trunk, then the EgoTouch head with (R, theta); on demand with a memory of a finger's earlier frames.

Head: EgoTouch, UIST 2024, section 4: trunk -> 126 features, (R, theta) appended -> 128 -> ReLU -> touch logit and force. The paper judges
every frame alone. The memory is a gated recurrent cell (Cho et al. 2014) over the 128 values; then both feed the outputs.
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
#: Values that are remembered of a finger (our choice).
MEMORY_SIZE = 128
#: Bounds of the logarithm of the standard error as a share of 3.5 N: 0.02 N to 3.5 N.
LOG_SIGMA_RANGE = (-5.0, 0.0)


class Memory(nn.Module):
    """Gated recurrent cell: hidden values (N, 128) and what is remembered (N, 128) in, what is remembered now out."""

    def __init__(self) -> None:
        super().__init__()
        self.gates = nn.Linear(HIDDEN + MEMORY_SIZE, 2 * MEMORY_SIZE)
        self.candidate = nn.Linear(HIDDEN + MEMORY_SIZE, MEMORY_SIZE)

    def forward(self, hidden: Tensor, memory: Tensor) -> Tensor:
        update, reset = torch.sigmoid(self.gates(torch.cat([hidden, memory], 1))).chunk(2, 1)
        fresh = torch.tanh(self.candidate(torch.cat([hidden, reset * memory], 1)))
        return memory + update * (fresh - memory)


class TouchNetwork(nn.Module):
    """Patches and (R, theta) in, touch logit and force out; a network that `remembers` also takes and gives a memory.

    `patch` (N, 3, 100, 100) float32, normalised by `egotouch_sdk.patches.normalise`; `polar` (N, 2) = (r_palms, theta_rad); `memory`
    (N, 128), zeros for a finger's first frame.
    Returns `touch_logit` (N,), `force_n` (N,) in newtons, unbounded while training, clamped to 0..3.5 in evaluation mode,
    `force_sigma_n` (N,), the standard error of that force on touches (it is read off the state and never shapes it), and, where it
    remembers, the next memory.
    `drop_path` is the largest share of skipped residuals, `dropout` the share of dropped features, both in training only.
    """

    def __init__(self, drop_path: float = 0.0, dropout: float = 0.0, remembers: bool = False) -> None:
        super().__init__()
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
        self.memory = Memory() if remembers else None
        self.outputs = nn.Linear(self.state_size, 2)
        self.spread = nn.Linear(self.state_size, 1)

    @property
    def state_size(self) -> int:
        """Number of values that all outputs are read from: the hidden ones, and the memory where there is one."""
        return HIDDEN if self.memory is None else HIDDEN + MEMORY_SIZE

    def embed(self, patch: Tensor, polar: Tensor) -> Tensor:
        """The 128 hidden values (N, 128) of each frame alone."""
        pooled = self.excite(self.expand(self.trunk(patch))).mean((2, 3))
        place = torch.stack([polar[:, 0], polar[:, 1] / math.pi], 1)
        joined = torch.cat([self.dropout(self.features(pooled)), place], 1)
        return torch.relu(self.hidden(joined))

    def embed_films(self, patch: Tensor, polar: Tensor) -> Tensor:
        """Hidden values (N, T, 128) of films: patches (N, T, 3, H, W) and (R, theta) (N, T, 2)."""
        return self.embed(patch.flatten(0, 1), polar.flatten(0, 1)).reshape(*patch.shape[:2], HIDDEN)

    def stills(self, hidden: Tensor) -> Tensor:
        """States (N, T, S) of frames that are each judged alone, from their hidden values (N, T, 128)."""
        if self.memory is None:
            return hidden
        first = hidden.flatten(0, 1)
        memory = self.memory(first, first.new_zeros(len(first), MEMORY_SIZE))
        return torch.cat([hidden, memory.reshape(*hidden.shape[:2], MEMORY_SIZE)], 2)

    def film(self, hidden: Tensor) -> Tensor:
        """States (N, T, S) of films of T frames, from their hidden values (N, T, 128); without a memory those of stills."""
        if self.memory is None:
            return hidden
        memory, states = hidden.new_zeros(len(hidden), MEMORY_SIZE), []
        for frame in hidden.unbind(1):
            memory = self.memory(frame, memory)
            states.append(torch.cat([frame, memory], 1))
        return torch.stack(states, 1)

    def decide(self, state: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Touch logit, force and its standard error in newtons of states (..., S), each (...)."""
        logit, force = self.outputs(state).unbind(-1)
        force_n = force * FORCE_MAX_N
        sigma_n = self.spread(state.detach())[..., 0].clamp(*LOG_SIGMA_RANGE).exp() * FORCE_MAX_N
        return logit, force_n if self.training else force_n.clamp(0.0, FORCE_MAX_N), sigma_n

    def forward(self, patch: Tensor, polar: Tensor, memory: Tensor | None = None) -> tuple[Tensor, ...]:
        hidden = self.embed(patch, polar)
        if self.memory is None or memory is None:
            return self.decide(self.stills(hidden[:, None])[:, 0])
        following = self.memory(hidden, memory)
        return *self.decide(torch.cat([hidden, following], 1)), following

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
