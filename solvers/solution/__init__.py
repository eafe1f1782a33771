"""What happened in an impact: contacts, velocities, energies, and the motion as a whole."""
