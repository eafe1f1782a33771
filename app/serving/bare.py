"""An answer of HTTP as bytes, where no handler of Tornado can give one."""

POLICY = "default-src 'none'; frame-ancestors 'self'"


def answer(status: str, body: str, kind: str = "text/html", **more: str) -> bytes:
    """`status` with its reason, `more` headers with _ for -; the connection ends with it."""
    content = body.encode()
    headers = {
        "Content-Type": f"{kind}; charset=utf-8",
        "Content-Length": str(len(content)),
        "Content-Security-Policy": POLICY,
        "X-Content-Type-Options": "nosniff",
        "Cache-Control": "no-store",
        "Connection": "close",
    } | {name.replace("_", "-"): value for name, value in more.items()}
    lines = (f"HTTP/1.1 {status}", *(f"{name}: {value}" for name, value in headers.items()))
    return "".join(f"{line}\r\n" for line in lines).encode() + b"\r\n" + content
