"""Travelling waves: exact ones, on a grid of times, in chains of rods."""
