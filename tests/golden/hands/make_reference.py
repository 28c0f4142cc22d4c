"""Write what MediaPipe's own hand tracker says about some images, as numbers.

It needs an environment of its own, because mediapipe 0.10.21 wants numpy < 2:

    python3.11 -m venv /tmp/mediapipe
    /tmp/mediapipe/bin/pip install "mediapipe==0.10.21" "numpy<2"
    /tmp/mediapipe/bin/python tests/golden/hands/make_reference.py demo_reference.json egotouch_sdk/assets/demo.mp4
    /tmp/mediapipe/bin/python tests/golden/hands/make_reference.py real_reference.json "$EGOTOUCH_REAL_DIR"

Arguments: the file to write (beside this script unless it has a folder), then images, clips, or folders to search. Of a clip
`FRAMES_PER_CLIP` frames are used, evenly spread. Every image is tracked from scratch (`static_image_mode`, complexity 1, two hands).
The file holds no picture, only: {"mediapipe", "frames": {"<sha256 of the file>:<frame>": {"width_px", "height_px", "hands":
[{"label", "score", "landmarks_px" (21 x [x, y, z])}]}}}; the label is MediaPipe's, which takes the image for a mirrored selfie.
"""

import hashlib
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np

FRAMES_PER_CLIP = 5
CLIPS, STILLS = {".mp4"}, {".jpg", ".png"}
#: Part of a real folder that holds no whole hands.
SKIPPED_FOLDERS = {"thumb_patches"}


def find_files(arguments: list[str]) -> list[Path]:
    files: list[Path] = []
    for argument in map(Path, arguments):
        files += sorted(argument.rglob("*")) if argument.is_dir() else [argument]
    return [f for f in files if f.suffix.lower() in CLIPS | STILLS and not SKIPPED_FOLDERS & set(f.parts)]


def read_frames(path: Path) -> Iterator[tuple[int, Any]]:
    """(frame number, BGR image) of a still or of evenly spread frames of a clip."""
    if path.suffix.lower() in STILLS:
        yield 0, cv2.imread(str(path))
        return
    clip = cv2.VideoCapture(str(path))
    count = int(clip.get(cv2.CAP_PROP_FRAME_COUNT))
    wanted = {int((k + 0.5) * count / FRAMES_PER_CLIP) for k in range(FRAMES_PER_CLIP)}
    for number in range(count):
        ok, image = clip.read()
        if ok and number in wanted:
            yield number, image


def describe(result: Any, width: int, height: int) -> list[dict[str, Any]]:
    return [
        {
            "label": side.classification[0].label,
            "score": round(side.classification[0].score, 4),
            "landmarks_px": np.round([[p.x * width, p.y * height, p.z * width] for p in hand.landmark], 2).tolist(),
        }
        for hand, side in zip(result.multi_hand_landmarks or [], result.multi_handedness or [], strict=True)
    ]


def main() -> None:
    import mediapipe

    target, files = Path(sys.argv[1]), find_files(sys.argv[2:])
    if target.parent == Path():
        target = Path(__file__).parent / target
    frames = {}
    with mediapipe.solutions.hands.Hands(static_image_mode=True, max_num_hands=2, model_complexity=1) as hands:
        for file in files:
            digest = hashlib.sha256(file.read_bytes()).hexdigest()
            for number, image in read_frames(file):
                height, width = image.shape[:2]
                result = hands.process(cv2.cvtColor(image, cv2.COLOR_BGR2RGB))
                frames[f"{digest}:{number}"] = {"width_px": width, "height_px": height, "hands": describe(result, width, height)}
    lines = ",\n".join(f"{json.dumps(key)}: {json.dumps(value)}" for key, value in frames.items())
    target.write_text(f'{{"mediapipe": "{mediapipe.__version__}", "frames": {{\n{lines}\n}}}}\n', encoding="utf-8")
    print(f"{target}: {len(frames)} frames of {len(files)} files, {sum(len(f['hands']) for f in frames.values())} hands")


if __name__ == "__main__":
    main()
