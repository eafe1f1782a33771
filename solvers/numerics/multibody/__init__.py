"""Planar bodies joined to each other, in floating frames of reference."""
