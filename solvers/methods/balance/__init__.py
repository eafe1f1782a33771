"""Repeated balances of impulse and momentum."""
