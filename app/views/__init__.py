"""Views beside the solution: what each shows, worked out from the choices."""
