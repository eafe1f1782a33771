"""Where a request comes from: the address of its visitor, also behind proxies that the operator has named."""

import logging
from collections.abc import Iterable
from functools import lru_cache
from ipaddress import IPv4Address, IPv4Network, IPv6Address, IPv6Network, ip_address, ip_network
from typing import Any
from urllib.parse import urlsplit

MAX_PROXIES = 16  # in a row, whose entries are looked at
PREFIX = 64  # bits of an IPv6 address that tell one customer from another; whoever has one has 2^64 of them
log = logging.getLogger("strikewave")
Network = IPv4Network | IPv6Network
Address = IPv4Address | IPv6Address


def network_of(text: str) -> Network:
    """A proxy's address, or the network of several. Raises ValueError for anything else, and for every address."""
    network = ip_network(text.strip())
    if network.prefixlen == 0:
        raise ValueError(text)  # then each visitor could say to be another
    return network


class Addresses:
    """The addresses of visitors; `X-Forwarded-For` is read only of what these proxies pass on.

    Each proxy appends whom it has heard from, so the entries are read from the end, as long as they are proxies: what
    stands before the first that is none, a visitor may have invented.
    """

    def __init__(self, proxies: Iterable[Network] = ()):
        self._proxies = tuple(proxies)
        self._unnamed = False  # whether the log has a line about a proxy that is not named

    def of(self, request: Any) -> str:
        """Of the visitor who sent this request of Tornado, as a key: an IPv4 address, or the network of an IPv6 one."""
        peer = request.remote_ip
        address = _address(peer)
        forwarded = request.headers.get("X-Forwarded-For", "")
        if address is None:  # a Unix socket
            return str(peer)
        if forwarded and not self._named(address):
            self._report(address)
        entries = reversed(forwarded.rsplit(",", MAX_PROXIES)[-MAX_PROXIES:])
        while self._named(address) and (before := _address(next(entries, ""))) is not None:
            address = before
        return _key(address)

    def _named(self, address: Address) -> bool:
        return any(address in network for network in self._proxies)

    def _report(self, address: Address) -> None:
        """Once, and not for what a stranger of the open network may send."""
        if not self._unnamed and address.is_private:
            self._unnamed = True
            log.warning(
                "%s passes requests on (X-Forwarded-For) and is not named by --behind: its visitors count as one",
                address,
            )


def _address(text: str) -> Address | None:
    """Of an entry; some proxies write a port too."""
    text = text.strip().strip('"')
    if text.startswith("["):
        text = text[1:].partition("]")[0]
    elif text.count(":") == 1:
        text = text.partition(":")[0]
    try:
        found = ip_address(text)
    except ValueError:
        return None
    return getattr(found, "ipv4_mapped", None) or found


def host_of(origin: str) -> str:
    """Of the page that asks, as its browser says; nothing for what is no address."""
    try:
        return urlsplit(origin).netloc.lower()
    except ValueError:
        return ""


@lru_cache(1_000)  # of every connection, each time that one has to give way
def key_of(text: str) -> str:
    """Of who connects, without what a proxy says of others."""
    address = _address(text)
    return text if address is None else _key(address)


def _key(address: Address) -> str:
    return str(address) if address.version == 4 else str(ip_network((int(address), PREFIX), strict=False))
