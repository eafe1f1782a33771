"""The examples of docs/lessons.md are a lesson."""

import re
from pathlib import Path

from app.lessons.checking import check

PAGE = Path(__file__).parents[3] / "docs" / "lessons.md"


def test_the_examples_are_a_lesson_without_errors(tmp_path):
    blocks = re.findall(r"^```markdown\n(.*?)^```$", PAGE.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    whole, *questions = [block for block in blocks if block.startswith(("---", ":::"))]
    assert len(questions) == 5
    path = tmp_path / "documented.md"
    path.write_text(whole + "".join(f"\n## Next\n{each}" for each in questions), "utf-8")
    found = check(path)
    assert found.problems == ()
    assert found.lesson and len(found.lesson.steps) == 6
