"""Measured histories: as data, as files, and the contact force from gauges."""
