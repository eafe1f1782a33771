"""A class of twenty that plays a lesson, four at a time: how long each takes, and what the server computes for it."""

import tempfile
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.app.conftest import QUIET, Page, chromium
from tests.app.page.students import Student, read_by_teacher
from tests.app.servers import Meter, Server

LESSON = "bounce-twice"
STUDENTS, TOGETHER = 20, 4


def main() -> None:
    server = Server(Path(tempfile.mkdtemp()) / "log")
    server.start()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        students: list[Student] = []
        meter, begun = Meter(server), time.monotonic()
        for start in range(0, STUDENTS, TOGETHER):
            pages = [Page(browser, server.address, "liveness", drawn=False) for _ in range(TOGETHER)]
            group = [Student(page, start + k) for k, page in enumerate(pages)]
            for student in group:
                student.begin(LESSON)
            for step in Student.STEPS:
                for student in group:
                    step(student)
            meter.read()
            for page in pages:
                assert page.errors == [] and page.foreign == []
                page.close()
            students += group
        seconds, used = time.monotonic() - begun, meter.read()
        teacher = Page(browser, server.address, f"?class={LESSON}", accept_downloads=True)
        read_by_teacher(teacher, students)
        assert teacher.errors == [] and teacher.foreign == []
        browser.close()
    server.end()
    server.said_no_trace()
    each = f"{seconds / STUDENTS:.1f} s each, one after the other"
    print(f"{STUDENTS} students of {LESSON}, whose codes are read as they were given: {seconds:.0f} s, {each};")
    print(f"the server used {used:.1f} s of a processor, {used / STUDENTS:.2f} s for each")


if __name__ == "__main__":
    main()
