"""MediaPipe's hand networks: pinned wheel -> TFLite files -> ONNX files with a manifest.

Runs while the package is built (see `hatch_build.py`), never at run time. Besides the standard library it
needs numpy, onnx and tflite, which are build requirements only.
"""
