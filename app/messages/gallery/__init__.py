"""The gallery of scenes: which are shown as cards, their pictures, and the list of all."""
