"""Hands in a camera image: palm detection, 21 landmarks, tracking and identity over time.

`tracker.HandTracker` does it all on ONNX Runtime; `pushed.PushedHands` takes a headset's own joints instead.
"""
