"""Modal superposition."""
