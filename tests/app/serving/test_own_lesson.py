"""A lesson of a visitor's own sent to the page: its record, or all that is wrong with it, by line; never a burden."""

import json
import time
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from app.lessons import own
from app.lessons.document import LARGEST
from app.lessons.own import MOST_PROBLEMS, read_own, try_own
from app.lessons.record import lesson_record
from app.lessons.shipped import FOLDER, shipped_lesson
from tests.app.lessons.written import CHOICE, HEAD, SUMMARY, fence, nodes_in
from tests.app.sentences import sentence

from ...patience import SECONDS

STEPS = 8
GOAL = 'slider = "mass_ratio"\nrange = [0.5, 9]\nstart = 0.8\ngoal = "contacts = 7"\nnot-yet = "No."\n'


def post(address: str, content: bytes, **headers: str):
    """Status and answer."""
    headers = {"Origin": f"http://{address}"} | headers
    try:
        asked = urllib.request.Request(f"http://{address}/lesson", content, headers)
        with urllib.request.urlopen(asked, timeout=SECONDS) as answer:
            return answer.status, json.load(answer)
    except urllib.error.HTTPError as refused:
        answer = json.load(refused)
        return refused.code, answer | {"error": sentence(answer["error"])}


NO_TOML = "the line cannot be read: it is no KEY = VALUE of TOML "


def refused(content: str | bytes) -> list[tuple[int, str]]:
    given = content.encode() if isinstance(content, str) else content
    return [tuple(each) for each in json.loads(read_own(given, "en"))["problems"]]


@pytest.mark.parametrize("name", ["bounce-twice", "what-an-impact-is"])
def test_a_lesson_is_answered_as_the_page_draws_it(server, name):
    content = (FOLDER / f"{name}.md").read_bytes()
    while not json.loads(try_own(content, "en"))["whole"]:  # what is not compiled yet takes longer than a text may
        pass
    status, answer = post(server, content)
    assert status == 200 and answer["whole"] is True
    assert alike(answer["lesson"], json.loads(json.dumps(lesson_record(shipped_lesson(name)))))


def alike(found: Any, known: Any) -> bool:
    """The same, but for the digits of answers that are solved for here and were stored there."""
    if isinstance(known, dict):
        return found.keys() == known.keys() and all(alike(found[key], known[key]) for key in known)
    if isinstance(known, list):
        return len(found) == len(known) and all(map(alike, found, known))
    return found == (pytest.approx(known, rel=1e-9) if isinstance(known, float) else known)


def test_all_that_is_wrong_is_answered_by_line(server):
    text = (
        HEAD + fence("scene", "changes = { mass_ratio = -1 }\ncolour = 1") + "## Other\n" + CHOICE.replace("right", "x")
    )
    status, answer = post(server, text.encode())
    assert status == 200 and [line for line, _ in answer["problems"]] == [10, 11, 14, 18]
    assert answer["problems"][0][1] == "changes.mass_ratio: got -1; allowed: a number from 0.001 to 1000"
    assert answer["count"] == 4 and "lesson" not in answer


def test_what_its_scenes_do_not_do_is_answered_by_line(server):
    unsolved = fence("scene", 'scene = "newtons-cradle"\nchanges = { law = "rigid" }')
    status, answer = post(server, (HEAD + unsolved + fence("scene", 'at = "touch-9"')).encode())
    assert status == 200 and answer["problems"][0][0] == 8
    assert answer["problems"][0][1].startswith("the scene of this step cannot be sol")
    status, answer = post(server, (HEAD + fence("scene", 'at = "touch-9"')).encode())
    assert answer["problems"][0][1].startswith("at: got touch-9, which does not happen in the scene of this step")


def test_a_translation_alone_is_refused_in_a_sentence():
    [(line, said)] = refused((FOLDER / "bounce-twice.es.md").read_bytes())
    assert line == 5 and said == (
        "translates: this file has the sentences of a translation alone; allowed: a lesson that is whole, such as its "
        "original, bounce-twice.md"
    )


@pytest.mark.parametrize(
    "content, line, said",
    [
        (bytes(range(256)) * 40, 2, "the file is no text in UTF-8"),
        (b"a\nb\n\xff", 3, "the file is no text in UTF-8"),
        (b"\0" * 1000, 1, "the file has no head"),
        (b"", 1, "the file has no head"),
        (HEAD.replace("version: 1", "version: 2") + SUMMARY, 3, "version: got 2; allowed: 1, as this program knows no"),
        (
            HEAD + "## Step\n" + CHOICE + ':::{after}\nat = 1\nplay = [1, "x]\n\nWords.\n:::\n',
            20,
            NO_TOML + "(Unterminated",
        ),
        (HEAD + fence("choice", '[[option]]\ntext = "a"\nsay = "b"\n[[option]\n'), 13, NO_TOML + "(Expected"),
        (HEAD + fence("scene", "show = ['bodies']\n\n\ntime = T"), 13, "the line cannot be read: text"),
        (HEAD + "## Step\n" + ":" * 150_000, 9, ""),
    ],
)
def test_files_are_refused_by_line(content, line, said):
    found = refused(content)
    assert any(at == line and each.startswith(said) for at, each in found), found
    assert all(len(each) <= own.LONGEST and "\n" not in each for _, each in found)


def test_errors_without_end_are_counted_and_the_first_are_listed():
    answer = json.loads(read_own((HEAD + "## Step\n" + ":::{scene}\n:::\n" * 1_200).encode(), "en"))
    assert len(answer["problems"]) == MOST_PROBLEMS and answer["count"] > 1_000


def test_markup_stays_the_words_that_it_is():
    text = '<script>alert(1)</script> <img src=x onerror=alert(1)> [a](https://example.org "x\' onclick=alert(1)")'
    record = json.loads(read_own((HEAD + f"## <b>Step</b>\n{text}\n").encode(), "en"))["lesson"]
    assert record["steps"][0]["title"] == "<b>Step</b>"
    nodes = nodes_in(record)
    assert any("<script>alert(1)</script>" in node.get("text", "") for node in nodes)
    assert [node["target"] for node in nodes if "target" in node] == ["https://example.org"]


def test_half_of_a_letter_does_no_harm(server):
    status, answer = post(server, (HEAD.replace("title: Tried", 'title: "\\uD800"') + SUMMARY).encode())
    assert status == 200 and answer["lesson"]["title"] == "\ud800"


@pytest.mark.parametrize("origin", ["", "http://elsewhere.example"])
def test_other_pages_may_not_send_one(server, origin):
    status, answer = post(server, b"", Origin=origin)
    assert status == 403 and "this page" in answer["error"]


def test_what_is_too_large_is_refused_with_its_size(server):
    status, answer = post(server, b"a" * (LARGEST + 1))
    assert status == 413 and answer["error"] == "This file has 201 kB; allowed: a lesson of up to 200 kB."


HUGE = {
    "lists": "".join("  " * k + "- a\n" for k in range(430)),
    "emphasis": "*a **b " * 27_000,
    "stars": "a**" * 65_000,
    "brackets": "[" * 195_000,
    "links": "[a](" * 48_000,
    "quotes": ">" * 195_000,
    "formulas": "$a" * 97_000,
    "fences": ":::{scene}\n:::\n" * 13_000,
    "keys": ":::{scene}\n" + "".join(f"a{k} = 1\n" for k in range(18_000)) + ":::\n",
    "arrays": ":::{scene}\na = " + "[" * 90_000 + "]" * 90_000 + "\n:::\n",
    "tables": ":::{scene}\n" + "".join(f"[a{k}]\n" for k in range(19_000)) + ":::\n",
    "steps": "## S\n" * 39_000,
}


SLOWEST = "stars", "brackets", "emphasis"


@pytest.mark.parametrize(
    "text", [pytest.param(HUGE[name], id=name, marks=[pytest.mark.slow] * (name in SLOWEST)) for name in HUGE]
)
def test_a_huge_text_takes_seconds_at_most(text):
    content = (HEAD + "## Step\n" + text).encode()
    assert len(content) <= LARGEST
    begun = time.process_time()
    json.loads(read_own(content, "en"))
    assert time.process_time() - begun < 20.0  # 1.4 s of computing on the slowest; a square of it would be hours


def test_scenes_that_take_long_are_given_up_and_the_lesson_is_opened_all_the_same(monkeypatch):
    text = HEAD + "".join(f"## Step\n:::{{scene}}\nchanges = {{ mass_ratio = {k} }}\n:::\n" for k in range(1, 21))
    assert json.loads(try_own(text.encode(), "en")) == {"whole": True}
    monkeypatch.setattr(own, "TRY_SECONDS", 0.0)
    assert json.loads(try_own(text.encode(), "en")) == {"whole": False}


@pytest.mark.slow
def test_the_slowest_scenes_of_several_visitors_hold_up_nobody(server):
    """Steps of which every one is another impact with a goal that no place meets, hundreds of solves."""
    fence_ = ':::{{scene}}\nscene = "free-rod"\nchanges = {{ law = "hertz", mass_ratio = {ratio} }}\n:::\n'
    found = "".join(f'[[found]]\nrange = [{k}, {k}.5]\nsay = "Yes."\n' for k in range(1, 9))
    goal = ":::{{set}} goal-{step}\n" + GOAL + found + ":::\n"
    steps = [f"## Step\n{fence_}{goal}".format(ratio=1.0 + 0.01 * k, step=k) for k in range(STEPS)]
    content = (HEAD + "".join(steps)).encode()
    assert json.loads(read_own(content, "en")).get("problems") is None
    with ThreadPoolExecutor(3) as pool:
        sent = [pool.submit(post, server, content) for _ in range(3)]
        alive = 0
        while not any(each.done() for each in sent):
            with urllib.request.urlopen(f"http://{server}/liveness", timeout=SECONDS) as answer:
                alive += json.load(answer)["alive"]
            time.sleep(0.05)
        assert alive > 3
        assert all(each.result()[0] == 200 for each in sent)
