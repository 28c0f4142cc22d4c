"""Training of the touch model (extra `train`): data, recipe, export to ONNX. Nothing at run time imports it."""
