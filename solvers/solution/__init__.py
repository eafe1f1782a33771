"""What happened in a blow: contacts, velocities, energies, and the motion as a whole."""
