"""Work off the event loop: processes that solve and compile, and who waits for them."""
