"""Where the command begins: an interrupt ends it without a trace while its modules are still being read."""


def run() -> int:
    """The exit code of `main`."""
    try:
        from .main import main
    except KeyboardInterrupt:
        return 130
    return main()
