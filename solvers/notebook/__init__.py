"""Answers as a notebook shows them: tables, labelled arrays, plots. Loaded when asked for, not by `import solvers`."""
