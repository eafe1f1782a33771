"""Meshes of finite elements, their modes, and Newmark's steps."""
