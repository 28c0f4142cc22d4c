"""Path tracing with Mitsuba 3: geometry and lights in, per-light irradiance, albedo, segments and depth out."""

from __future__ import annotations

import ctypes
import functools
import os
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from egotouch_sdk.errors import ConfigError, MissingExtraError
from egotouch_sdk.synthetic.lights import KEY_DISTANCE_M, Lights
from egotouch_sdk.synthetic.linalg import Array, unit
from egotouch_sdk.synthetic.mesh import vertex_normals
from egotouch_sdk.synthetic.stage import Surface

Image = npt.NDArray[np.float32]

#: One grey for every surface in the light pass; near skin's mean reflectance in red and green (II-IV).
_GREY = 0.45
_MAX_DEPTH = 3
_MARKED = 0.5
SEGMENT_BACKGROUND, SEGMENT_HOST, SEGMENT_TOUCHING = 0, 1, 2
#: drjit 1.5 aborts on LLVM 15 ("Cannot select: fminimum"); newer ones work (measured).
_LLVM_GLOBS = ("lib/llvm-*/lib/libLLVM*.so*", "lib/*/libLLVM*.so*")
_LLVM_MIN = 16
#: Mitsuba's variants, fastest first.
VARIANTS = {"gpu": "cuda_ad_rgb", "llvm": "llvm_ad_rgb", "scalar": "scalar_rgb"}
RENDERER_VARIABLE = "EGOTOUCH_RENDERER"
_NEEDS = {
    "gpu": "It needs an NVIDIA GPU whose driver brings libnvoptix",
    "llvm": "No LLVM 16 or newer found: install one, e.g. apt install libllvm19",
}


def _find_llvm() -> str | None:
    found = [path for pattern in _LLVM_GLOBS for path in Path("/usr").glob(pattern)]
    versions = [(int(match[0]), str(path)) for path in found if (match := re.findall(r"\d+", path.name))]
    return max(((v, p) for v, p in versions if v >= _LLVM_MIN), default=(0, None))[1]


@functools.cache
def mitsuba(threads: int = 1) -> Any:
    """The Mitsuba module with its fastest usable variant set: NVIDIA's GPU, LLVM, else the slow scalar one, which is warned of.

    `$EGOTOUCH_RENDERER` (a name of `VARIANTS`) decides instead. Raises `MissingExtraError` when Mitsuba is not installed,
    `ConfigError` for an unknown name or one that cannot be used here.
    """
    wanted = os.environ.get(RENDERER_VARIABLE, "")
    if wanted and wanted not in VARIANTS:
        raise ConfigError(f"{RENDERER_VARIABLE} is {wanted!r}", hint=f"Use one of {', '.join(VARIANTS)}, or unset it")
    if "DRJIT_LIBLLVM_PATH" not in os.environ and (path := _find_llvm()):
        os.environ["DRJIT_LIBLLVM_PATH"] = path
    try:
        import drjit
        import mitsuba as mi
    except ImportError as error:
        raise MissingExtraError("Rendering synthetic touches", "synthetic") from error
    usable = {"gpu": _sees_gpu(), "llvm": "DRJIT_LIBLLVM_PATH" in os.environ, "scalar": True}
    if wanted and not usable[wanted]:
        raise ConfigError(f"{RENDERER_VARIABLE} is {wanted!r}, which does not run here", hint=_NEEDS[wanted])
    chosen = wanted or next(name for name in VARIANTS if usable[name])
    if chosen == "scalar" and not wanted:
        warnings.warn(f"Rendering takes about 5 times longer than it could. {_NEEDS['llvm']}", stacklevel=2)
    mi.set_variant(VARIANTS[chosen])
    if chosen != "scalar":
        drjit.set_thread_count(threads)
    return mi


def _sees_gpu() -> bool:
    """True where the NVIDIA driver and its ray tracing library are there and a card answers."""
    for library in ("libcuda.so.1", "libnvoptix.so.1"):
        try:
            ctypes.CDLL(library)
        except OSError:
            return False
    count = ctypes.c_int(0)
    cuda = ctypes.CDLL("libcuda.so.1")
    return cuda.cuInit(0) == 0 and cuda.cuDeviceGetCount(ctypes.byref(count)) == 0 and count.value > 0


@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole at `origin` looking at `target` (m), `fov_rad` across `width_px`."""

    origin: Array
    target: Array
    up: Array
    fov_rad: float
    width_px: int
    height_px: int

    def project(self, points: Array) -> Array:
        """Pixel coordinates (whole numbers are pixel centres) and depth (m) of points (n, 3): array (n, 3)."""
        forward = unit(self.target - self.origin)
        right = unit(np.cross(forward, self.up))
        down = -np.cross(right, forward)
        rel = np.atleast_2d(points) - self.origin
        depth = rel @ forward
        k = self.width_px / 2 / np.tan(self.fov_rad / 2)
        x, y = k * (rel @ right) / depth, k * (rel @ down) / depth
        return np.stack([(self.width_px - 1) / 2 + x, (self.height_px - 1) / 2 + y, depth], 1)


@dataclass(frozen=True, slots=True)
class Layers:
    """One view: `light` (H, W, 3) irradiance by key, windows, room; `albedo` (H, W, 3) linear; `segment` (H, W); `depth_m` (H, W)."""

    light: Image
    albedo: Image
    segment: npt.NDArray[np.uint8]
    depth_m: Image


@dataclass(frozen=True, slots=True)
class Backdrop:
    """A plane behind the hands: a point, its normal, up (scene) and a linear albedo texture (n, n, 3)."""

    point: Array
    normal: Array
    up: Array
    texture: Image


def _mesh(mi: Any, name: str, surface: Surface) -> Any:
    props = mi.Properties()
    props["mesh_bsdf"] = mi.load_dict(
        {
            "type": "principled",
            "base_color": {"type": "mesh_attribute", "name": "vertex_color"},
            "roughness": {"type": "mesh_attribute", "name": "vertex_rough"},
            "specular": 0.4,
        }
    )
    mesh = mi.Mesh(
        name,
        vertex_count=len(surface.vertices),
        face_count=len(surface.faces),
        has_vertex_normals=True,
        has_vertex_texcoords=False,
        props=props,
    )
    mesh.add_attribute("vertex_color", 3, np.ascontiguousarray(surface.albedo, np.float32).ravel())
    mesh.add_attribute("vertex_rough", 1, np.ascontiguousarray(surface.roughness, np.float32).ravel())
    params = mi.traverse(mesh)
    params["vertex_positions"] = np.ascontiguousarray(surface.vertices, np.float32).ravel()
    params["faces"] = np.ascontiguousarray(surface.faces, np.uint32).ravel()
    params["vertex_normals"] = np.ascontiguousarray(vertex_normals(surface.vertices, surface.faces), np.float32).ravel()
    params.update()
    return mesh


def _sensor(mi: Any, camera: Camera) -> dict[str, Any]:
    look = mi.ScalarTransform4f().look_at(origin=camera.origin.tolist(), target=camera.target.tolist(), up=camera.up.tolist())
    return {
        "type": "perspective",
        "fov": float(np.degrees(camera.fov_rad)),
        "fov_axis": "x",
        "near_clip": 0.01,
        "far_clip": 20.0,
        "to_world": look,
    }


def _scene(mi: Any, host: Surface, touching: Surface, lights: Lights, focus: Array, backdrop: Backdrop, cameras: Sequence[Camera]) -> Any:
    t = mi.ScalarTransform4f
    rotation = np.eye(4)
    rotation[:3, :3] = lights.rotation
    sky = np.zeros((*lights.room.shape, 3), np.float32)
    sky[..., 1], sky[..., 2] = lights.windows, lights.room
    radius = KEY_DISTANCE_M * np.tan(lights.key_radius_rad)
    lamp = focus + lights.key_direction * KEY_DISTANCE_M
    away = np.cross(lights.key_direction, [0.31, 0.9, 0.11])
    width, height = cameras[0].width_px, cameras[0].height_px
    film = {
        "type": "hdrfilm",
        "width": width * len(cameras),
        "height": height,
        "rfilter": {"type": "box"},
        "pixel_format": "rgb",
        "component_format": "float32",
    }
    sensor: dict[str, Any] = {"type": "batch", "film": film, "sampler": {"type": "multijitter"}}
    for i, camera in enumerate(cameras):
        single = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}}
        sensor[f"view{i}"] = {**_sensor(mi, camera), "film": single, "sampler": {"type": "multijitter"}}
    return mi.load_dict(
        {
            "type": "scene",
            "host": _mesh(mi, "host", host),
            "touching": _mesh(mi, "touching", touching),
            "sky": {"type": "envmap", "bitmap": mi.Bitmap(sky), "to_world": t(rotation)},
            "key": {
                "type": "disk",
                "to_world": t().look_at(origin=lamp.tolist(), target=focus.tolist(), up=away.tolist()) @ t().scale(float(radius)),
                "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [lights.key_radiance, 0.0, 0.0]}},
            },
            "backdrop": {
                "type": "rectangle",
                "to_world": t().look_at(
                    origin=backdrop.point.tolist(), target=(backdrop.point + backdrop.normal).tolist(), up=backdrop.up.tolist()
                )
                @ t().scale(1.6),
                "bsdf": {
                    "type": "diffuse",
                    "reflectance": {"type": "bitmap", "bitmap": mi.Bitmap(backdrop.texture), "raw": True, "wrap_mode": "mirror"},
                },
            },
            "sensor": sensor,
        }
    )


def _paint(params: Any, colours: Mapping[str, tuple[float, float, float]]) -> None:
    """Give whole surfaces one colour each: the shape index that Mitsuba reports is not stable from scene to scene."""
    for key in dict(params):
        colour = colours.get(key.split(".")[0])
        if colour is not None and key.endswith(("vertex_color", ".data")):
            shape = np.array(params[key]).shape
            params[key] = np.tile(np.array(colour, np.float32), int(np.prod(shape)) // 3).reshape(shape)
    params.update()


def render_layers(
    host: Surface,
    touching: Surface,
    lights: Lights,
    focus: Array,
    backdrop: Backdrop,
    cameras: Sequence[Camera],
    samples: int,
    seed: int,
    px_per_mm: float = 2.5,
) -> list[Layers]:
    """Render every camera's view (all of one size) of a scene as light-separated layers.

    `samples` per pixel in the light pass (12 stratified ones leave no noise that looks like skin texture); the noise that is
    left is removed by an edge-aware blur of about 0.5 mm, which also stands in for light spreading under the skin.
    """
    mi = mitsuba()
    scene = _scene(mi, host, touching, lights, focus, backdrop, cameras)
    look = mi.load_dict({"type": "aov", "aovs": "al:albedo"})
    albedo = np.array(mi.render(scene, integrator=look, spp=4, seed=seed))[..., :3]
    params = mi.traverse(scene)
    _paint(params, {"host": (1.0, 0.0, 0.0), "touching": (0.0, 1.0, 0.0), "backdrop": (0.0, 0.0, 1.0)})
    marked = np.array(mi.render(scene, integrator=mi.load_dict({"type": "aov", "aovs": "al:albedo,dd:depth"}), spp=1, seed=seed))
    markers, depth = marked[..., :3], marked[..., 3]
    segment = np.array([SEGMENT_HOST, SEGMENT_TOUCHING, SEGMENT_BACKGROUND], np.uint8)[markers.argmax(-1)]
    segment[markers.max(-1) < _MARKED] = SEGMENT_BACKGROUND
    _paint(params, dict.fromkeys(("host", "touching", "backdrop"), (_GREY, _GREY, _GREY)))
    path = mi.load_dict({"type": "path", "max_depth": _MAX_DEPTH, "hide_emitters": False})
    light = np.array(mi.render(scene, integrator=path, spp=samples, seed=seed + 2))[..., :3] / _GREY
    width = cameras[0].width_px
    views = []
    for i in range(len(cameras)):
        cut = np.s_[:, i * width : (i + 1) * width]
        views.append(
            Layers(
                _smooth(light[cut], depth[cut], segment[cut], px_per_mm),
                albedo[cut].astype(np.float32),
                segment[cut],
                depth[cut].astype(np.float32),
            )
        )
    return views


def _smooth(light: Array, depth_m: Array, segment: npt.NDArray[np.uint8], px_per_mm: float) -> Image:
    light = np.minimum(light, np.percentile(light, 99.8, (0, 1))).astype(np.float32)
    sigma = max(0.44 * px_per_mm, 0.7)
    reach = int(np.ceil(2.2 * sigma))
    depth = depth_m.astype(np.float32)
    padded = [cv2.copyMakeBorder(a, reach, reach, reach, reach, cv2.BORDER_REFLECT) for a in (light, depth, segment)]
    total, weight = np.zeros_like(light), np.zeros_like(depth)
    h, w = depth.shape
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            kernel = float(np.exp(-(dx * dx + dy * dy) / (2 * sigma * sigma)))
            if kernel < 0.03:
                continue
            at = np.s_[reach + dy : reach + dy + h, reach + dx : reach + dx + w]
            k = kernel * np.exp(-(((padded[1][at] - depth) / 0.002) ** 2)) * (padded[2][at] == segment)
            total += k[..., None] * padded[0][at]
            weight += k
    return np.asarray(total / np.maximum(weight, 1e-6)[..., None], np.float32)
