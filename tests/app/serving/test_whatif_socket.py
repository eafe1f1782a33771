"""Points of the map over a real socket: they leave the choices, the address and other answers as they are."""

import json

from app.views.whatif import COLUMNS, LONGEST, POINTS
from tests.app.sentences import sentence

from ..socket_client import SocketClient, run


def question(number, names, rows, **more):
    return json.dumps({"id": number, "names": names, "rows": rows} | more)


async def answer_to(client, number):
    """The answer to a question, and the names of all that was changed until it came."""
    changed = []
    while True:
        kind, content = await client.receive()
        for event in content.get("events", []) if kind == "PATCH-DOC" else []:
            changed.append(event.get("attr"))
            if event.get("attr") == "whatif" and (answer := json.loads(event["new"]))["id"] == number:
                return answer, changed


def test_points_are_found_beside_the_choices(server):
    async def ask():
        client = await SocketClient(server).open("?scene=fixed-rod")
        await client.changes(0.3)
        await client.set(POINTS, question(1, ["mass_ratio"], [[0.5], [1e9]]))
        answer, changed = await answer_to(client, 1)
        assert [len(row) for row in answer["rows"]] == [len(COLUMNS)] * 2
        assert [row[0] for row in answer["rows"]] == [0, 1] and sentence(answer["why"]["1"])
        assert set(changed) == {"whatif"}, "no choice, no notice, no panel"
        await client.set(POINTS, question(2, ["mass_ratio"], [[2.0]], set={"speed": 1e9}))
        answer, changed = await answer_to(client, 2)
        assert sentence(answer["error"]) and set(changed) == {"whatif"}
        await client.set(POINTS, "")
        await client.set("mass_ratio", 2.0)
        await client.answer()
        client.close()

    run(ask())


def test_of_many_questions_at_once_the_newest_is_answered(server):
    async def ask():
        client = await SocketClient(server).open("?scene=xylophone-bar")
        await client.changes(0.3)
        rows = [[0.5 + 0.01 * k] for k in range(200)]
        for number in range(8):
            await client.set(POINTS, question(number, ["mass_ratio"], rows))
        answer, changed = await answer_to(client, 7)
        assert 0 < len(answer["rows"]) <= len(rows) and changed.count("whatif") < 8
        client.close()

    run(ask())


def test_too_long_a_question_is_refused_and_the_page_stays(server):
    async def attack():
        client = await SocketClient(server).open("?scene=fixed-rod")
        await client.changes(0.3)
        await client.set(POINTS, (LONGEST + 1) * "1")
        await client.refusal(POINTS)
        await client.set("mass_ratio", 2.0)
        await client.answer()
        client.close()

    run(attack())
