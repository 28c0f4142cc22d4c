"""Rendered touches with exact ground truth: rigged hands, contact mechanics, path-traced light, a camera model."""
