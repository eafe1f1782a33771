"""The pictures of the gallery, made anew of today's solutions: python -m bench.pictures

Takes some seconds, a minute more where kernels have to be compiled.
"""

import json

from app.messages.gallery.cards import SCENES_SHOWN, STORED, TAUGHT
from app.messages.gallery.pictures import picture_of


def main() -> None:
    pictures = (
        f"{json.dumps(name)}: {json.dumps(picture_of(name), separators=(',', ':'))}"
        for name in (*SCENES_SHOWN, *TAUGHT)
    )
    STORED.write_text("{\n" + ",\n".join(pictures) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
