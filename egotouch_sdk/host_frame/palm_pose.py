"""How the host's palm lies in space: a rigid palm fitted to its landmarks under scaled orthographic projection.

Everything here is a left hand's in a picture that is not mirrored; any other case is its mirror image.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import exp, log, sqrt

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import HandJoint

Floats = npt.NDArray[np.float64]

#: Wrist to middle MCP in millimetres between MediaPipe's landmarks (the generic WebXR hand with landmarks placed as MediaPipe
#: places them, our measurement); all lengths below are of this hand.
PALM_MM = 83.0
#: The landmarks that move with the palm.
_JOINTS = [
    HandJoint.WRIST,
    HandJoint.THUMB_CMC,
    HandJoint.INDEX_FINGER_MCP,
    HandJoint.MIDDLE_FINGER_MCP,
    HandJoint.RING_FINGER_MCP,
    HandJoint.PINKY_MCP,
]
#: Where they lie in the host frame: x to the thumb, y to the middle MCP, z out of the back of the hand, in millimetres.
_TRUE_MM: Floats = np.array(
    [[0.0, 0.0, 0.0], [25.3, 21.2, -21.7], [21.2, 84.0, -7.3], [0.0, 83.0, 0.0], [-19.5, 75.7, -1.9], [-37.7, 64.8, -7.3]]
)
#: How far from there the tracker sees them (x, y), and how that varies (standard deviation), in millimetres, seen from the back and
#: from the palm: medians over 100 rendered stills of 16 participants, one hand touching the other (our measurement).
_SEEN_FROM_BACK: Floats = np.array([[-2.0, 2.1], [4.5, 3.1], [-0.6, -2.3], [-1.2, -1.9], [-1.2, -0.6], [-0.2, 0.5]])
_SEEN_FROM_PALM: Floats = np.array([[-2.3, -7.5], [-1.1, -4.5], [-2.1, -1.6], [-1.7, -0.8], [-0.9, -0.4], [1.1, -1.6]])
_SD_FROM_BACK: Floats = np.array([4.7, 4.4, 2.4, 1.8, 1.8, 1.8])
_SD_FROM_PALM: Floats = np.array([5.8, 2.4, 2.5, 4.4, 3.9, 3.1])
#: MediaPipe's z on the palm is this far off, in millimetres (same stills); it only tells the two ways a palm can lean apart.
_Z_SD_MM = 16.0
_STEPS = 6
_MAX_STEP_RAD = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class PalmPose:
    """`rotation` (3, 3) from the host frame to the camera's axes, `px_per_mm` for a palm of `PALM_MM`, `wrist_px` (2,)."""

    rotation: Floats
    px_per_mm: float
    wrist_px: Floats

    @property
    def shows_back(self) -> bool:
        """True when the back of the hand faces the camera."""
        return bool(self.rotation[2, 2] < 0)

    def to_camera_mm(self, point_px: Floats) -> Floats:
        """Image point (2,) in millimetres from the wrist along the camera's x and y."""
        return np.asarray((point_px - self.wrist_px) / self.px_per_mm, np.float64)


def fit_palm(landmarks_px: Floats) -> PalmPose | None:
    """The pose of a host from its landmarks (21, 3); None when they lie on one spot or line."""
    seen = landmarks_px[_JOINTS].astype(np.float64)
    from_back = _area(seen) < 0
    joints = _TRUE_MM.copy()
    joints[:, :2] += _SEEN_FROM_BACK if from_back else _SEEN_FROM_PALM
    weights = 1.0 / (_SD_FROM_BACK if from_back else _SD_FROM_PALM) ** 2
    weights /= weights.sum()
    joints_centre, seen_centre = weights @ joints, weights @ seen
    joints, seen = joints - joints_centre, seen - seen_centre
    root = np.sqrt(weights)[:, None]
    affine = np.linalg.lstsq(joints[:, :2] * root, seen[:, :2] * root, rcond=None)[0].T
    if np.linalg.svd(affine, compute_uv=False)[0] < 1e-6:
        return None
    fits = [_refined(start, joints, seen[:, :2], root) for start in _starts(affine)]
    rotation, scale = min(fits, key=lambda fit: _cost(fit[0], fit[1], joints, seen, weights))
    return PalmPose(rotation, scale, seen_centre[:2] - scale * (rotation[:2] @ joints_centre))


def _area(seen: Floats) -> float:
    """Twice the signed area wrist, index MCP, pinky MCP in the image, y down: negative for a left hand's back."""
    a, b = seen[2, :2] - seen[0, :2], seen[5, :2] - seen[0, :2]
    return float(a[0] * b[1] - a[1] * b[0])


def _starts(affine: npt.NDArray[np.floating]) -> Iterator[tuple[Floats, float]]:
    """The two rotations under which a flat palm looks like this affine map, with its scale: it may lean either way."""
    u, s, vt = np.linalg.svd(affine)
    share = min(float(s[1] / s[0]), 1.0)
    for lean in (sqrt(1 - share * share), -sqrt(1 - share * share)):
        axes = np.stack([np.append(u[:, 0], 0.0), np.append(u[:, 1] * share, lean)], 1) @ vt
        yield np.column_stack([axes, np.cross(axes[:, 0], axes[:, 1])]), float(s[0])


def _refined(start: tuple[Floats, float], joints: Floats, seen_px: Floats, root: Floats) -> tuple[Floats, float]:
    """Gauss-Newton on rotation and scale; `joints` (n, 3) and `seen_px` (n, 2) are centred, `root` (n, 1) are roots of the weights."""
    rotation, scale = start
    for _ in range(_STEPS):
        turned = joints @ rotation.T
        x, y, z = turned.T
        nought = np.zeros_like(x)
        by = np.stack([np.stack([nought, z, -y, x], 1), np.stack([-z, nought, x, y], 1)], 1) * root[:, :, None]
        residual = (seen_px / scale - turned[:, :2]) * root
        jacobian = by.reshape(-1, 4)
        step = np.linalg.solve(jacobian.T @ jacobian + 1e-6 * np.eye(4), jacobian.T @ residual.ravel())
        angle = float(np.linalg.norm(step[:3]))
        rotation = _turn(step[:3] * min(1.0, _MAX_STEP_RAD / max(angle, 1e-9))) @ rotation
        scale = exp(log(scale) + min(max(float(step[3]), -0.3), 0.3))
    return rotation, scale


def _cost(rotation: Floats, scale: float, joints: Floats, seen: Floats, weights: Floats) -> float:
    turned = joints @ rotation.T
    off = seen / scale - turned
    return float(weights @ (off[:, :2] ** 2).sum(1)) + float(weights @ off[:, 2] ** 2) * (3.0 / _Z_SD_MM) ** 2


def _turn(vector: npt.NDArray[np.floating]) -> Floats:
    """Rotation (3, 3) about `vector` by its length (Rodrigues)."""
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = vector / angle
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew, np.float64)
