"""The command `impact` where the page has not been packed."""

import sys

from app.page import packed

if __name__ == "__main__":
    packed.FOLDER = packed.FOLDER.with_name("packed-nowhere")
    from app.command.main import main

    sys.exit(main())
