"""The port: who may come in, what may be sent, and what the answer to it costs."""
