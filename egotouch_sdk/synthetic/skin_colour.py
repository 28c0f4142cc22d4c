"""Colour of baked skin: melanin, blood, palms, veins, creases, nails; linear RGB albedo."""

from __future__ import annotations

import numpy as np

from egotouch_sdk.joints import FINGERS
from egotouch_sdk.synthetic.linalg import Array, smoothstep
from egotouch_sdk.synthetic.nails import NailMasks
from egotouch_sdk.synthetic.skin_side import Relief, SkinSide
from egotouch_sdk.synthetic.skin_traits import SkinTraits
from egotouch_sdk.synthetic.srgb import srgb_to_linear

#: How strongly each pigment absorbs linear R, G, B (relative; melanin and blood fall towards red).
_MELANIN = np.array([0.35, 0.55, 0.70])
_BLOOD = np.array([0.04, 0.42, 0.34])
_FURROW = np.array([0.26, 0.56, 0.64])
_VEIN = np.array([0.22, 0.10, 0.03])
_HAIR = np.array([1.0, 1.08, 1.15])
_DARK_SKIN = 4.5


def palm_tone(traits: SkinTraits) -> Array:
    """Albedo (3,) of the palm: pinker than the back of the hand, and on dark skin much lighter."""
    tone = np.array(traits.tone)
    if traits.fitzpatrick <= 3.5:
        return np.asarray(tone**0.96 * [1.04, 0.96, 1.08])
    lightened = np.maximum(tone**0.75 * [1.04, 0.96, 1.08], tone)
    return np.asarray(0.6 * lightened + 0.4 * srgb_to_linear([203, 150, 138]) * (1 - 0.1 * (traits.fitzpatrick - 3.5)))


def paint(side: SkinSide, traits: SkinTraits, relief: Relief, nails: NailMasks, vein: Array, pigment: Array, hair: Array) -> Array:
    """Albedo (n, 3) linear RGB in 0.005..0.95; `vein`, `pigment` and `hair` are (n,) masks from the other painters."""
    light_skin = traits.fitzpatrick < _DARK_SKIN
    points = side.points
    palm = side.palmar * smoothstep(0.03, 0.0, points[:, 2]) + 0.35 * side.palmar * smoothstep(0.0, 0.03, points[:, 2])
    knuckles = _knuckles(side)

    melanin = traits.mottle * (0.07 * side.noise(0.03, 410) + 0.03 * side.noise(0.006, 411) + 0.02 * side.noise(0.0022, 412))
    melanin += 0.12 * (1 - palm) * knuckles + pigment
    blood = traits.mottle * (0.08 * side.noise(0.014, 413) + 0.05 * side.noise(0.0045, 414) + 0.02 * side.noise(0.0018, 415))
    blood = traits.redness * blood + 0.35 * traits.redness * (0.8 * nails.pulp + 0.6 * knuckles) + 0.25 * traits.redness * palm

    back = np.array(traits.tone) * [1.0, 0.99, 0.95]
    skin = back * (1 - palm[:, None]) + palm_tone(traits) * palm[:, None]
    absorbed = melanin[:, None] * _MELANIN * (0.55 if light_skin else 1.0)
    absorbed = absorbed + np.clip(blood, -0.6, 2)[:, None] * _BLOOD * (1.0 if light_skin else 0.55)
    absorbed = absorbed + np.clip(relief.dark, 0, 1.6)[:, None] * _FURROW + vein[:, None] * _VEIN + hair[:, None] * _HAIR
    skin = skin * np.exp(-absorbed)

    nail = nails.nail[:, None]
    plate = _nail_colour(traits, nails) * np.exp(-0.35 * np.clip(relief.dark, 0, 1))[:, None]
    return np.asarray(np.clip(skin * (1 - nail) + plate * nail, 0.005, 0.95))


def _knuckles(side: SkinSide) -> Array:
    """Mask (n,) of the skin over the finger joints' backs."""
    mask = np.zeros(len(side.points))
    for finger in FINGERS:
        for joint in side.rig.finger_joint_ids(finger)[1:-1]:
            ids = np.flatnonzero(((side.rig.vertices - side.rig.bind[joint, :3, 3]) ** 2).sum(axis=1) < 0.022**2)
            points, normals = side.in_bone(joint, ids)
            blob = np.exp(-((points[:, 2] / 0.008) ** 2) - (points[:, 0] / 0.012) ** 4)
            mask[ids] = np.maximum(mask[ids], blob * smoothstep(0.0, 0.5, normals[:, 1]))
    return mask


def _nail_colour(traits: SkinTraits, nails: NailMasks) -> Array:
    """Plate colour (n, 3): pink-purple bed a little darker than the finger, paler lunula and greyish free edge."""
    if traits.polish is not None:
        return np.tile(np.array(traits.polish), (len(nails.nail), 1))
    tone = np.array(traits.tone)
    if traits.fitzpatrick < _DARK_SKIN:
        bed, edge_share, lunula_share = 0.9 * (0.55 * tone + 0.45 * srgb_to_linear([196, 116, 118])), 0.45, 0.4
    else:
        bed, edge_share, lunula_share = 0.85 * (0.84 * tone + 0.16 * srgb_to_linear([182, 112, 108])), 0.16, 0.12
    pale = (1 - lunula_share) * bed + lunula_share * srgb_to_linear([226, 196, 186])
    edge = (1 - edge_share) * bed + edge_share * srgb_to_linear([222, 206, 188])
    colour = bed * (1 - nails.lunula[:, None]) + pale * nails.lunula[:, None]
    return np.asarray(colour * (1 - nails.edge[:, None]) + edge * nails.edge[:, None])
