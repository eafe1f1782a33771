"""Bending beams: dispersion, natural modes, static shapes."""
