"""A posed pair of arms, the fingertip resting on the skin, and the same pair at any hover height or force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from egotouch_sdk.joints import Finger
from egotouch_sdk.synthetic.contact import HeightField, dent_weight, press_pad, solve_dent
from egotouch_sdk.synthetic.hand_rig import HandRig
from egotouch_sdk.synthetic.linalg import Array, Indices, bone_frame, reject_from, smoothstep, unit
from egotouch_sdk.synthetic.mesh import vertex_normals
from egotouch_sdk.synthetic.plan import ScenePlan
from egotouch_sdk.synthetic.skin import SkinIdentity

COARSE_LEVEL = 2
FINE_LEVEL = 4
_DENT_REACH_M = 0.045
#: Parts of the receiving limb that face away from the contact by more than this cosine stay coarse.
_FAR_SIDE = -0.35


class ImpossibleSceneError(Exception):
    """The drawn scene cannot be: the message says why."""


@dataclass(frozen=True, slots=True)
class Fineness:
    """How far from the contact, and on the finger from its DIP or tip joint, meshes are split: radii in metres, widest first.

    The last radius gets the rig's finest edges (0.43 mm at level 4), the one before twice those, and so on; a rig of fewer levels leaves
    out the widest. The tip joint lies in the middle of the
    last bone.
    """

    host_m: tuple[float, ...]
    touching_m: tuple[float, ...]
    about_tip: bool = False


#: For pictures of the whole hand, and for series with room for shifts.
WIDE_DETAIL = Fineness((0.065, 0.036), (0.065, 0.034))
#: For one patch of 40 mm whose finger stays within 10 mm: about a third of the faces of `WIDE_DETAIL`.
PATCH_DETAIL = Fineness((0.10, 0.06, 0.034, 0.021), (0.08, 0.05, 0.027, 0.0175), about_tip=True)


@dataclass(frozen=True, slots=True)
class Surface:
    """One limb ready to render: vertices (n, 3) m, faces (m, 3), linear albedo (n, 3), roughness (n,)."""

    vertices: Array
    faces: Indices
    albedo: Array
    roughness: Array


@dataclass(frozen=True, slots=True)
class Touch:
    """The pair of limbs at one depth: both surfaces, joints of the touching hand (21, 3) m and what is true about it."""

    host: Surface
    touching: Surface
    landmarks_m: Array
    force_n: float
    hover_mm: float
    dent_mm: float


@dataclass(frozen=True, slots=True)
class Aim:
    """How the scene is looked at: unit vectors towards the camera, to the image's right and up, and the finger's reference normal."""

    view: Array
    right: Array
    up: Array
    normal: Array


class Stage:
    """A scene plan made flesh.

    `fineness` says how fine the meshes are; `detail` False poses coarse ones, enough to find out whether the scene is possible
    (raises `ImpossibleSceneError`). `aim` fixes the camera and the finger's direction from outside, for clips; the scene is then
    taken as possible.
    All in the receiving hand's own space, metres; `normal` is the skin's at the contact, `contact` the point, `heading` where the finger
    points along the skin.
    """

    def __init__(
        self,
        plan: ScenePlan,
        host: HandRig,
        touching: HandRig,
        identity: SkinIdentity,
        detail: bool,
        aim: Aim | None = None,
        fineness: Fineness = WIDE_DETAIL,
    ) -> None:
        self.plan, self._host, self._touching, self._identity = plan, host, touching, identity
        joints = touching.finger_joint_ids(plan.finger)
        self._dip, self._tip = joints[-2], joints[-1]
        scale = identity.scale
        if detail:
            from_site = ((host.vertices - host.vertices[plan.site]) ** 2).sum(1) * scale**2
            joint = self._tip if fineness.about_tip else self._dip
            from_joint = ((touching.vertices - touching.bind[joint, :3, 3]) ** 2).sum(1)
            same_side = host.normals @ host.normals[plan.site] > _FAR_SIDE
            on_finger = touching.finger_weight(plan.finger) > 0.3
            *_, tip_m = fineness.touching_m
            self._host_ids, self._host_faces = host.mixed_faces(*((from_site < r**2) & same_side for r in fineness.host_m[-host.level :]))
            self._touch_ids, self._touch_faces = touching.mixed_faces(
                *(from_joint < r**2 for r in fineness.touching_m[-touching.level : -1]), (from_joint < tip_m**2) & on_finger
            )
        else:
            self._host_ids, self._host_faces = np.arange(host.vertex_count_at[COARSE_LEVEL]), host.faces_at[COARSE_LEVEL]
            self._touch_ids, self._touch_faces = np.arange(touching.vertex_count_at[COARSE_LEVEL]), touching.faces_at[COARSE_LEVEL]
        self._pose(aim)
        self._rest_on_skin()
        if aim is None:
            self._check()

    def _pose(self, aim: Aim | None) -> None:
        plan, scale = self.plan, self._identity.scale
        host_skin, touch_skin = self._identity.sides["left"], self._identity.sides["right"]
        g = self._host.pose(plan.host_pose)
        self._host_v = self._host.skin(g, host_skin.vertices, self._host_ids) * scale
        self._host_transforms = g
        self._host_n = vertex_normals(self._host_v, self._host_faces)
        self.host_landmarks_m = self._host.mediapipe_joints(g) * scale
        site = int(np.searchsorted(self._host_ids, plan.site))
        self.contact = self._host_v[site]
        around = ((self._host_v - self.contact) ** 2).sum(1) < 0.012**2
        same_side = self._host_n[around] @ self._host_n[site] > 0
        self.normal = unit(self._host_n[around][same_side].mean(0))
        self.aim = aim or self._draw_aim(g)
        g = self._touching.pose(plan.touching_pose)
        vertices = self._touching.skin(g, touch_skin.vertices, self._touch_ids) * scale
        landmarks = self._touching.mediapipe_joints(g) * scale
        rotation, pivot = self._finger_rotation(g), g[self._tip, :3, 3] * scale
        self._touch_v = (vertices - pivot) @ rotation.T + self.contact
        self._landmarks = (landmarks - pivot) @ rotation.T + self.contact
        self._tip_joint = self.contact.copy()
        self._dip_joint = (g[self._dip, :3, 3] * scale - pivot) @ rotation.T + self.contact
        bind = self._touching.bind[self._dip]
        along = ((self._touching.vertices[self._touch_ids] - bind[:3, 3]) @ bind[:3, :3])[:, 2]
        self._along_distal = along
        self._pad = np.flatnonzero((self._touching.finger_weight(plan.finger)[self._touch_ids] > 0.6) & (along < 0.006))

    def _draw_aim(self, g: Array) -> Aim:
        plan, n = self.plan, self.normal
        a = unit(np.cross(n, [0.3, 0.5, 0.8]))
        b = np.cross(n, a)
        tilt, azimuth = plan.view_tilt_rad, plan.view_azimuth_rad
        view = np.cos(tilt) * n + np.sin(tilt) * (np.cos(azimuth) * a + np.sin(azimuth) * b)
        arm = -g[0, :3, 2] if plan.place in ("palm", "back_of_hand") else unit(g[0, :3, 3] - g[25, :3, 3] - g[25, :3, 2] * 0.2)
        along = reject_from(arm, view)
        right = np.cos(plan.arm_azimuth_rad) * along - np.sin(plan.arm_azimuth_rad) * np.cross(view, along)
        return Aim(view, right, np.cross(view, right), n)

    def _finger_rotation(self, g: Array) -> Array:
        plan, n = self.plan, self.aim.normal
        heading = reject_from(np.cos(plan.heading_rad) * self.aim.right + np.sin(plan.heading_rad) * self.aim.up, n)
        self.finger_axis = np.cos(plan.pitch_rad) * heading - np.sin(plan.pitch_rad) * n
        self.heading = reject_from(heading, self.normal)
        dorsal = reject_from(n, self.finger_axis)
        across = np.cross(dorsal, -self.finger_axis)
        self.nail_normal = np.cos(plan.roll_rad) * dorsal + np.sin(plan.roll_rad) * across
        axis = unit(g[self._tip, :3, 3] - g[self._dip, :3, 3])
        return bone_frame(self.finger_axis, self.nail_normal) @ bone_frame(axis, reject_from(g[self._dip, :3, 1], axis)).T

    def _rest_on_skin(self) -> None:
        self._frame = np.stack([self.heading, np.cross(self.normal, self.heading), self.normal], 1)
        self._near = np.flatnonzero(((self._host_v - self.contact) ** 2).sum(1) < _DENT_REACH_M**2)
        local = (self._host_v[self._near] - self.contact) @ self._frame
        facing = (self._host_n[self._near] @ self.normal > 0.15) & (local[:, 2] > -0.02)
        self._skin_field = HeightField(local[facing], lowest=False)
        for attempt in range(3):
            pad = (self._touch_v[self._pad] - self.contact) @ self._frame
            (x, y, _), gap = self._closest(pad)
            self._move(self._frame @ (np.array([-x, -y, -gap]) if attempt < 2 else np.array([0.0, 0.0, -gap])))

    def _closest(self, pad: Array) -> tuple[Array, float]:
        """The pad's point (3,) that is closest to the skin below it, in the contact frame, and its gap in metres."""
        low = pad[pad[:, 2] < np.partition(pad[:, 2], len(pad) // 3)[len(pad) // 3]]
        gap = low[:, 2] - np.nan_to_num(self._skin_field.at(low[:, 0], low[:, 1]), nan=-1.0)
        k = int(np.argmin(gap))
        return low[k], float(gap[k])

    def _move(self, offset: Array) -> None:
        for name in ("_touch_v", "_landmarks", "_tip_joint", "_dip_joint"):
            setattr(self, name, getattr(self, name) + offset)

    def hidden_from(self, camera: Array) -> bool:
        """True when something stands between `camera` (3,) and the fingertip, or closer than 10 cm to the camera."""
        ray = unit(self._tip_joint - camera)
        tip_depth = float((self._tip_joint - camera) @ ray)
        points = np.vstack([self._touch_v[::7], self._host_v[::7]]) - camera
        depth = points @ ray
        off_axis = np.linalg.norm(points - np.outer(depth, ray), axis=1)
        blocks = (depth < tip_depth - 0.022) & (off_axis * tip_depth / np.maximum(depth, 0.01) < 0.016)
        return bool(blocks.any() or ((depth > 0) & (depth < 0.10)).any())

    def _check(self) -> None:
        if self.hidden_from(self.contact + self.aim.view * self.plan.distance_m):
            raise ImpossibleSceneError("fingertip hidden")
        if self.nail_normal @ self.aim.view < 0.15:
            raise ImpossibleSceneError("nail faces away")
        others = np.setdiff1d(np.arange(0, len(self._touch_v), 9), self._pad)
        distance, nearest = cKDTree(self._host_v[::3]).query(self._touch_v[others])
        inside = ((self._touch_v[others] - self._host_v[::3][nearest]) * self._host_n[::3][nearest]).sum(1) < -0.004
        allowed = 0.0005 if self.plan.finger is not Finger.THUMB else 0.005
        if (inside & (distance < 0.03)).mean() > allowed:
            raise ImpossibleSceneError("arms collide")

    def at(self, force_n: float = 0.0, hover_mm: float = 0.0) -> Touch:
        """The pair pressed with `force_n` (> 0) or hovering `hover_mm` above the skin along its normal."""
        return self.moved(force_n, hover_mm, (0.0, 0.0), 0.0, force_n)

    def moved(self, force_n: float, hover_mm: float, offset_m: tuple[float, float], tilt_rad: float, colour_n: float) -> Touch:
        """As `at`, with the finger moved over the skin by `offset_m`, along its heading and across it, up to about 0.015 m.

        `tilt_rad` raises the finger about its tip. `colour_n` is the force that the colour of nail and skin shows: it lags behind.
        """
        skin_l, skin_r = self._identity.sides["left"], self._identity.sides["right"]
        host_albedo, touch_albedo = skin_l.albedo[self._host_ids].astype(float), skin_r.albedo[self._touch_ids].astype(float)
        host_v, touch_v, landmarks, dent_mm = self._host_v, self._touch_v, self._landmarks, 0.0
        if offset_m != (0.0, 0.0) or tilt_rad != 0.0:
            touch_v, landmarks = self._displaced(np.array([*offset_m, 0.0]), tilt_rad)
        sink = self.plan.tissue.sink_m(force_n) if force_n > 0 else 0.0
        shift = self.normal * (hover_mm * 1e-3 - sink)
        touch_v = touch_v + shift
        if force_n > 0:
            host_v, touch_v, host_albedo, dent_mm = self._press(touch_v, sink, colour_n, host_albedo, np.array(offset_m))
        if colour_n > 0 and not self._identity.polished:
            touch_albedo = self._blanch_nail(touch_albedo, colour_n)
        return Touch(
            Surface(host_v, self._host_faces, host_albedo, skin_l.roughness[self._host_ids].astype(float)),
            Surface(touch_v, self._touch_faces, touch_albedo, skin_r.roughness[self._touch_ids].astype(float)),
            landmarks + shift,
            force_n,
            hover_mm,
            dent_mm,
        )

    def _displaced(self, offset: Array, tilt_rad: float) -> tuple[Array, Array]:
        """Vertices and landmarks of the touching hand, moved by `offset` (3,) in the contact frame, tilted, and at rest on skin again."""
        across = self._frame[:, 1]
        c, s = np.cos(tilt_rad), np.sin(tilt_rad)
        cross = np.array([[0, -across[2], across[1]], [across[2], 0, -across[0]], [-across[1], across[0], 0]])
        turn = c * np.eye(3) + s * cross + (1 - c) * np.outer(across, across)
        touch_v, landmarks = ((points - self.contact) @ turn.T for points in (self._touch_v, self._landmarks))
        _, gap = self._closest(touch_v[self._pad] @ self._frame + offset)
        moved = self.contact + self._frame @ (offset - np.array([0.0, 0.0, gap]))
        return touch_v + moved, landmarks + moved

    def _press(self, touch_v: Array, sink: float, colour_n: float, host_albedo: Array, offset: Array) -> tuple[Array, Array, Array, float]:
        normals_up = vertex_normals(touch_v, self._touch_faces)[self._pad]
        pad = (touch_v[self._pad] - self.contact) @ self._frame
        up = normals_up @ self.normal
        dent = solve_dent(self._skin_field, HeightField(pad[up < -0.03], lowest=True), self.plan.tissue)
        local = (self._host_v[self._near] - self.contact) @ self._frame
        weight = dent_weight(self._host_n[self._near] @ self.normal, local)
        host_v = self._host_v.copy()
        host_v[self._near] -= self.normal * (dent.depth_at(local) * weight)[:, None]
        lift, bulge = press_pad(pad, up, dent, sink)
        sideways = normals_up - self.normal * up[:, None]
        touch_v = touch_v.copy()
        touch_v[self._pad] += self.normal * lift[:, None] + sideways * bulge[:, None]
        pale = min(1.0, colour_n / 2.5) * 0.12 * np.exp(-(((np.linalg.norm(local[:, :2] - offset, axis=1) - dent.radius_m) / 0.004) ** 2))
        host_albedo[self._near] = _towards_pale(host_albedo[self._near], pale * weight)
        return host_v, touch_v, host_albedo, dent.depth_max_m * 1e3

    def _blanch_nail(self, albedo: Array, force_n: float) -> Array:
        skin = self._identity.sides["right"]
        nail = np.zeros(len(albedo))
        nail[self._pad] = (skin.nail * (1 - skin.edge))[self._touch_ids][self._pad]
        toward_tip = self._along_distal / self._along_distal[self._pad].min()
        strength = min(1.0, force_n / 2.5)
        white = nail * smoothstep(0.55, 0.85, toward_tip) * strength * 0.5
        red = nail * smoothstep(0.7, 0.45, toward_tip) * strength * 0.4
        albedo = albedo * (1 - white[:, None]) + white[:, None] * np.minimum(1.0, albedo * 1.1 + [0.08, 0.12, 0.10])
        return np.asarray(albedo * np.exp(-red[:, None] * np.array([0.05, 0.5, 0.45])))


def draw_possible(
    draw: Callable[[], ScenePlan],
    host: HandRig,
    touching: HandRig,
    identity: SkinIdentity,
    draws: int,
    dress: Callable[[ScenePlan], SkinIdentity] | None = None,
    fineness: Fineness = WIDE_DETAIL,
) -> Stage:
    """Draw plans until a scene is possible (about one in six is), first on coarse meshes; raises `ImpossibleSceneError` after `draws`.

    `dress` gives the person's skin with what is worn in that scene.
    """
    for _ in range(draws):
        plan = draw()
        try:
            Stage(plan, host, touching, identity, detail=False)
            return Stage(plan, host, touching, dress(plan) if dress else identity, detail=True, fineness=fineness)
        except ImpossibleSceneError:
            continue
    raise ImpossibleSceneError(f"no possible scene in {draws} draws")


def _towards_pale(albedo: Array, amount: Array) -> Array:
    return np.asarray(albedo * (1 - amount[:, None]) + amount[:, None] * np.minimum(0.95, albedo * [1.05, 1.2, 1.15]))
