"""Touch on bare skin from any RGB camera."""
