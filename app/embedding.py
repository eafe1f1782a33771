"""The laboratory as a component of a Panel application of one's own, which serves its files by these routes too."""

from .page.lab import Lab
from .serving.routes import routes

__all__ = ["ROUTES", "Lab"]

ROUTES = routes()  # by the name that `panel serve --plugins` looks for
