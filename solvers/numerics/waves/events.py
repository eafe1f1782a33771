"""What happens within one step of a node of a chain of rods (see `network`): faces part, touch, a law turns."""

from ...jit.kernels import inner_kernel
from .collocation import STAGES, interpolate

SMOOTH, PARTS, TOUCHES, BENDS, TURNS, FAILS, RETRIES = range(7)  # how a stretch ends
# [T] Below it a step crosses the corner in the force where damping stops the surface from pressing; longer ones are cut
# until they end before it. Larger, and the order of the collocation is lost there.
SHORT_STEP = 1e-7
SAMPLES_PER_STRETCH = 24  # at which events are looked for; with fewer, a gap shorter than one sample is missed
NO_PULL = 1e-12  # force that rigid faces may pull with before they part; depth they may press in before they touch


@inner_kernel
def _first_crossing(values, level, sign):
    """First place in (0, 1] where a polynomial passes a level, going up (sign 1) or down (-1); 2 if it does not."""
    before = 0.0
    for i in range(1, SAMPLES_PER_STRETCH + 1):
        place = i / SAMPLES_PER_STRETCH
        if sign * (interpolate(values, place) - level) > 0.0:
            low, high = before, place
            for _ in range(60):
                middle = 0.5 * (low + high)
                if sign * (interpolate(values, middle) - level) > 0.0:
                    high = middle
                else:
                    low = middle
            return high
        before = place
    return 2.0


@inner_kernel
def face_events(state, node, rods, dent, pull, step, located, work):
    """What happens within a step at rigid faces, or at any faces that are apart: how it ends, step, looks taken.

    What rounding puts at the start of the step happens there: no step is short enough to end with it.
    """
    at_start = 4e-15 * (state.time[node] + 1e-3) / step
    if state.closed[node]:
        if work.forces[0] < -pull:  # a front of tension parts them at once
            state.closed[node], state.opened[node] = False, False
            return RETRIES, step, located
        place = _first_crossing(work.forces, -pull, -1.0)
        if place < at_start:
            state.closed[node], state.opened[node] = False, False
            return RETRIES, step, 0
        ending = PARTS
    else:
        near = not state.opened[node] and work.depth[0] >= dent - pull and work.rate[0] > rods * pull
        if near and interpolate(work.rate, min(at_start, 1.0)) > rods * pull:
            state.closed[node] = True
            state.depth[node] = max(dent, state.depth[node])
            return RETRIES, step, located
        place = _first_crossing(work.depth, dent if state.opened[node] else dent + NO_PULL, 1.0)
        if place < at_start:
            state.closed[node], state.depth[node] = True, dent
            return RETRIES, step, 0
        ending = TOUCHES
    if place <= 1.0 - 1e-9 and located < 3:
        return RETRIES, step * place, located + 1
    return ending if located > 0 or place <= 1.0 else SMOOTH, step, located


@inner_kernel
def law_events(state, node, remembers, loses, dent, corner, span, step, located, attempt, work):
    """The same where the faces press on each other through a law; `located` is the event that is being closed in on."""
    if remembers and state.loading[node] and work.rate[0] < 0.0:  # an arriving front has turned it already
        state.loading[node] = False
        return RETRIES, step, 0
    end = work.depth[STAGES]
    parts = end < dent or located == PARTS
    if parts or (remembers and (end > corner or located == BENDS)):
        level = dent if parts else corner
        late = (end - level) / (min(work.rate[STAGES], -1e-300) if parts else max(work.rate[STAGES], 1e-300))
        if abs(late) <= 2e-15 * max(step, state.time[node]) or attempt > 80:
            work.depth[STAGES] = level
            return PARTS if parts else BENDS, step, located
        return RETRIES, min(max(step - late, 0.1 * step), min(1.5 * step, span)), PARTS if parts else BENDS
    if remembers and state.loading[node]:
        place = _first_crossing(work.rate, 0.0, -1.0)  # where it begins to give way again, the curve changes
        if place <= 1.0 - 1e-9 and located < TURNS + 3:
            return RETRIES, step * place, max(located, TURNS) + 1
        if located > TURNS or place <= 1.0:
            return TURNS, step, located
    first, last = work.forces[0], work.forces[STAGES]
    if loses and state.depth[node] > dent and (first > 0.0) != (last > 0.0) and step > SHORT_STEP:
        # where damping stops the surface from pressing, the force has a corner: step up to it, not across it
        return RETRIES, 0.25 * step, 0
    return SMOOTH, step, located
