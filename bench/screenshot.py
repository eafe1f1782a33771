"""The picture for README and documentation: `make screenshot`."""

import os
import shutil
import sys

from playwright.sync_api import sync_playwright

from tests.app.conftest import QUIET, Page

from .serving import served_page


def main(target: str) -> None:
    with served_page() as (address, _), sync_playwright() as playwright:
        chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
        browser = playwright.chromium.launch(executable_path=chromium, args=QUIET)
        page = Page(browser, address)
        page.evaluate("() => strikewave.page.player.go(1.25)")
        page.tab.wait_for_timeout(300)
        page.tab.screenshot(path=target)
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1])
