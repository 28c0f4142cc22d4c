"""The only door to ONNX Runtime."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from egotouch_sdk.errors import ModelError

if TYPE_CHECKING:
    import onnxruntime


def create_session(path: str | Path, threads: int = 1) -> onnxruntime.InferenceSession:
    """Load an ONNX file for the CPU.

    `threads` is the number of threads that share one inference. They never spin while idle: spinning doubles to triples the
    frame time as soon as another program uses a core, and gains 3 % on an idle machine (our measurement).
    Raises `ModelError` when the file is missing, damaged or not an ONNX network, or when `threads` is not positive.
    """
    import onnxruntime

    if threads < 1:
        raise ModelError(f"a session needs at least 1 thread, got {threads}")
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.inter_op_num_threads = 1
    options.log_severity_level = 3
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    try:
        return onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
    except Exception as error:  # ONNX Runtime raises plain RuntimeError subclasses of its own
        reason = str(error).splitlines()[0]
        hint = "Check the path, or install egotouch-sdk again"
        raise ModelError(f"{path} could not be loaded as an ONNX network ({reason})", hint=hint) from error
