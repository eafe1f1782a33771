"""Formulas in the words of scene files, as the page writes them."""

import pytest

import solvers
from app.page.picker import scene_groups
from app.text.typeset import typeset


@pytest.mark.parametrize(
    "words, shown",
    [
        ("grows as a^2 = 2 alpha R", "grows as a² = 2 α R"),
        ("A v sqrt(E rho), omega^2 = omega_0^2", "A v √(E ρ), ω² = ω_0²"),
        ("6.92e9 N/m^1.5, e^(-2 beta), (1 + beta/3)^-1/2", "6.92e9 N/m¹·⁵, e^(-2 β), (1 + β/3)^-1/2"),
        ("a pin, a piston, alphabet", "a pin, a piston, alphabet"),
    ],
)
def test_formulas_have_their_signs(words, shown):
    assert typeset(words) == shown


def test_titles_in_the_list_of_scenes_are_set():
    titles = [title for _, scenes in scene_groups() for _, title in scenes]
    assert any("a² = α R" in title for title in titles)
    assert not any("^" in title or "alpha" in title for title in titles)
    assert len(titles) == len(solvers.scene_names())
