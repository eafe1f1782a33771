"""Quasi-static estimates."""
