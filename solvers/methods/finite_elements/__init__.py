"""Finite elements in time: nodal and modal coordinates."""
