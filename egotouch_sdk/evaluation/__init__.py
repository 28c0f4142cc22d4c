"""Measuring the touch model and the pipeline: on rendered and real patches, and on video without touches."""
