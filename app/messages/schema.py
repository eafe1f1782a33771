"""What stands in a message to the browser: every field of its header and every array, with unit and dimensions.

`packed` refuses what is not said here. The browser has it as types, in app/static/messages.d.ts: see `declarations`.
"""

import re
from typing import Any

from .field import Field, Fields, optional
from .records import RECORDS

HEAD = Field("string", "of saved histories: scene and methods in TOML, table `saved` last")
COMMON: Fields = {
    "head": HEAD,
    "kind": Field("string", "of the message: axial, beam, mechanism or bodies"),
    "chosen": Field("Chosen", "a value for every choice; None outside the page"),
    "own": Field("Chosen", "the same, as the page opens the scene"),
    "draft": Field("boolean", "whether it is solved by fewer modes and elements than chosen"),
    "stretch": Field("[start: number, end: number] | null", "of time that histories are of [s]; None: all of it"),
    "acting": Field("string[]", "choices that act on this scene"),
    "refusals": Field("Record<string, Note | null>", "by method: why it cannot solve the scene, or None"),
    "title": Field("string"),
    "source": Field("string"),
    "note": Field("string"),
    "weight": Field("number", "by which its weight accelerates the impactor towards the target [m/s2]", True),
    "parts": Field("PartRecord[]", "bodies, and rods, links and joints one by one"),
    "unshown": Field("string[]", "keys that the scene sets and that have no control"),
    "opens": Field("Opens", "what the scene is opened with"),
    "duration": Field("number", "axial [T], else [s]; bodies: on either side of the impact"),
}
CYCLE: Fields = optional(
    {
        "cycleDepth": Field("(cycle)", "indentation [m]"),
        "cycleLoading": Field("(cycle)", "force of the law, slowly to the depth of this impact [N]"),
        "cycleUnloading": Field("(cycle)", "and back [N]"),
        "blowDepth": Field("(impact)", "indentation in this impact [m]"),
        "blowForce": Field("(impact)", "force in it [N]"),
        "touchTime": Field("(impact)", "of two smooth bodies that touch in a point [s]"),
        "touchRadius": Field("(impact)", "of the circle on which they touch [m]"),
        "touchPressure": Field("(impact)", "the greatest there, the mean of a contact that flows [Pa]"),
        "touchFlow": Field("(impact)", "that mean over the yield strength"),
        "flowDepth": Field("(flow)", "by Tabor's law, slowly: indentation [m]"),
        "flowPressure": Field("(flow)", "mean pressure over the yield strength"),
        "flowRadius": Field("(flow)", "of the circle [m]"),
        "flowElastic": Field("(flow)", "the same by Hertz [m]"),
        "testsDepth": Field("(tests)", "of those, what Tabor's tests reach: indentation [m]"),
        "testsPressure": Field("(tests)", "mean pressure in the tests over the yield strength"),
        "testsForce": Field("(tests)", "force in them [N]"),
    }
)
STRIKER = Field("Striking")
AXIAL: Fields = {
    **COMMON,
    **CYCLE,
    "trip": Field("number", "T, the round trip of a wave or the time of a contact [s]"),
    "rods": Field("RodRecord[]", "from left to right; none if no wave runs"),
    "impactor": STRIKER,
    "target": Field("TargetRecord"),
    "speed": Field("number", "v, of the impact [m/s]"),
    "forceUnit": Field("number", "Z v [N]"),
    "stressUnit": Field("number", "v sqrt(E rho) [Pa]"),
    "modes": Field("number", "chosen"),
    "step": Field("number | null", "of the modal force, or that on the modes [T]"),
    "asked": Field("number", "for how long the impact is followed if that is asked [T], else 0"),
    "usualSteps": Field("boolean", "whether modes are marched in as many steps as follow from the choices"),
    "givesWay": Field("boolean", "whether modes that are left out do"),
    "attached": Field("boolean", "whether these modes are those of a frame fixed to the struck end"),
    "exact": Field("AxialFigures"),
    "other": Field("AxialFigures | null", "the method beside it"),
    "gaps": Field("Gap[]", "between rods: number of the second rod, and when it is closed [T]"),
    "lastBall": Field("[time: number, velocity: number] | null", "of a row, parted for good [T, v]"),
    "prediction": Field("{ impactor: number, target: number } | null", "velocities by rigid-body theory [v]"),
    "match": Field("number | null", "restitution that would have matched"),
    "rigid": Field("boolean", "whether nothing gives way at the contact itself"),
    "laws": Field("LawRecord[]", "of a mass on a rod, that can be chosen: for kernels of the browser"),
    "chain": Field(
        "ChainRecord | null", "of rods one behind the other, with rigid faces: for the kernel that follows their waves"
    ),
    "balance": Field("BalanceRecord | null", "of a mass that is balanced against a rod, or against a mass on a spring"),
    "compact": Field(
        "{ sine: boolean } | null",
        "of two bodies that move as wholes, by a law and its closed form, or a half sine for it",
    ),
    "springCarries": Field(
        "number | null", "share of its mass with the end of a rod that bends as a spring by the other method; else None"
    ),
    "damps": Field("boolean", "whether the contact law does"),
    "yields": Field("boolean", "whether the contact law does"),
    "exponent": Field("number", "power of the indentation with which its force begins, 1 where nothing gives way"),
    "nominal": Field("number | null", "restitution by the usual formula of the law"),
    "leastRestitution": Field("number", "that a damping law delivers"),
    "cushions": Field("Cushion[]", "sheets that can lie on the struck face"),
    "motionTime": Field("(motion)", "[T]"),
    "exactMass": Field("(motion)", "displacement of the impactor [v T]"),
    "exactEnd": Field("(motion)", "and of the struck end [v T]"),
    "exactWhole": Field("(motion)", "and of the mass centre of a rod that nothing holds [v T]", True),
    "exactRow": Field("(motion, balls)", "displacement of every ball of a row, gaps before it included [v T]", True),
    "exactRowVelocity": Field("(motion, bodies)", "velocity of the impactor and of every ball of a row [v]", True),
    "exactRowForce": Field("(motion, balls)", "force of every contact of a row, from the impactor's on [Z v]", True),
    "exactTime": Field("(exact force)", "at a jump twice [T]"),
    "exactForce": Field("(exact force)", "[Z v]"),
    **optional(
        {
            "fall": Field("FallRecord", "of a body that is dropped"),
            "fallTime": Field("(fallen)", "from its release on [s]"),
            "fallHeight": Field("(fallen)", "parabola by parabola [m]"),
            "bounces": Field(
                "(bounces, 4)", "time from the release on [s], impulse [N s], height after it [m], restitution"
            ),
            "touches": Field("(bounces, 2)", "how long each touches [s], and its largest force [N]"),
            "touchForce": Field("(bounces, touch)", "evenly over that [N]"),
            "f#Time": Field("(wave f#)", "of the wave that the left end of rod # sends; at a jump twice [T]"),
            "f#": Field("(wave f#)", "[Z v]"),
            "g#Time": Field("(wave g#)", "likewise of its right end, unless that only mirrors"),
            "g#": Field("(wave g#)", "[Z v]"),
            "otherMass": Field("(motion)", "[v T]"),
            "otherEnd": Field("(motion)", "[v T]"),
            "otherTime": Field("(other force)", "[T]"),
            "otherForce": Field("(other force)", "[Z v]"),
            "modalForce": Field("(steps)", "one for each step, from which the browser rebuilds the modes [Z v]"),
            "fieldForce": Field(
                "(steps)", "likewise, for the fields alone: its history is that of the other force [Z v]"
            ),
            "exactBar": Field("(motion, bar places)", "of a pendulum that bends, from its pivot on [v T]"),
            "otherBar": Field("(motion, bar places)", "likewise [v T]"),
            "exactBend": Field("(half motion, half bar places)", "bending moment there, of every second [N m]"),
            "otherBend": Field("(half motion, half bar places)", "likewise [N m]"),
            "momentTime": Field("(moments)", "[T]"),
            "exactMoments": Field("(moments, 3)", "of a bar that bends: at its pivot, half way, at the contact [N m]"),
            "otherMoments": Field("(moments, 3)", "[N m]"),
            "balanceTime": Field("(balances)", "[T]"),
            "balanceForce": Field("(balances)", "impulse over the step [Z v]"),
            "balanceShapes": Field("(balanced modes, places)", "and motion as a whole, of what is struck [kg^-1/2]"),
            "balanceStresses": Field("(balanced modes, places)", "tension per 1 of each coordinate [Pa / (m kg^1/2)]"),
            "turningBar": Field(
                "(motion, bar places)", "of a rod that turns and is struck across, from its axis on [v T]"
            ),
            "exactStress": Field("(exact instants, exact places)", "of a rod that turns [v sqrt(E rho)]"),
            "exactVelocity": Field("(exact instants, exact places)", "[v]"),
            "exactDisplacement": Field("(exact instants, exact places)", "[v T]"),
            "fieldStress": Field("(instants, places)", "[v sqrt(E rho)]"),
            "fieldVelocity": Field("(instants, places)", "[v]"),
            "fieldDisplacement": Field("(instants, places)", "[v T]"),
        }
    ),
}
BENDING: Fields = {  # of a beam, or the struck link of a mechanism
    **COMMON,
    **CYCLE,
    "refused": Field("Note | null", "why the chosen method is not shown"),
    "trip": Field("number", "1: the unit of its times [s]"),
    "period": Field("number", "T: the slowest of the beam; where nothing rings, a millisecond [s]"),
    "speed": Field("number", "of the impact [m/s]"),
    "beam": Field("BeamRecord"),
    "impactor": STRIKER,
    "law": Field("{ name: string, damps: boolean, yields: boolean, rigid: boolean, exponent: number }"),
    "main": Field("BeamFigures"),
    "reference": Field("BeamFigures | null", "the same impact by another number of modes"),
    "span": Field(
        "{ apparent: number, real: number, half: number | null }",
        "first touch to last parting, in contact, half a period with the impactor on the beam [s]",
    ),
    "places": Field("number", "along the beam, of every field"),
    "time": Field("(time)", "[s]"),
    "impactorPath": Field("(time)", "[m]"),
    "struckPath": Field("(time)", "[m]"),
    "impactorRate": Field("(time)", "[m/s]"),
    "struckRate": Field("(time)", "[m/s]"),
    "contacts": Field(
        "(contacts, 4)", "start, end [s], impulse [N s], peak force [N]; of many the first, and the last"
    ),
    "rates": Field("(listed, 2, 2)", "as each contact begins and ends: of impactor and struck place [m/s]"),
    **optional(
        {
            "wavenumbers": Field("(wavenumbers)", "[1/m]"),
            "lower": Field("(wavenumbers)", "angular frequency [rad/s]"),
            "modeFrequencies": Field("(kept modes)", "[rad/s]"),
            "modeWavenumbers": Field("(kept modes)", "[1/m]"),
            "upper": Field("(wavenumbers)", "of the shear branch [rad/s]"),
            "referenceImpactorPath": Field("(time)", "[m]"),
            "referenceStruckPath": Field("(time)", "[m]"),
            "referenceTime": Field("(reference)", "[s]"),
            "referenceForce": Field("(reference)", "[N]"),
            "mainTime": Field("(main)", "of methods without modes [s]"),
            "mainForce": Field("(main)", "[N]"),
            "staticTime": Field("(static)", "of the quasi-static estimate [s]"),
            "staticPath": Field("(static)", "of the struck place [m]"),
            "staticShape": Field("(places)", "of the beam bent at rest, 1 at the struck place"),
            "halfTime": Field("(half)", "of the same impact on a half-space [s]"),
            "halfForce": Field("(half)", "[N]"),
            "modalForce": Field("(steps)", "one for each step [N]"),
            "modalFrequencies": Field("(drawnModes)", "[rad/s]"),
            "modalAtContact": Field("(drawnModes)", "mass-normalised [kg^-1/2]"),
            "shapeRows": Field("(drawnModes, places)", "deflection over its scale"),
            "shapeScale": Field("(drawnModes)", "[kg^-1/2]"),
            "momentRows": Field("(drawnModes, places)", "bending moment over its scale"),
            "momentScale": Field("(drawnModes)", "[N m/(m kg^1/2)]"),
            "shearRows": Field("(drawnModes, places)", "shear force over its scale"),
            "shearScale": Field("(drawnModes)", "[N/(m kg^1/2)]"),
            "momentBeside": Field("(places)", "of the modes left out, for a force of 1 N [N m]"),
            "shearBeside": Field("(places)", "[N]"),
            "rigidShape": Field("(places)", "movement of the beam as a whole, 1 at the struck place"),
            "step": Field("number", "of the modal force [s]"),
            "smoothing": Field("number", "over which the modes left out follow the force [s]"),
            "damping": Field("number", "of critical"),
            "rigidMass": Field("number | null", "felt at the struck place; None if the beam is held [kg]"),
            "drift": Field("number", "of the beam as a whole before the impact [m/s]"),
            "drawnModes": Field("number"),
            "staticModel": Field("string | null", "of the quasi-static estimate, which says nothing of some"),
            "keptModes": Field("number"),
            "fieldTime": Field("(instants)", "of methods without modes, closer together at first [s]"),
            "fieldDeflection": Field("(instants, places)", "[m]"),
            "fieldVelocity": Field("(instants, places)", "[m/s]"),
            "fieldMoment": Field("(instants, places)", "[N m]"),
            "fieldShear": Field("(instants, places)", "[N]"),
        }
    ),
}
BEAM: Fields = {
    **BENDING,
    "march": Field("MarchRecord | null", "by which a browser finds the same impact with other choices"),
    "laws": Field("LawRecord[]", "that can be chosen there, in units of s, v and kg v/s"),
    "leastRestitution": Field("number", "that a damped law can deliver"),
}
MECHANISM: Fields = {
    **BENDING,
    "mechanism": Field("MechanismRecord", "of which the struck link stands for the beam"),
    "moving": Field("MovingRecord | null", "of one that moves on as far as it goes"),
    **optional(
        {
            "linkPoints": Field("(links, link places, 2)", "as the impact begins; unbent if it moves on [m]"),
            "linkTime": Field("(link instants)", "closer together at first [s]"),
            "linkMoves": Field("(link instants, links, link places, 2)", "how far they have come [m]"),
            "massPlaces": Field("(link instants, 2)", "of one that moves on: where the mass is [m]"),
            "normals": Field("(2, edges)", "as contacts begin and end: time [s], angle of the normal [rad]"),
            "bendTime": Field("(bend instants)", "[s]"),
            "amountsOf#": Field("(bend instants, shapes of link #)", "of the shapes of link #, each over its largest"),
            "shapeOf#": Field("(shapes of link #, bend places)", "displacement, moment and shear over their scales"),
            "shapeScaleOf#": Field("(shapes of link #)", "[m]"),
            "momentOf#": Field("(shapes of link #, bend places)"),
            "momentScaleOf#": Field("(shapes of link #)", "[N m]"),
            "shearOf#": Field("(shapes of link #, bend places)"),
            "shearScaleOf#": Field("(shapes of link #)", "[N]"),
            "energyTime": Field("(energy instants)", "[s]"),
            "energies": Field("(energy instants, energy parts)", "[J]"),
            "reactionTime": Field("(reaction instants)", "[s]"),
            "reactions": Field("(reaction instants, joints, 3)", "on the second link of each joint [N, N, N m]"),
            "referenceReactionTime": Field("(reference reaction instants)", "[s]"),
            "referenceReactions": Field("(reference reaction instants, joints, 3)", "[N, N, N m]"),
        }
    ),
}
BODIES: Fields = {
    **COMMON,
    "size": Field("number", "of what is drawn [m]"),
    "across": Field("Vector", "of the picture, to the right"),
    "up": Field("Vector", "of the picture"),
    "normal": Field("Vector", "of the contact"),
    "ownFrame": Field("Vector[]", "the normal as the scene has it, and two tangents, from which a tilt counts"),
    "impulse": Field("number", "its size [N s]"),
    "push": Field("Vector", "the impulse on the target [N s]"),
    "friction": Field("number"),
    "sliding": Field(
        "{ kind: 'slip' | 'stick' | 'reversal', until: number }[]", "of the contact; none without friction [N s]"
    ),
    "bodies": Field("{ impactor: BodyRecord, target: BodyRecord }"),
    "figures": Field("FigureRecord[]", "beside the picture: name, number or vector, unit"),
    "notes": Field("Note[]"),
    "impactorPath": Field("(samples, 3)", "of the centre, from the point of impact [m]"),
    "targetPath": Field("(samples, 3)", "[m]"),
    "impactorTurn": Field("(samples, 3, 3)", "from the instant of the impact"),
    "targetTurn": Field("(samples, 3, 3)"),
    **optional(
        {
            "slidePress": Field("(course)", "normal impulse, where there is friction [N s]"),
            "slideParting": Field("(course)", "velocity at which the touching points part [m/s]"),
            "slideAlong": Field("(course)", "at which the impactor slides on the target, in the picture [m/s]"),
            "slideAside": Field("(course)", "and towards who looks [m/s]"),
            "slideImpulse": Field("(course, 3)", "on the target, so far [N s]"),
            "slidePush": Field("(course)", "size of the impulse of friction [N s]"),
            "slideSpins": Field("(course, 2, 3)", "of the impactor and of the target [rad/s]"),
        }
    ),
}
FRAMES = {"axial": "AxialFrame", "beam": "BeamFrame", "mechanism": "MechanismFrame", "bodies": "SpaceFrame"}
MESSAGES = {"axial": AXIAL, "beam": BEAM, "mechanism": MECHANISM, "bodies": BODIES}  # by kind


def check(header: dict[str, Any], shapes: dict[str, tuple[int, ...]]) -> None:
    """Raise ValueError if a message is not as said here: names, dimensions, and the keys of records.

    A dimension has one length in a message, and that of the header where a field there has its name.
    """
    fields = MESSAGES[header["kind"]]
    _check_names("message", fields, header | shapes)
    lengths = {name: size for name, size in header.items() if isinstance(size, int)}
    for name, shape in shapes.items():
        number = "".join(re.findall(r"\d+", name))
        sides = _pattern(fields, name).form.strip("()").replace("#", number).split(", ")
        said = [
            int(side) if side.isdigit() else lengths.setdefault(side, size)
            for side, size in zip(sides, shape, strict=False)
        ]
        if len(sides) != len(shape) or said != list(shape):
            raise ValueError(f"{name}: got {shape}; expected {sides} = {said}")
    for name, field in fields.items():
        record = RECORDS.get(field.form.removesuffix("[]").removesuffix(" | null"))
        value = header.get(name)
        for each in value if isinstance(value, list) else [value]:
            if record is not None and each is not None:
                _check_names(name, record, each)


def _check_names(what: str, fields: Fields, found: dict[str, Any]) -> None:
    names = {re.sub(r"\d+", "#", name) for name in found}
    needed = {name for name, field in fields.items() if not field.optional}
    if names - fields.keys() or needed - names:
        raise ValueError(f"{what}: unknown {sorted(names - fields.keys())}, missing {sorted(needed - names)}")


def _pattern(fields: Fields, name: str) -> Field:
    return fields[re.sub(r"\d+", "#", name)]
