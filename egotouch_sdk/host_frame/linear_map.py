"""A linear map of standardised features, with the weights as they are kept in a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

from egotouch_sdk.errors import ModelError

#: Features farther than this from what the map was fitted on, in standard deviations, count as this far (our choice).
MAX_DEVIATION = 3.0


@dataclass(frozen=True, slots=True)
class LinearMap:
    """`outputs[k] = bias[k] + sum(weights[k][i] * clip((features[i] - mean[i]) / spread[i]))`, summed in order in double precision."""

    mean: tuple[float, ...]
    spread: tuple[float, ...]
    weights: tuple[tuple[float, ...], ...]
    bias: tuple[float, ...]

    def __post_init__(self) -> None:
        sizes = {len(self.mean), len(self.spread), *(len(row) for row in self.weights)}
        if len(sizes) != 1 or len(self.weights) != len(self.bias) or not all(spread > 0 for spread in self.spread):
            raise ModelError("the weights of a linear map do not fit together", hint="Install the package again")

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Self:
        """Read `mean`, `spread`, `weights` and `bias`."""
        return cls(tuple(data["mean"]), tuple(data["spread"]), tuple(tuple(row) for row in data["weights"]), tuple(data["bias"]))

    def __call__(self, features: Sequence[float]) -> tuple[float, ...]:
        """One number for each bias."""
        deviations = [
            min(max((value - mean) / spread, -MAX_DEVIATION), MAX_DEVIATION)
            for value, mean, spread in zip(features, self.mean, self.spread, strict=True)
        ]
        return tuple(
            bias + sum(weight * deviation for weight, deviation in zip(row, deviations, strict=True))
            for row, bias in zip(self.weights, self.bias, strict=True)
        )
