"""Files of the page: packed for who can read that, plain for others, and the same for both."""

import gzip
import urllib.request

import pytest

from app.serving.pages import LIBRARIES, STATIC, VERSION

ADDRESSES = {f"assets/{VERSION}/{name}": STATIC / name for name in ("page.js", "shell/lab.css")} | dict(LIBRARIES)


def fetched(server: str, address: str, *coding: str):
    headers = {"Accept-Encoding": coding[0]} if coding else {}
    return urllib.request.urlopen(urllib.request.Request(f"http://{server}/{address}", headers=headers), timeout=30)


@pytest.mark.parametrize("address", ADDRESSES)
def test_a_file_is_the_same_packed_or_not(server, address):
    plain, packed = fetched(server, address), fetched(server, address, "br, gzip;q=0.8")
    assert plain.headers["Content-Encoding"] is None and packed.headers["Content-Encoding"] == "gzip"
    small, whole = packed.read(), ADDRESSES[address].read_bytes()
    assert plain.read() == gzip.decompress(small) == whole and len(small) < 0.5 * len(whole)
    for answer in (plain, packed):
        assert answer.headers["Vary"] == "Accept-Encoding" and "immutable" in answer.headers["Cache-Control"]
        assert answer.headers.get_content_type().endswith("css" if address.endswith(".css") else "javascript")
