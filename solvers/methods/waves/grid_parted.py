"""Whether the parts of a chain on a grid will ever touch again: as `numerics.waves.parted`, from means over steps."""

import math
from typing import Any

import numpy as np

from ...numerics.parting import backwards, reach
from ...numerics.waves.energies import first_energy
from ...numerics.waves.parted import mass_and_momentum, of_part
from ...numerics.waves.parts import ABSORBING, LAW, RIGID_FACES, Chain
from ...numerics.waves.record import OUT_RIGHT, SPEED, TOTAL_LEFT, TOTAL_RIGHT


def clear(history: Any, steps: int) -> bool:
    """Whether after so many steps all parts move apart as wholes, and are further apart than their faces reach."""
    chain, last = history.chain, len(history.laws) - 1
    t, first_mass = history.step * steps, history.given.masses[-1]
    opening = [node for node in range(last + 1) if chain.kind[node] in (RIGID_FACES, LAW)]
    pushed = {node: history.step * np.cumsum(history.force[node, :steps]) for node in opening}
    node = opening[0]
    drift = chain.drift[0] if node else chain.mass_drift[0]
    speed = drift - pushed[node][-1] / first_mass
    place = drift * t - history.step * pushed[node].sum() / first_mass
    ahead = _part(history, 0, node, t)[3] if node else 0.0
    alone = node == history.contact and len(opening) > 1 and not chain.spring
    if alone and _out_of_reach(history, opening[1], pushed, (speed, place, ahead), t):
        return True
    for node, following in zip(opening, [*opening[1:], None], strict=True):
        mass, moving, back, front = _part(history, node, last if following is None else following, t)
        gained = history.step * (pushed[node].sum() - (0.0 if following is None else pushed[following].sum()))
        before = chain.drift[node] if node < last else chain.mass_drift[node]
        there = before * t + gained / mass if math.isfinite(mass) else 0.0
        if following is None and _endless(chain, last):
            there = float(history.sampled(last - 1, TOTAL_RIGHT, np.array([t]))[0]) / float(chain.impedance[last - 1])
        if moving < speed or chain.gap[node] + there - place <= ahead + back:
            return False
        speed, place, ahead = moving, there, front
    return True


def _out_of_reach(history: Any, following: int, pushed: Any, impactor: tuple[float, float, float], t: float) -> bool:
    """As in `numerics.waves.parted`: from the sums of forces that went through the joints."""
    chain, node, (speed, place, ahead) = history.chain, history.contact, impactor
    whole, momentum = mass_and_momentum(chain)
    mass = float(chain.impedance[node:following] @ chain.transit[node:following])
    energy = first_energy(chain) - 0.5 * history.given.masses[-1] * speed**2
    last = len(history.laws) - 1
    if _endless(chain, last):
        energy -= history.squares(last - 1, OUT_RIGHT, 0.0, t) / float(chain.impedance[last - 1])
    fastest, free = backwards(energy, momentum + pushed[node][-1], mass, whole)
    there = chain.drift[node] * t + history.step * (pushed[node].sum() - pushed[following].sum()) / mass
    return bool(-speed > fastest and there - place > ahead + reach(free, of_part(chain, node, following)[1]))


def _part(history: Any, begin: int, end: int, t: float) -> tuple[float, float, float, float]:
    """What is between two nodes as one body: mass, velocity as a whole, how far its first and last faces reach."""
    chain, now, last = history.chain, np.array([t]), len(history.laws) - 1
    striking = begin < history.contact
    near = float(chain.mass_left[begin]) if striking else 0.0
    far, stop = (float(chain.mass_right[end]), end) if end == last and not striking else (0.0, end)
    if _endless(chain, end):
        far, stop = math.inf, end - 1
    masses = chain.impedance[begin:stop] * chain.transit[begin:stop]
    own, momentum = near + float(masses.sum()), float(masses @ chain.drift[begin:stop])
    energy = sum(float(history.rod_energy(rod, now)[0]) for rod in range(begin, stop))
    for rod in range(begin, stop):
        before = now - chain.transit[rod]
        for node, total, sign in ((rod, TOTAL_RIGHT, 1.0), (rod + 1, TOTAL_LEFT, -1.0)):
            momentum += sign * float((history.sampled(node, total, now) - history.sampled(node, total, before))[0])
    for node, beside in ((begin, near), (end, far)):
        if 0.0 < beside < math.inf:
            speed = float(history.sampled(node, SPEED, now)[0])
            momentum, energy = momentum + beside * speed, energy + 0.5 * beside * speed**2
    _, first, second = of_part(chain, begin, end)
    if math.isinf(far):
        gone = 2.0 * math.sqrt(2.0 * max(energy, 0.0) * own) / float(chain.impedance[stop]) if stop < end else 0.0
        return far, 0.0, reach(energy, first) + gone, 0.0
    moving = momentum / (own + far)
    ringing = energy - 0.5 * (own + far) * moving**2
    return own + far, moving, reach(ringing, first), reach(ringing, second)


def _endless(chain: Chain, end: int) -> bool:
    return end == chain.kind.size - 1 and int(chain.kind[end]) == ABSORBING
