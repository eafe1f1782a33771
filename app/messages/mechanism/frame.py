"""The message for one impact on a link of a mechanism, as of a beam, and with all links and joints."""

from collections.abc import Sequence

from solvers import Solution
from solvers.bodies import Mechanism
from solvers.methods.multibody.method import Multibody
from solvers.methods.multibody.motion import MovingMotion
from solvers.text.notes import Note

from ...choices.request import Request
from ..histories import force_arrays
from ..transverse import Answer, chosen_method, comparisons, field_arrays, impact_frame, main_solution
from .moving import follow, moving_fields
from .resting import LINK_PLACES, RIGID_LINKS, mechanism_fields, rigid_answer, struck_link


def mechanism_solution(request: Request, figures: Sequence[str] = ()) -> tuple[Solution, Note | None]:
    """The impact, with the note why it is not by the chosen method; of a mechanism that moves on, why links that bend
    are taken as rigid; `figures`: all that is read of it, none: everything."""
    method, _ = chosen_method(request)
    if isinstance(method, Multibody):
        return follow(request, method.without_estimate() if figures else method)
    return main_solution(request, figures)


def mechanism_frame(request: Request) -> bytes:
    """The message, beside it the same with rigid links unless a hand moves on."""
    main, reason = mechanism_solution(request)
    beside = None if request.draft else rigid_answer(main)
    if isinstance(main.motion, MovingMotion):  # turns away from the line of the indentations
        header, arrays = moving_fields(main, request, reason, beside)
        arrays |= force_arrays(main, "main", request.stretch)
        reason = None
    else:
        header, arrays = field_arrays(main, request.stretch, LINK_PLACES)
        linkage, moved = mechanism_fields(main, beside, request.stretch)
        estimate, compared = comparisons(main, header["places"])
        header, arrays = header | linkage | estimate, arrays | moved | compared
    header |= {"kind": "mechanism", "beam": struck_link(main.scene.target.known_as(Mechanism))}
    return impact_frame(request, Answer(main, reason, beside, RIGID_LINKS), header, arrays)
