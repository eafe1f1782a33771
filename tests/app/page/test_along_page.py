"""What is taken along of the map: picture, table, command and Python, link; the command finds the table's numbers."""

import contextlib
import csv
import io
import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers
from app.command.main import main

from .test_page import settled
from .test_take_page import SAID
from .test_whatif_page import DONE, OPEN, WHATIF, opened

pytestmark = pytest.mark.browser
CODES = "() => [...strikewave.page.root.querySelectorAll('.whatif-code pre')].map((each) => each.textContent)"
READY = "() => strikewave.page.root.querySelector('.whatif-code section:not([hidden])')"
RIGID, WITH_LAW = 1e-6, 1e-4  # of a map through a contact law, whose longer steps its table says


def take(page, item: str):
    page.tab.get_by_role("button", name="Take along", exact=True).click()
    page.tab.locator(".whatif-along .drop").get_by_role("button", name=item).click()


def saved(page, item: str, path) -> str:
    """The file that a choice of the menu gives; its name."""
    with page.tab.expect_download() as download:
        take(page, item)
    download.value.save_as(path)
    return download.value.suggested_filename


def table(page, path) -> tuple[str, list[dict[str, str]]]:
    """The lines above it, and its rows."""
    saved(page, "Table (CSV)", path)
    lines = path.read_text("utf-8").splitlines()
    above = [line for line in lines if line.startswith("# ")]
    return "\n".join(above), list(csv.DictReader(line for line in lines if not line.startswith("#")))


def codes(page, folder) -> tuple[str, str]:
    """Command and Python; the scene file is saved as they read it."""
    take(page, "Command and Python")
    page.wait(READY)
    command, python, _ = page.evaluate(CODES)
    dialog = page.tab.locator(".whatif-code")
    with page.tab.expect_download() as download:
        dialog.get_by_role("button", name="Save", exact=True).click()
    download.value.save_as(folder / download.value.suggested_filename)
    page.tab.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    return command, python


def run(command: str, python: str) -> tuple[Any, Any]:
    """What both find; both write a report of it."""
    import xarray

    study, report = (shlex.split(line)[1:] for line in command.splitlines())
    with contextlib.redirect_stdout(io.StringIO()):
        assert main(study) == main(report) == 0
        given: dict[str, Any] = {}
        exec(python, given)
    out = study[study.index("--out") + 1]
    assert report == ["report", out]
    for page in (Path(f"{out}.html"), Path(out).with_suffix(".html")):
        assert "Study report" in page.read_text("utf-8")
    with xarray.open_dataset(out) as data:
        return data.load(), given["data"]


def points(data: Any, figure: str) -> Iterator[tuple[tuple[float, ...], float]]:
    """Values of all keys, and the figure there."""
    flat = data[figure].stack(all=data[figure].dims)
    keys = [flat[name].values for name in data[figure].dims]
    yield from zip(zip(*keys, strict=True), flat.values, strict=True)


LINKS = solvers.load("four-bar")
ROD, BALL = solvers.load("fixed-rod").target.mass, solvers.load("two-balls").target.mass
SCENES = [  # query, what the map shows, its axes as keys of the scene file, result, its column, difference
    ("", "peak_force,mass_ratio,speed", lambda x, y: (ROD / x, y), "peak_force", "peak_force_N", RIGID),
    (
        *("&law=hertz", "vibration,mass_ratio,hertz_stiffness", lambda x, y: (ROD / x, y)),
        *("vibration_share", "vibration_share", WITH_LAW),
    ),
    (
        *("&scene=hammer-on-cantilever", "impactor_velocity,speed,place", lambda x, y: (x, y)),
        *("impactor_velocity", "impactor_velocity_m/s", RIGID),
    ),
    (
        *("&scene=four-bar", "peak_force,speed,mass_ratio"),
        *(lambda x, y: (LINKS.target.velocity + x, LINKS.target.mass / y), "peak_force", "peak_force_N", RIGID),
    ),
    ("", "contact_time,target.length,speed", lambda x, y: (x, y), "contact_time", "contact_time_s", RIGID),
    ("&scene=two-balls", "newton,mass_ratio,speed", lambda x, y: (BALL / x, y), "newton", "newton", WITH_LAW),
]


@pytest.mark.parametrize(("query", "said", "keyed", "figure", "column", "within"), SCENES)
def test_command_and_python_find_the_numbers_of_the_table(
    show, tmp_path, monkeypatch, query, said, keyed, figure, column, within
):
    page = opened(show, f"?layout=opening{query}&whatif={said}", (390, 844))
    above, rows = table(page, tmp_path / "table.csv")
    assert "# link = " in above and "# kind = " in above and ("tolerance" in above) == (within > RIGID)
    command, python = codes(page, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert f"--figure {figure} " in command and command.split()[2] in python
    by_command, by_python = run(command, python)
    x, y, *_ = rows[0]
    known = {keyed(float(row[x]), float(row[y])): float(row[column]) for row in rows if not row["refused"]}
    keys, values, least = np.array(list(known)), list(known.values()), 1e-9 if within == RIGID else within
    for data in (by_command, by_python):
        found = 0
        for at, value in points(data, figure):
            near = np.flatnonzero(np.all(np.isclose(keys, at, rtol=1e-9, atol=1e-12), 1))
            if near.size:
                assert value == pytest.approx(values[near[0]], rel=within, abs=least), at
                found += 1
        assert found > 40, (command, found)


def test_keys_that_go_with_both_axes_are_varied_together(show, tmp_path, monkeypatch):
    query = "?layout=opening&scene=hammer-on-cantilever&whatif=peak_force,slenderness,mass_ratio"
    page = opened(show, query, (390, 844))  # each of its points takes the server some 7 ms
    command, python = codes(page, tmp_path)
    assert "target.length" in command and command.count("--vary") == 1 and "(" in command
    _, rows = table(page, tmp_path / "table.csv")
    monkeypatch.chdir(tmp_path)
    data = run(command, python)[0]
    scene = solvers.load("hammer-on-cantilever")
    known = {
        (float(row["slenderness"]), float(row["mass_ratio"])): float(row["peak_force_N"])
        for row in rows
        if not row["refused"] and float(row["contacts"]) < 6  # with more no two computers have the same
    }
    found = 0
    depth = scene.target.length / scene.target.slenderness
    density = scene.target.mass / scene.target.length
    for length, mass, force in zip(
        *(data[name].values for name in ("target.length", "impactor.mass", "peak_force")), strict=True
    ):
        at = (length / depth, density * length / mass)
        near = [value for key, value in known.items() if np.allclose(key, at, rtol=1e-9)]
        assert not near or force == pytest.approx(near[0], rel=WITH_LAW), (at, length, mass)
        found += len(near)
    assert found > 20


def test_pictures_hold_title_axes_contours_and_status(show, tmp_path):
    page = opened(show, "?layout=opening&law=hertz&whatif=peak_force,mass_ratio,hertz_stiffness,20000")
    path = tmp_path / "picture"
    assert saved(page, "Picture (PNG)", path) == "strikewave-fixed-rod-map.png"
    across, _ = np.frombuffer(path.read_bytes()[16:24], ">u4")
    assert across > 2 * page.tab.locator(".whatif-map").bounding_box()["width"]
    assert saved(page, "Picture (SVG)", path) == "strikewave-fixed-rod-map.svg"
    text = path.read_text("utf-8")
    found = page.evaluate(SAID, text)
    words = " ".join(found["words"])
    status = " ".join(page.tab.locator(".whatif-status").inner_text().split())
    for said in ("Peak force over Mass ratio and Stiffness", "Mass ratio →", "1 contact", status, "· Strikewave"):
        assert said in words, said
    assert found["name"] == "svg" and text.count("<image") == 2 and found["drawn"] > 30
    assert text.count(" L ") > 500, "contours are lines"
    for mode, title in (("Curves", "All results over Mass ratio"), ("Tolerance", "How sure is Peak force ?")):
        page.tab.get_by_role("button", name=mode, exact=True).click()
        page.wait(f"() => {WHATIF}.modes.shown?.jobs.shown?.whole")
        assert saved(page, "Picture (SVG)", path) == f"strikewave-fixed-rod-{mode.lower()}.svg"
        found = page.evaluate(SAID, path.read_text("utf-8"))
        assert title in " ".join(found["words"]) and found["drawn"] > 20
        assert saved(page, "Picture (PNG)", path) and path.stat().st_size > 20_000
    page.tab.get_by_role("button", name="Map", exact=True).click()


def test_curves_are_taken_along_as_rows_and_as_a_study_of_one_key(show, tmp_path, monkeypatch):
    page = show("?layout=opening", (1280, 720))
    settled(page)
    page.evaluate(OPEN, "curves:newton,mass_ratio,speed")
    page.wait(f"() => {WHATIF}?.modes.curves.jobs.shown?.whole")
    _, rows = table(page, tmp_path / "table.csv")
    ratios = [float(row["mass_ratio"]) for row in rows]
    assert len(rows) > 165 and ratios == sorted(ratios), "samples, and both sides of each change"
    command, python = codes(page, tmp_path)
    assert command.count("--vary") == 1 and "--figure contacts" in command
    monkeypatch.chdir(tmp_path)
    masses = ROD / np.array(ratios)
    for data in run(command, python):
        assert data.sizes == {"impactor.mass": 161}
        for mass, newton, share in zip(data["impactor.mass"], data["newton"], data["vibration_share"], strict=True):
            (row,) = (rows[k] for k in np.flatnonzero(np.isclose(masses, float(mass), rtol=1e-9)))
            assert float(row["newton"]) == pytest.approx(float(newton), rel=RIGID)
            assert float(row["vibration_share"]) == pytest.approx(float(share), rel=RIGID, abs=1e-9)


def test_tolerances_are_taken_along_as_samples_and_as_the_command_for_them(show, tmp_path, monkeypatch):
    page = show("?layout=opening", (1280, 720))
    settled(page)
    page.evaluate(OPEN, "tolerance:peak_force,mass_ratio,speed")
    page.wait(f"() => {WHATIF}?.modes.tolerance.jobs.shown?.whole && {WHATIF}.jobs.idle && !{WHATIF}.due")
    _, rows = table(page, tmp_path / "table.csv")
    peaks = np.array([float(row["peak_force_N"]) for row in rows])
    assert len(rows) == 4000 and {"mass_ratio", "speed_m/s"} <= rows[0].keys()
    command, python = codes(page, tmp_path)
    assert command.startswith("impact uncertain fixed-rod.toml --tolerance ")
    monkeypatch.chdir(tmp_path)
    with contextlib.redirect_stdout(io.StringIO()) as said:
        assert main(shlex.split(command)[1:]) == 0
        given: dict[str, Any] = {}
        exec(python, given)
    assert "peak force" in said.getvalue()
    quantiles = given["found"].figures["peak_force"].quantiles
    spread = np.ptp(np.quantile(peaks, [0.05, 0.95]))
    for share, value in quantiles.items():
        assert value == pytest.approx(np.quantile(peaks, share / 100), abs=0.03 * spread)


def test_bodies_in_space_have_no_command_and_say_so(show):
    page = opened(show, "?layout=opening&scene=brick-on-floor&whatif=newton,speed,friction", (390, 844))
    take(page, "Command and Python")
    dialog = page.tab.locator(".whatif-code")
    expect(dialog.get_by_role("status")).to_contain_text("No value of a scene file")
    box = dialog.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= 390
    dialog.get_by_title("Close").click()
    expect(dialog).to_be_hidden()


def test_a_link_holds_what_is_seen(open_page):
    page = open_page("?whatif=peak_force,mass_ratio,speed,40000")
    page.wait(DONE)
    box = page.tab.locator(".whatif-map").bounding_box()
    page.tab.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.tab.mouse.wheel(0, -400)
    goal = page.tab.locator(".whatif-goal")
    goal.get_by_role("combobox").select_option("mass_ratio")
    goal.get_by_role("button", name="hold").click()
    page.wait("() => /,x:.*,y:.*,gives:mass_ratio,hold/.test(new URLSearchParams(location.search).get('whatif'))")
    page.tab.get_by_role("button", name="Tolerance", exact=True).click()
    page.tab.get_by_role("button", name="More: Impact speed").click()
    page.wait("() => /^tolerance:.*,tolerance:speed:0.05$/.test(new URLSearchParams(location.search).get('whatif'))")
    seen = f"""() => [{WHATIF}.said, {WHATIF}.ranges.shown.get('speed').map((place) => place.toFixed(3)),
      {WHATIF}.goal.gives, {WHATIF}.goal.holds, {WHATIF}.modes.tolerance.parts.get('speed'), {WHATIF}.modes.mode]"""
    before = page.evaluate(seen)
    query = page.evaluate("() => location.search")
    again = open_page(query)
    again.wait(f"() => {WHATIF}?.modes.tolerance.jobs.shown?.whole")
    assert again.evaluate(seen) == before and before[3:] == [True, 0.05, "tolerance"]


@pytest.mark.parametrize(
    "said",
    [
        "peak_force,mass_ratio,speed,,x:9:1,y:a:b,gives:none,hold,tolerance:speed:9,later:1",
        "later:newton,speed,mass_ratio",
    ],
)
def test_what_a_link_cannot_say_is_passed_over(open_page, said):
    page = open_page(f"?whatif={said}")
    page.wait(DONE)
    assert page.evaluate(f"() => [{WHATIF}.goal.holds, {WHATIF}.ranges.shown.get('mass_ratio').join()]") == [
        False,
        "1.5,4.5",
    ]
    expect(page.tab.locator(".toast")).to_be_hidden()
