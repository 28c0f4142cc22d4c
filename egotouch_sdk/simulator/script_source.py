"""A script as a source of observations, in the place of a camera or a recording."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

from egotouch_sdk.clock import Pacer
from egotouch_sdk.config import TouchConfig
from egotouch_sdk.errors import ConfigError, SourceError
from egotouch_sdk.frame_observation import FrameObservation
from egotouch_sdk.simulator.observe import observe
from egotouch_sdk.simulator.scene import SimulatedView
from egotouch_sdk.simulator.script import Script, read_script
from egotouch_sdk.simulator.timeline import Timeline
from egotouch_sdk.state import Thresholds

_VIEW = SimulatedView()
_SHIPPED = Path(__file__).parents[1] / "assets" / "scripts"


def shipped_scripts() -> tuple[str, ...]:
    """Names of the scripts that come with the package."""
    return tuple(sorted(path.stem for path in _SHIPPED.glob("*.yaml")))


def shipped_script(name: str) -> Path:
    """The file of a script that comes with the package; raises `SourceError` for one that does not."""
    if name not in shipped_scripts():
        raise SourceError(f"no such script: {name}", hint=f"Give a .yaml file or one of {', '.join(shipped_scripts())}")
    return _SHIPPED / f"{name}.yaml"


class ScriptSource:
    """Plays the script in a YAML file; every iteration starts at its beginning and gives the same observations.

    `realtime` holds each observation back until its time, as a camera would; otherwise they come as fast as they are taken.
    `fps` (1 to 240) replaces the script's own.
    Raises `SourceError` when the file cannot be read, `ConfigError` when the script is wrong, and `MissingExtraError` without the
    extra `simulate`.
    """

    config: TouchConfig | None = None
    thresholds: Thresholds | None = None

    def __init__(self, path: str | Path, realtime: bool = False, *, fps: float | None = None) -> None:
        if fps is not None and not 1.0 <= fps <= 240.0:
            raise ConfigError(f"a script cannot be played at {fps:g} pictures per second", hint="Choose 1 to 240")
        self.script: Script = read_script(Path(path))
        self._fps = fps or self.script.fps
        self._timeline = Timeline(self.script, str(path))
        self._realtime = realtime

    @property
    def is_live(self) -> bool:
        """True when observations come at the speed of the clock."""
        return self._realtime

    @property
    def width_px(self) -> int:
        """Width of the imaginary picture."""
        return _VIEW.width_px

    @property
    def height_px(self) -> int:
        """Height of the imaginary picture."""
        return _VIEW.height_px

    @property
    def fps(self) -> float:
        """Observations per second."""
        return self._fps

    @property
    def frame_count(self) -> int:
        """Number of observations; none are given while the camera stalls."""
        return sum(not self._timeline.is_stalled(self._time_ms(tick)) for tick in self._ticks())

    def __iter__(self) -> Iterator[FrameObservation]:
        """Yield one observation per picture, the first at time 0."""
        pacer = Pacer() if self._realtime else None
        index = 0
        for tick in self._ticks():
            scene = self._timeline.scene(self._time_ms(tick), tick)
            if scene is None:
                continue
            timestamp_ns = round(tick * 1e9 / self._fps)
            if pacer:
                pacer.wait(timestamp_ns)
            yield observe(scene, index, timestamp_ns)
            index += 1

    def _ticks(self) -> range:
        return range(1 + int(self._timeline.duration_ms * self._fps / 1e3))

    def _time_ms(self, tick: int) -> float:
        return tick * 1e3 / self._fps

    def close(self) -> None:
        """Nothing is left open after reading the file."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
