"""Mechanisms: links, rigid or flexible, joined to each other and to the ground in a plane."""

from .mechanism import Mechanism

__all__ = ["Mechanism"]
