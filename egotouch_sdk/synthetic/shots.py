"""The demo clip's script: three takes, three people, three places."""

from __future__ import annotations

from egotouch_sdk.joints import Finger
from egotouch_sdk.synthetic.script import Act, Shot

_DAYLIGHT, _WARM, _NEUTRAL = (0.96, 1.0, 1.05), (1.1, 1.0, 0.84), (1.0, 1.0, 1.0)

DEMO: tuple[Shot, ...] = (
    Shot(
        place="palm",
        finger=Finger.INDEX,
        participant=1,
        arm_azimuth_deg=64,
        heading_deg=132,
        pitch_deg=46,
        roll_deg=-8,
        tilt_deg=(-4, 8),
        distance_m=0.36,
        centre_m=(0.020, -0.006),
        light_weights=(0.35, 0.15, 0.7),
        light_colours=(_WARM, _DAYLIGHT, _NEUTRAL),
        backdrop_srgb=(132, 116, 98),
        stiffness_mm=3.7,
        skin_share=0.72,
        seed=11,
        acts=(
            Act("tap", (8, -44), 0.22, 1.3),
            Act("tap", (-14, -58), 0.24, 0.9),
            Act("hover", (2, -64), 0.3, 2.6),
            Act("press", (2, -50), 0.7, 2.6),
        ),
    ),
    Shot(
        place="inner_forearm",
        finger=Finger.INDEX,
        participant=8,
        arm_azimuth_deg=52,
        heading_deg=136,
        pitch_deg=44,
        roll_deg=-8,
        tilt_deg=(-4, 8),
        distance_m=0.40,
        centre_m=(0.014, 0.022),
        light_weights=(0.7, 0.25, 0.4),
        light_colours=(_WARM, _DAYLIGHT, _NEUTRAL),
        backdrop_srgb=(92, 102, 112),
        stiffness_mm=3.7,
        skin_share=0.7,
        seed=13,
        acts=(Act("tap", (2, 38), 0.24, 1.2), Act("drag", (0, 64), 0.9, 1.2, to_mm=(2, 36)), Act("hover", (-2, 48), 0.3, 3.5)),
    ),
    Shot(
        place="back_of_hand",
        finger=Finger.INDEX,
        participant=5,
        arm_azimuth_deg=58,
        heading_deg=132,
        pitch_deg=46,
        roll_deg=-12,
        tilt_deg=(4, 8),
        distance_m=0.37,
        centre_m=(0.022, -0.006),
        light_weights=(0.2, 0.65, 0.35),
        light_colours=(_WARM, _DAYLIGHT, _NEUTRAL),
        backdrop_srgb=(120, 122, 118),
        stiffness_mm=2.1,
        skin_share=0.48,
        seed=12,
        acts=(Act("press", (0, -40), 0.45, 1.9), Act("hover", (6, -50), 0.3, 4.0), Act("tap", (8, -42), 0.24, 1.4)),
    ),
)
