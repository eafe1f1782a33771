"""What strangers write who want a server to stand still: scenes that are costly to read, and keys of many parts."""

import base64
import zlib


def named(text: str | bytes) -> str:
    """The name of a scene of one's own, as app/static/wire/own.js makes it."""
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    packed = packer.compress(text if isinstance(text, bytes) else text.encode()) + packer.flush()
    return "own." + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def linkage(links: int, modes: int, more: str = "") -> str:
    """A chain of links that bend; `more`: keys of each."""
    joints = "".join(
        f'[[target.joints]]\nlinks = ["{f"l{i}" if i else "ground"}", "l{i + 1}"]\nat = [{i}, 0]\n'
        for i in range(links)
    )
    bars = "".join(
        f'[[target.links]]\nname = "l{i + 1}"\nfrom = [{i}, 0]\nto = [{i + 1}, 0]\nsection = {{ radius = 0.01 }}\n'
        f'material = "steel"\nmodes = {modes}\n{more}'
        for i in range(links)
    )
    return (
        '[impactor]\nkind = "mass"\nmass = 1.0\nvelocity = 1.0\n[target]\nkind = "mechanism"\n'
        f'{joints}{bars}[target.struck]\nlink = "l1"\nat = 0.5\nnormal = [0, 1]\n[contact]\nlaw = "rigid"\n'
    )


def dotted(table: int, key: int, lines: int = 23) -> str:
    """A table of a name of so many parts, and below it keys of so many."""
    return "[" + "a." * (table - 1) + "b]\n" + "".join("a." * (key - 1) + f"c{i} = 1\n" for i in range(lines))
