"""A posable hand with forearm: the generic WebXR hand mesh, extended, subdivided and linear-blend skinned."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from egotouch_sdk.joints import FINGERS, WEBXR_INDEX, Finger, HandJoint, Handedness
from egotouch_sdk.synthetic.mesh import FloatArray, IntArray, mixed_resolution
from egotouch_sdk.synthetic.rig_build import JOINT_COUNT, JOINT_NAMES, RigArrays, load_rig_arrays

#: Joint above each joint (-1: none); every metacarpal and the forearm hang on the wrist.
PARENTS: tuple[int, ...] = (
    -1,
    *(0 if name.endswith("metacarpal") or name == "forearm" else index for index, name in enumerate(JOINT_NAMES[1:])),
)
#: MediaPipe's tip landmark lies at this share of the way from DIP to the mesh's end (fitted on 48 rendered frames
#: against MediaPipe Hands 0.10.21: 1.9 mm median error, against 4.8 mm for the asset's own tip joint).
TIP_SHARE = 0.74
#: How far MediaPipe's wrist and four finger MCPs lie from the asset's joints towards the fingers, in metres. Measured with
#: this SDK's hand tracker on 24 renders (6 skins, both sides of both hands, open poses at 0.45 m): medians 16.1 mm (the
#: wrist; 11 mm seen from the palm, 19 mm from the back) and 6.7-8.0 mm; all other joints stayed within 3 mm.
WRIST_SHIFT_M = 0.016
MCP_SHIFT_M = 0.007
_MCPS = tuple(finger.chain[0] for finger in FINGERS[1:])


class HandRig:
    """One hand in its rest pose, with everything needed to pose and skin it; lengths in metres.

    `side` is the hand, `level` the number of Loop subdivisions (0..4; 3 gives 0.87 mm edges, 4 gives 0.43 mm). Building
    the arrays takes seconds once; they are shared in the process and kept in the cache folder.

    Joint frames follow WebXR: -Z towards the fingertip, +Y out of the back of the hand. Joint 25 is the forearm, at the wrist.
    """

    def __init__(self, side: Handedness | str, level: int = 4) -> None:
        self.side = Handedness(side)
        self.level = level
        arrays: RigArrays = load_rig_arrays(self.side, level)
        self.vertices: FloatArray = arrays.vertices
        self.normals: FloatArray = arrays.normals
        self.weights = arrays.weights
        self.faces_at: tuple[IntArray, ...] = arrays.faces_at
        self.vertex_count_at: tuple[int, ...] = arrays.vertex_count_at
        self.bind: FloatArray = arrays.bind
        self.inverse_bind: FloatArray = np.linalg.inv(arrays.bind).astype(np.float64)
        self.wrist_coords: FloatArray = (self.vertices - self.bind[0, :3, 3]) @ self.bind[0, :3, :3]

    @property
    def faces(self) -> IntArray:
        """Faces (m, 3) at the finest level, counter-clockwise seen from outside."""
        return self.faces_at[self.level]

    def finger_weight(self, finger: Finger | str) -> FloatArray:
        """How much each vertex follows that finger, (n,) in 0..1."""
        return np.asarray(self.weights[:, list(self.finger_joint_ids(finger))].sum(axis=1), dtype=np.float64).ravel()

    @staticmethod
    def finger_joint_ids(finger: Finger | str) -> tuple[int, ...]:
        """Joint ids of a finger from metacarpal to tip: 4 for the thumb, 5 for the others."""
        number = FINGERS.index(Finger(finger))
        return (1, 2, 3, 4) if number == 0 else tuple(range(5 * number, 5 * number + 5))

    def mixed_faces(self, *near: npt.NDArray[np.bool_]) -> tuple[IntArray, IntArray]:
        """Vertex ids and faces, finest where the last mask of `near` (n,) holds, coarser outside; see `mixed_resolution`."""
        return mixed_resolution(self.faces_at, near)

    def pose(self, rotations: Mapping[str, tuple[float, float, float]]) -> FloatArray:
        """Joint transforms (26, 4, 4) in the hand's rest frame for a pose.

        `rotations` gives (flexion, abduction, twist) in DEGREES for WebXR joint names and "forearm"; joints left out keep
        their rest rotation. Flexion curls towards the palm. Raises `KeyError` for an unknown joint.
        """
        unknown = set(rotations) - set(JOINT_NAMES)
        if unknown:
            raise KeyError(f"no such joint: {', '.join(sorted(unknown))}")
        transforms = np.zeros((JOINT_COUNT, 4, 4))
        transforms[0] = self.bind[0]
        for joint in range(1, JOINT_COUNT):
            parent = PARENTS[joint]
            local = self.inverse_bind[parent] @ self.bind[joint]
            if JOINT_NAMES[joint] in rotations:
                local = local @ _rotation(*rotations[JOINT_NAMES[joint]])
            transforms[joint] = transforms[parent] @ local
        return transforms

    def skin(
        self,
        transforms: FloatArray,
        vertices: FloatArray | npt.NDArray[np.float32] | None = None,
        vertex_ids: IntArray | None = None,
    ) -> FloatArray:
        """Vertices carried by a pose, by linear-blend skinning: (k, 3) in metres.

        `transforms` (26, 4, 4) from `pose`; `vertices` (n, 3) rest positions of the whole mesh (default: the plain mesh; an
        identity passes its own); `vertex_ids` (k,) selects some of them (default: all).
        """
        rest = self.vertices if vertices is None else vertices
        weights = self.weights if vertex_ids is None else self.weights[vertex_ids]
        rest = rest if vertex_ids is None else rest[vertex_ids]
        carry = (transforms @ self.inverse_bind)[:, :3].reshape(JOINT_COUNT, 12)
        blended = np.asarray(weights @ carry).reshape(-1, 3, 4)
        moved: FloatArray = np.einsum("nab,nb->na", blended[:, :, :3], rest) + blended[:, :, 3]
        return moved

    def mediapipe_joints(self, transforms: FloatArray) -> FloatArray:
        """The 21 landmarks (21, 3) in metres, in MediaPipe's order, for a pose.

        The asset's joints, except where MediaPipe's definition differs: tips (`TIP_SHARE`), wrist and MCPs (`WRIST_SHIFT_M`).
        """
        landmarks = transforms[list(WEBXR_INDEX), :3, 3].copy()
        towards_fingers = -transforms[0, :3, 2]
        landmarks[HandJoint.WRIST] += WRIST_SHIFT_M * towards_fingers
        landmarks[list(_MCPS)] += MCP_SHIFT_M * towards_fingers
        for finger, reach_m in self._finger_reach.items():
            dip, tip = transforms[WEBXR_INDEX[finger.dip], :3, 3], transforms[WEBXR_INDEX[finger.tip], :3, 3]
            landmarks[finger.tip] = dip + TIP_SHARE * reach_m * (tip - dip) / np.linalg.norm(tip - dip)
        return landmarks

    @property
    def _finger_reach(self) -> dict[Finger, float]:
        return _finger_reach(self.side, self.level)


@lru_cache(maxsize=8)
def _finger_reach(side: Handedness, level: int) -> dict[Finger, float]:
    """Distance in metres from DIP to the mesh's end along DIP->tip, per finger."""
    rig = HandRig(side, level)
    reach = {}
    for finger in FINGERS:
        dip, tip = rig.bind[WEBXR_INDEX[finger.dip], :3, 3], rig.bind[WEBXR_INDEX[finger.tip], :3, 3]
        own = rig.vertices[rig.finger_weight(finger) > 0.5]
        reach[finger] = float(((own - dip) @ (tip - dip)).max() / np.linalg.norm(tip - dip))
    return reach


def _rotation(flexion_deg: float, abduction_deg: float, twist_deg: float) -> npt.NDArray[np.float64]:
    """4x4 rotation Ry(abduction) Rx(-flexion) Rz(twist)."""
    (cx, cy, cz), (sx, sy, sz) = (f(np.radians([-flexion_deg, abduction_deg, twist_deg])) for f in (np.cos, np.sin))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    matrix = np.eye(4)
    matrix[:3, :3] = about_y @ about_x @ about_z
    return matrix
