import subprocess
import sys

import egotouch_sdk

HEAVY = ("cv2", "lightning", "mitsuba", "onnxruntime", "pydantic", "torch", "websockets")


def loaded_by(statement: str) -> tuple[float, set[str]]:
    """Processor seconds that a statement takes in a fresh interpreter (best of three), and the heavy modules it loads."""
    program = f"""
import sys, time
start = time.process_time()
{statement}
print(time.process_time() - start, *(name for name in {HEAVY!r} if name in sys.modules))
"""
    runs = [
        subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60).stdout.split()
        for _ in range(3)
    ]
    return min(float(words[0]) for words in runs), set(runs[0][1:])


def test_import_is_quick_and_loads_nothing_heavy() -> None:
    seconds, heavy = loaded_by("import egotouch_sdk")
    assert heavy == set()
    assert seconds <= 0.15


def test_building_the_command_line_loads_nothing_heavy() -> None:
    _, heavy = loaded_by("from egotouch_sdk.cli.main import build_parser; build_parser()")
    assert heavy == set()


def test_every_public_name_resolves_and_is_listed() -> None:
    for name in egotouch_sdk.__all__:
        assert getattr(egotouch_sdk, name) is not None
    assert dir(egotouch_sdk) == sorted(egotouch_sdk.__all__)


def test_names_are_the_same_objects_as_in_their_modules() -> None:
    from egotouch_sdk.pipeline import TouchPipeline
    from egotouch_sdk.sources import open_source

    assert egotouch_sdk.TouchPipeline is TouchPipeline
    assert egotouch_sdk.open_source is open_source


def test_an_unknown_name_is_an_attribute_error() -> None:
    assert not hasattr(egotouch_sdk, "TouchPipelin")
