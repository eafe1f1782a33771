"""Whom a request comes from: what a visitor says of himself is believed of nobody but a proxy that is named."""

import logging
from types import SimpleNamespace

import pytest
from tornado.httputil import HTTPHeaders

from app.serving.addresses import Addresses, network_of
from app.serving.server import opened_at

PROXIES = [network_of(each) for each in ("10.0.0.0/8", "192.168.7.1", "fd00::/8")]


def visitor(peer, forwarded=None, proxies=PROXIES):
    headers = HTTPHeaders()
    for each in [forwarded] if isinstance(forwarded, str) else forwarded or []:
        headers.add("X-Forwarded-For", each)
    return Addresses(proxies).of(SimpleNamespace(remote_ip=peer, headers=headers))


def test_nobody_is_believed_by_default():
    assert visitor("10.0.0.5", "203.0.113.9", proxies=()) == "10.0.0.5"
    assert visitor("203.0.113.1", "203.0.113.9") == "203.0.113.1"  # a stranger who says to be another


@pytest.mark.parametrize(
    "forwarded, address",
    [
        ("203.0.113.9", "203.0.113.9"),
        ("1.1.1.1, 203.0.113.9", "203.0.113.9"),  # the first a visitor has invented
        ("10.9.9.9, 203.0.113.9", "203.0.113.9"),  # also if it looks like a proxy
        ("203.0.113.9, 10.0.0.7, 192.168.7.1", "203.0.113.9"),  # several proxies
        (["1.1.1.1", "203.0.113.9"], "203.0.113.9"),  # in two headers
        ("203.0.113.9:4711", "203.0.113.9"),
        ("[2001:db8:1:2:3:4:5:6]:4711", "2001:db8:1:2::/64"),
        ("2001:db8:1:2::9, fd00::7", "2001:db8:1:2::/64"),
        ("::ffff:203.0.113.9", "203.0.113.9"),
        ("203.0.113.9, nonsense", "10.0.0.5"),  # the proxy has passed on what is no address: it counts itself
        ("unknown, 10.0.0.7", "10.0.0.7"),
        ("", "10.0.0.5"),
        ("10.0.0.8, 10.0.0.7", "10.0.0.8"),  # somebody of the inner network
        ("203.0.113.9, " + "10.0.0.7, " * 500 + "10.0.0.7", "10.0.0.7"),  # read no further than some proxies
    ],
)
def test_behind_proxies_that_are_named_the_last_who_is_none_counts(forwarded, address):
    assert visitor("10.0.0.5", forwarded) == address


def test_other_headers_are_not_looked_at():
    headers = HTTPHeaders({"X-Real-Ip": "203.0.113.9", "Forwarded": "for=203.0.113.9"})
    assert Addresses(PROXIES).of(SimpleNamespace(remote_ip="10.0.0.5", headers=headers)) == "10.0.0.5"


def test_one_customer_has_one_key_with_whatever_address_of_the_new_kind():
    assert visitor("2001:db8:1:2:aaaa::1") == visitor("2001:db8:1:2:bbbb::2") != visitor("2001:db8:1:3::1")
    assert visitor("::ffff:203.0.113.9") == "203.0.113.9"  # of a socket that takes both kinds


@pytest.mark.parametrize("text", ["", "proxy", "10.0.0.5/8", "10.0.0.300", "0.0.0.0/0", "::/0", "*"])
def test_what_is_no_proxy_is_refused(text):
    with pytest.raises(ValueError):
        network_of(text)


def test_a_proxy_that_is_not_named_is_told_of_in_the_log_once(caplog):
    addresses = Addresses()
    with caplog.at_level(logging.WARNING):
        for peer in ("8.8.8.8", "172.17.0.1", "172.17.0.1"):
            addresses.of(SimpleNamespace(remote_ip=peer, headers={"X-Forwarded-For": "1.1.1.1"}))
    assert len(caplog.records) == 1 and "172.17.0.1" in caplog.text and "--behind" in caplog.text


def test_the_page_is_said_to_be_where_it_can_be_opened():
    assert opened_at(5006, "0.0.0.0", [], False) == "localhost:5006"
    assert opened_at(5006, "::1", [], False) == "[::1]:5006"
    assert opened_at(5006, "0.0.0.0", ["192.168.1.20:5006"], False) == "192.168.1.20:5006"  # localhost is refused then
    assert opened_at(5006, "127.0.0.1", ["impact.example.org"], True) == "localhost:5006"
