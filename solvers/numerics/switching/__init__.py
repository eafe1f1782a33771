"""Sets of modes that change as contacts begin and end."""
