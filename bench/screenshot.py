"""The picture for the README: `make screenshot`."""

import os
import shutil
import subprocess
import sys
import time
import urllib.request

from playwright.sync_api import sync_playwright

from tests.app.conftest import QUIET, Page, free_port


def main(target: str) -> None:
    port = free_port()
    server = subprocess.Popen([sys.executable, "-m", "app.command", "serve", "--port", str(port)])
    try:
        while True:
            try:
                urllib.request.urlopen(f"http://127.0.0.1:{port}/liveness", timeout=2).read()
                break
            except OSError:
                time.sleep(0.05)
        with sync_playwright() as playwright:
            chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
            browser = playwright.chromium.launch(executable_path=chromium, args=QUIET)
            page = Page(browser, f"127.0.0.1:{port}")
            page.evaluate("() => strikewave.page.player.go(1.25)")
            page.tab.wait_for_timeout(300)
            page.tab.screenshot(path=target)
            browser.close()
    finally:
        server.terminate()
        server.wait(10)


if __name__ == "__main__":
    main(sys.argv[1])
