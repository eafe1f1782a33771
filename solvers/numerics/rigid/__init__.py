"""Rigid bodies in space: impulses between them, and how they turn."""
