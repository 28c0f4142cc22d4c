"""The trivial rival: a touching finger has a dark outline, so the darkest part of the patch is darker."""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt

#: Percentile of luma that the rule looks at (our rendering study, section 4).
DARK_PERCENTILE = 5.0


def darkness(patches: npt.NDArray[np.uint8]) -> npt.NDArray[np.float64]:
    """Score (N,) of uint8 RGB patches (N, 100, 100, 3): minus the 5th percentile of luma, higher = more likely a touch."""
    luma = [cv2.cvtColor(patch, cv2.COLOR_RGB2GRAY) for patch in patches]
    return np.array([-float(np.percentile(image, DARK_PERCENTILE)) for image in luma])
