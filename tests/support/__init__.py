"""Builders and verbs shared by the tests."""
