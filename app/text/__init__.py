"""The words of page and command: one folder a language, in it a folder for each of the two."""
