"""What the browser needs of an impact on a mechanism, which stands still meanwhile or moves on."""
