"""Mechanisms that go on moving after an impact."""
