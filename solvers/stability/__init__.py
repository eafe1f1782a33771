"""Where integrators keep the energy, chatter or fail."""
