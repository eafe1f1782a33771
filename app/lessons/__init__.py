"""Lessons: a course in one page, read from plain files and checked."""
