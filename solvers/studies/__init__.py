"""Many solves for one answer."""
