"""The words of page, command and lesson files: one folder a language, in it a folder for each of them."""
