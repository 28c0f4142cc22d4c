"""A flat hand's landmarks for tests of the tracking logic."""

import numpy as np
import numpy.typing as npt


def flat_hand(x: float = 0.0, y: float = 0.0, size_px: float = 100.0) -> npt.NDArray[np.float32]:
    """Landmarks (21, 3) of an open right hand, palm towards the camera, fingers up; wrist at (x, y), `size_px` to the knuckles."""
    points = np.zeros((21, 3))
    for finger in range(5):
        side = (finger - 2) * 0.22
        for joint in range(4):
            reach = (0.35 + 0.2 * joint) if finger == 0 else (1.0 + 0.22 * joint)
            points[1 + 4 * finger + joint, :2] = (side * (1 + 0.5 * (finger == 0)), -reach)
    return (points * size_px + (x, y, 0)).astype(np.float32)
