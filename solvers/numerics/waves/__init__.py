"""Travelling waves in rods: pieces, networks, laws of contact at their ends."""
