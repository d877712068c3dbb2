"""The page on what can go wrong promises nothing that no test guards."""

import ast
import itertools
import re

SECTIONS = ["Pictures", "Recipes, exports and drivers", "Notebook and browser"]
GUARD = re.compile(r"`([\w./]+\.(?:py|js))(?:::([^`]+))?`")


def rows(page):
    """Yield the rows of the page's tables without their heads."""
    lines = page.splitlines()
    for above, line in itertools.pairwise(lines):
        if line.startswith("| ") and above.startswith("|"):
            yield line


def names_in(path):
    """Return what a file calls its tests: functions in Python, sentences in JavaScript."""
    text = path.read_text("utf-8")
    if path.suffix == ".js":
        return {a or b for a, b in re.findall(r"\btest\(\s*(?:'([^']+)'|\"([^\"]+)\")", text)}
    return {node.name for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)}


def test_the_page_has_its_three_parts_and_rows_in_each(root):
    page = (root / "docs/developer/robustness.md").read_text("utf-8")
    assert re.findall(r"^## (.+)$", page, re.MULTILINE) == SECTIONS
    for part in page.split("\n## ")[1:]:
        assert len(list(rows(part))) >= 5


def test_every_row_names_tests_that_exist(root):
    homes = [*root.glob("tests/**/*.py"), *root.glob("js/test/**/*.js")]
    for row in rows((root / "docs/developer/robustness.md").read_text("utf-8")):
        named = GUARD.findall(row)
        assert named, f"no test guards: {row}"
        for file, test in named:
            found = [path for path in homes if path.as_posix().endswith(f"/{file}")]
            assert len(found) == 1, f"{file} is not one file"
            assert not test or test in names_in(found[0]), f"{file} has no {test}"
