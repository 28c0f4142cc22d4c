"""Filters over time."""

from egotouch_sdk.filters.median import MedianFilter

__all__ = ["MedianFilter"]
