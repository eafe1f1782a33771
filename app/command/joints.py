"""The command `impact joints`: what a joint between two links does to the waves that meet it."""

import json
import math

import solvers
from solvers import SceneError
from solvers.studies.scattering import INCOMING, OUTGOING, JointScattering

from .trust import number
from .words import family, figure, text


def add_arguments(parser) -> None:
    parser.add_argument("--joint", metavar="N", help=text("help.joints.joint"))
    parser.add_argument("--frequencies", metavar="W,W,...", help=text("help.joints.frequencies"))


def print_joints(scene: solvers.Scene, options) -> int:
    """Print the shares of power as a table, or all numbers as JSON."""
    joint = None if options.joint is None else number("--joint", options.joint, int)
    frequencies = None
    if options.frequencies is not None:
        frequencies = [number("--frequencies", each) for each in options.frequencies.split(",")]
    try:
        found = solvers.joint_scattering(scene, joint, frequencies)
    except SceneError as refused:
        if refused.key in ("joint", "frequencies"):
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else report(scene, found))
    return 0


def report(scene: solvers.Scene, found: JointScattering) -> str:
    """One row for each frequency and kind of incoming wave."""
    heads, kinds = family("joints.head"), family("joints.incoming")
    values = {"joint": found.joint, "kind": found.kind, "first": found.links[0], "second": found.links[1]}
    lines = [
        scene.title or text("printed.report.untitled"),
        "  " + text("joints.about", bend=math.degrees(found.bend), **values),
        "",
        f"  {heads['frequency']:>14}  {heads['incoming']:10}" + "".join(f"{heads[name]:>22}" for name in OUTGOING),
    ]
    for frequency, rows in zip(found.frequencies.tolist(), found.powers.tolist(), strict=True):
        for name, row in zip(INCOMING, rows, strict=True):
            lines.append(
                f"  {figure(frequency, '14.6g')}  {kinds[name]:10}" + "".join(figure(share, "22.6f") for share in row)
            )
    return "\n".join([*lines, "", "  " + text("joints.error", error=found.power_error)])
