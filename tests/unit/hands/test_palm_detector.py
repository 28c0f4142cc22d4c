"""Anchors, decoding and suppression of the palm detector, by hand-computed cases."""

import numpy as np
import pytest

from egotouch_sdk.hands.boxes import bounding_box, overlaps, weighted_suppression
from egotouch_sdk.hands.palm_detector import INPUT_PX, PalmDetector, decode, make_anchors


def test_anchors_cover_both_maps_in_network_order():
    anchors = make_anchors()
    assert anchors.shape == (2016, 2)
    assert anchors[0] == pytest.approx([0.5 / 24, 0.5 / 24])
    assert np.array_equal(anchors[0], anchors[1])  # two anchors per fine cell
    assert anchors[2] == pytest.approx([1.5 / 24, 0.5 / 24])  # x runs first
    assert anchors[1152] == pytest.approx([0.5 / 12, 0.5 / 12])  # 24 * 24 * 2 fine ones come first
    assert np.array_equal(anchors[1152], anchors[1157])  # six anchors per coarse cell
    assert anchors[-1] == pytest.approx([11.5 / 12, 11.5 / 12])


def test_decode_places_box_and_keypoints_around_their_anchor():
    anchors = make_anchors()
    raw, logits = np.zeros((2016, 18), np.float32), np.full(2016, -50.0, np.float32)
    logits[700] = 0.0  # exactly 0.5
    logits[900] = 9.0  # without a size: not a palm
    raw[700, :4] = (0.1 * INPUT_PX, -0.05 * INPUT_PX, 0.2 * INPUT_PX, 0.4 * INPUT_PX)
    raw[700, 4:6] = (0.01 * INPUT_PX, 0.02 * INPUT_PX)
    (palm,) = decode(raw, logits, anchors, 0.5)
    x, y = anchors[700]
    assert palm.score == pytest.approx(0.5)
    assert palm.box_px == pytest.approx([x + 0.1 - 0.1, y - 0.05 - 0.2, x + 0.1 + 0.1, y - 0.05 + 0.2])
    assert palm.keypoints_px[0] == pytest.approx([x + 0.01, y + 0.02])
    assert palm.keypoints_px[6] == pytest.approx([x, y])


def test_decode_drops_everything_below_the_score():
    assert decode(np.zeros((2016, 18)), np.full(2016, -0.01), make_anchors(), 0.5) == []


def test_overlap_of_half_shifted_squares():
    assert overlaps(np.array([0, 0, 2, 2.0]), np.array([[0, 0, 2, 2], [1, 0, 3, 2], [5, 5, 6, 6.0]])) == pytest.approx([1, 1 / 3, 0])


def test_suppression_averages_a_cluster_by_score_and_keeps_the_far_one():
    boxes = np.array([[0, 0, 10, 10], [1, 0, 11, 10], [50, 50, 60, 60.0]])
    groups = weighted_suppression(boxes, np.array([0.6, 0.9, 0.7]), 0.3)
    assert [sorted(members) for members, _ in groups] == [[0, 1], [2]]
    members, weights = groups[0]
    assert weights @ boxes[members] == pytest.approx([0.6, 0, 10.6, 10])


def test_suppression_ends_on_boxes_without_area():
    assert len(weighted_suppression(np.zeros((3, 4)), np.array([0.9, 0.8, 0.7]), 0.3)) == 3


def test_bounding_box():
    assert bounding_box(np.array([[3, 1, 9], [0, 5, 9.0]])) == pytest.approx([0, 1, 3, 5])


@pytest.mark.parametrize("size", [(32, 32), (720, 1280), (640, 33)])
def test_no_palm_in_a_plain_image(size):
    assert PalmDetector().detect(np.full((*size, 3), 120, np.uint8)) == []
