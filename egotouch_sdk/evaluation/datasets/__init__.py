"""Readers of labelled recordings: public data sets, and a plain folder layout of our own."""
