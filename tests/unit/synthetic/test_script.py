import numpy as np
import pytest

pytest.importorskip("scipy")

from egotouch_sdk.synthetic.script import moment
from egotouch_sdk.synthetic.shots import DEMO

FPS = 30


def moments(shot):
    return [moment(shot, i / FPS) for i in range(int(shot.duration_s * FPS) + 1)]


@pytest.mark.parametrize("shot", DEMO, ids=lambda s: s.place)
def test_every_scripted_touch_happens_once_and_nothing_else_touches(shot) -> None:
    touching = np.array([m.force_n > 0 for m in moments(shot)])
    starts = int(touching[0]) + int((touching[1:] & ~touching[:-1]).sum())
    assert starts == sum(act.is_touch for act in shot.acts)


@pytest.mark.parametrize("shot", DEMO, ids=lambda s: s.place)
def test_the_finger_touches_or_hovers_never_both(shot) -> None:
    for m in moments(shot):
        assert (m.force_n > 0) != (m.hover_mm > 0)


@pytest.mark.parametrize("shot", DEMO, ids=lambda s: s.place)
def test_forces_reach_the_scripted_peak_and_stay_in_range(shot) -> None:
    for number, act in enumerate(shot.acts):
        peak = max(m.force_n for m in moments(shot) if m.act == number)
        if act.is_touch:
            assert peak == pytest.approx(act.peak, rel=0.1)
        else:
            assert peak == 0
            assert min(m.hover_mm for m in moments(shot) if m.act == number) == pytest.approx(act.peak, abs=0.3)


@pytest.mark.parametrize("shot", DEMO, ids=lambda s: s.place)
def test_the_finger_never_jumps(shot) -> None:
    track = np.array([(*m.at_mm, m.hover_mm) for m in moments(shot)])
    assert np.linalg.norm(np.diff(track, axis=0), axis=1).max() < 7.0


def test_a_drag_ends_where_it_was_sent() -> None:
    shot = next(s for s in DEMO if any(a.kind == "drag" for a in s.acts))
    number = next(i for i, a in enumerate(shot.acts) if a.kind == "drag")
    last = [m for m in moments(shot) if m.act == number and m.force_n > 0][-1]
    assert last.at_mm == pytest.approx(shot.acts[number].to_mm, abs=0.5)
