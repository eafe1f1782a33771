"""Rigid bodies: one impulse, with and without friction."""
