"""What the browser needs of a solve, as binary messages."""
