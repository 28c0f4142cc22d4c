"""Building blocks of FastViT-T8 that fold into plain convolutions.

Vasu et al., "FastViT", ICCV 2023 (arXiv 2303.14189), variant T8: depths 2-2-4-2, widths 48-96-192-384, MLP ratio 3, RepMixer in
all four stages, after the authors' released configuration. Written anew here.
"""

from __future__ import annotations

from typing import cast

import torch
from torch import Tensor, nn

STAGE_DEPTHS = (2, 2, 4, 2)
STAGE_WIDTHS = (48, 96, 192, 384)
MLP_RATIO = 3
#: Start of the learned residual scales. FastViT uses 1e-5 for 300 epochs of ImageNet; our runs are far shorter (our choice).
LAYER_SCALE_INIT = 0.1


def conv_bn(inputs: int, outputs: int, kernel: int, stride: int, groups: int) -> nn.Sequential:
    """A bias-free convolution that keeps the size at stride 1, followed by batch normalisation."""
    conv = nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, groups=groups, bias=False)
    return nn.Sequential(conv, nn.BatchNorm2d(outputs))


def fold_batch_norm(weight: Tensor, norm: nn.BatchNorm2d) -> tuple[Tensor, Tensor]:
    """Weight and bias of one convolution equal to convolution `weight` followed by `norm` in evaluation mode."""
    mean, var = cast(Tensor, norm.running_mean), cast(Tensor, norm.running_var)
    gain = norm.weight / torch.sqrt(var + norm.eps)
    return weight * gain.reshape(-1, 1, 1, 1), norm.bias - mean * gain


def pad_kernel(weight: Tensor, size: int) -> Tensor:
    """Zero-pad a square kernel to `size`, centred."""
    margin = (size - weight.shape[-1]) // 2
    return nn.functional.pad(weight, [margin] * 4)


class FoldableConv(nn.Module):
    """Sum of parallel convolutions (and a normalised skip) in training; one convolution after `fold`.

    A strided 1 x 1 branch takes every other pixel first, which is the same and several times faster on CPUs.

    `kernels` lists one branch per entry; `skip` adds batch normalisation of the input itself.
    """

    def __init__(self, inputs: int, outputs: int, kernels: tuple[int, ...], stride: int = 1, groups: int = 1, skip: bool = False) -> None:
        super().__init__()
        self.size = max(kernels, default=1)
        self.stride, self.groups = stride, groups
        self.inputs, self.outputs = inputs, outputs
        self.kernels = kernels
        self.branches: nn.ModuleList | None = nn.ModuleList([conv_bn(inputs, outputs, k, stride if k > 1 else 1, groups) for k in kernels])
        self.skip: nn.BatchNorm2d | None = nn.BatchNorm2d(inputs) if skip else None
        self.folded: nn.Conv2d | None = None

    def forward(self, x: Tensor) -> Tensor:
        if self.folded is not None:
            return cast(Tensor, self.folded(x))
        assert self.branches is not None
        thinned = x[..., :: self.stride, :: self.stride] if self.stride > 1 else x
        terms = [branch(x if kernel > 1 else thinned) for kernel, branch in zip(self.kernels, self.branches, strict=True)]
        if self.skip is not None:
            terms.append(self.skip(x))
        total = terms[0]
        for term in terms[1:]:
            total = total + term
        return cast(Tensor, total)

    def identity_kernel(self, size: int) -> Tensor:
        """The kernel of this shape that copies its input."""
        weight = torch.zeros(self.inputs, self.inputs // self.groups, size, size)
        index = torch.arange(self.inputs)
        weight[index, index % (self.inputs // self.groups), size // 2, size // 2] = 1.0
        return weight

    def kernel_and_bias(self, size: int | None = None) -> tuple[Tensor, Tensor]:
        """The one kernel (outputs, inputs / groups, size, size) and bias (outputs,) equal to all branches in evaluation mode."""
        assert self.branches is not None
        size = size or self.size
        parts = []
        for branch in self.branches:
            conv, norm = cast(nn.Sequential, branch)
            parts.append(fold_batch_norm(pad_kernel(cast(nn.Conv2d, conv).weight, size), cast(nn.BatchNorm2d, norm)))
        if self.skip is not None:
            parts.append(fold_batch_norm(self.identity_kernel(size), self.skip))
        return torch.stack([w for w, _ in parts]).sum(0), torch.stack([b for _, b in parts]).sum(0)

    def fold(self) -> None:
        """Replace the branches by one convolution."""
        weight, bias = self.kernel_and_bias()
        self.folded = _fixed_conv(weight, bias, self.stride, self.groups)
        self.branches = self.skip = None


def _fixed_conv(weight: Tensor, bias: Tensor, stride: int, groups: int) -> nn.Conv2d:
    outputs, per_group, size, _ = weight.shape
    conv = nn.Conv2d(per_group * groups, outputs, size, stride, size // 2, groups=groups)
    conv.weight.data, conv.bias.data = weight.detach().clone(), bias.detach().clone()
    return conv


class RepMixer(nn.Module):
    """Token mixer x + scale * (mix(x) - norm(x)), a plain depthwise 3 x 3 convolution after `fold`."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.width = width
        self.mix: FoldableConv | None = FoldableConv(width, width, (3, 1), groups=width, skip=True)
        self.norm: nn.BatchNorm2d | None = nn.BatchNorm2d(width)
        self.scale: nn.Parameter | None = nn.Parameter(torch.full((width, 1, 1), LAYER_SCALE_INIT))
        self.folded: nn.Conv2d | None = None

    def forward(self, x: Tensor) -> Tensor:
        if self.folded is not None:
            return cast(Tensor, self.folded(x))
        assert self.mix is not None and self.norm is not None and self.scale is not None
        return x + self.scale * (self.mix(x) - self.norm(x))

    def fold(self) -> None:
        """Replace the whole expression by one convolution."""
        assert self.mix is not None and self.norm is not None and self.scale is not None
        identity = self.mix.identity_kernel(3)
        mix_weight, mix_bias = self.mix.kernel_and_bias()
        norm_weight, norm_bias = fold_batch_norm(identity, self.norm)
        weight = identity + self.scale.unsqueeze(-1) * (mix_weight - norm_weight)
        bias = self.scale.flatten() * (mix_bias - norm_bias)
        self.folded = _fixed_conv(weight, bias, 1, self.width)
        self.mix = self.norm = self.scale = None


class ConvMlp(nn.Module):
    """Depthwise 7 x 7 convolution, then two pointwise layers with GELU between."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.spatial = FoldableConv(width, width, (7,), groups=width)
        self.layers = nn.Sequential(nn.Conv2d(width, MLP_RATIO * width, 1), nn.GELU(), nn.Conv2d(MLP_RATIO * width, width, 1))
        for layer in self.layers:
            if isinstance(layer, nn.Conv2d) and layer.bias is not None:
                nn.init.trunc_normal_(layer.weight, std=0.02)
                nn.init.zeros_(layer.bias)

    def forward(self, x: Tensor) -> Tensor:
        return cast(Tensor, self.layers(self.spatial(x)))


class Block(nn.Module):
    """Token mixing, then a scaled residual MLP."""

    def __init__(self, width: int, drop_path: float) -> None:
        super().__init__()
        self.mixer = RepMixer(width)
        self.mlp = ConvMlp(width)
        self.scale = nn.Parameter(torch.full((width, 1, 1), LAYER_SCALE_INIT))
        self.drop_path = drop_path

    def forward(self, x: Tensor) -> Tensor:
        x = self.mixer(x)
        residual = self.scale * self.mlp(x)
        if self.training and self.drop_path > 0:
            keep = 1 - self.drop_path
            residual = residual * (torch.rand(len(x), 1, 1, 1, device=x.device) < keep) / keep
        return x + residual


class SqueezeExcite(nn.Module):
    """Channel weights from the global mean (reduction 1/16, the authors' value), then GELU."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.weights = nn.Sequential(nn.Conv2d(width, width // 16, 1), nn.ReLU(), nn.Conv2d(width // 16, width, 1), nn.Sigmoid())

    def forward(self, x: Tensor) -> Tensor:
        return nn.functional.gelu(x * self.weights(x.mean((2, 3), keepdim=True)))


def stem() -> nn.Sequential:
    """Two strided convolutions and a pointwise one: (N, 3, H, W) to (N, 48, H / 4, W / 4)."""
    width = STAGE_WIDTHS[0]
    return nn.Sequential(
        FoldableConv(3, width, (3, 1), stride=2), nn.GELU(),
        FoldableConv(width, width, (3, 1), stride=2, groups=width), nn.GELU(),
        FoldableConv(width, width, (1,), skip=True), nn.GELU(),
    )  # fmt: skip


def downsample(inputs: int, outputs: int) -> nn.Sequential:
    """Halve the size and widen: depthwise 7 x 7 with stride 2, then pointwise."""
    spread = FoldableConv(inputs, outputs, (7, 3), stride=2, groups=inputs)
    return nn.Sequential(spread, FoldableConv(outputs, outputs, (1,), skip=True), nn.GELU())
