"""What training changes in what a picture shows, beside its camera: shares and spreads, all our choice."""

#: Share of training samples whose host place is withheld, so that the model also works when the host is unknown.
HOST_UNKNOWN_SHARE = 0.5
#: Spread of the tracker's error on R (relative) and theta (radians) in training.
POLAR_JITTER = (0.05, 0.06)
#: Share of hovers whose surroundings are replaced by clutter, so that a hand before anything but skin is no touch.
AIR_SHARE = 0.08
#: Share of touches that may be drags, and how far these move during an exposure relative to a finger in the air.
DRAG_SHARE, DRAG_MOTION = 0.35, 0.35
#: Share of mirrored training samples, their theta negated.
FLIP_SHARE = 0.5
