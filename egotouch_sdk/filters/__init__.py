"""Filters over time."""

from egotouch_sdk.filters.host_point import HostPointFilter
from egotouch_sdk.filters.median import MedianFilter
from egotouch_sdk.filters.one_euro import OneEuroFilter

__all__ = ["HostPointFilter", "MedianFilter", "OneEuroFilter"]
