"""What a visitor has chosen and may ask: bounded values, no widget."""
