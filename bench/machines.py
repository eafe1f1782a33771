"""What every scene gives on other machines, against this one: largest relative difference of its figures.

Chaotic is a scene of which a change of its impactor's mass by 1e-12 is found more than ten thousand times as large.
"""

import numpy as np

import solvers
from tests import machines

from .size import of, some
from .timing import row


def measure() -> dict[str, object]:
    scenes = of(solvers.scene_names(), ["fixed-rod"])
    own = {name: machines.seen(name) for name in scenes}
    factors = {name: machines.sensitivity(solvers.load(name), own[name].figures) for name in scenes}
    chaotic = sorted(name for name, factor in factors.items() if factor > machines.CHAOTIC)
    print(f"  chaotic: {', '.join(chaotic) or 'none'}")
    others = {name: machines.measured(machine, scenes) for name, machine in some(machines.machines()).items()}
    found, rows = {}, []
    for name, theirs in others.items():
        found[name] = {scene: machines.difference(own[scene].figures, theirs[scene].figures) for scene in scenes}
        other_keys = [scene for scene in scenes if own[scene].key != theirs[scene].key]
        calm = [found[name][scene][0] for scene in scenes if scene not in chaotic]
        rows.append(row(f"{name}: largest difference, chaotic scenes left out", max(calm), "", "<= 1e-8"))
        rows.append(row(f"{name}: median difference", float(np.median(calm)), ""))
        rows.append(row(f"{name}: scenes with other keys of tables", len(other_keys), "", "<= 0"))
    worst = {scene: max(found[name][scene] for name in others) for scene in scenes}
    for scene in sorted(scenes, key=lambda each: -worst[each][0])[:12]:
        note = "chaotic" if scene in chaotic else ""
        print(f"  {scene:40}{worst[scene][0]:10.1e}  {worst[scene][1]:24} {factors[scene]:9.1e} times 1e-12  {note}")
    return dict(rows) | {"chaotic": chaotic}
