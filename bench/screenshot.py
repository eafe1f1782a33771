"""The picture for README and documentation: `make screenshot`."""

import sys

from playwright.sync_api import sync_playwright

from tests.app.conftest import QUIET, Page, chromium

from .serving import served_page


def main(target: str) -> None:
    with served_page() as (address, _), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        page = Page(browser, address, "")
        page.evaluate("() => strikewave.page.player.go(1.25)")
        page.tab.wait_for_timeout(300)
        page.tab.screenshot(path=target)
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1])
