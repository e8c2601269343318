"""Checks rules of the text of the project.

Fails on: a module folder or a case without README.md; a relative link in a Markdown file that leads
nowhere; a citation [key] in docs that docs/bibliography.bib does not hold; a source file above 500
lines; a word that marks unfinished work; a line that ends in white space.

Run as: text_rules.py ROOT            (the check)
        text_rules.py --self-test     (the check must find faults planted in a made-up tree)
"""

import pathlib
import re

from lint_script import main

SOURCES = {".hpp", ".cpp", ".H", ".C", ".py", ".sh", ".cmake"}
LONGEST = 500  # lines
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX|not impl" r"emented)\b", re.IGNORECASE)
LINK = re.compile(r"\[[^\]]+\]\(([^)#\s]+)(?:#[^)]*)?\)")
CITATION = re.compile(r"\[@([A-Za-z0-9:_-]+)\]")
KEY = re.compile(r"^@\w+\{([^,]+),", re.MULTILINE)
SKIP = {"build", "results", ".git", "__pycache__"}


def files(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.is_file() and not SKIP.intersection(relative.parts):
            yield path, relative.as_posix()


def folders_with_readme(root):
    for top in ("micro", "macro", "coupling", "cases"):
        if (root / top).is_dir():
            yield root / top
            for folder in sorted((root / top).iterdir()):
                if folder.is_dir() and folder.name not in SKIP and any(folder.iterdir()):
                    yield folder


def check(root):
    """Returns the list of faults under root."""
    root = pathlib.Path(root)
    faults = [
        f"{folder.relative_to(root).as_posix()}: has no README.md"
        for folder in folders_with_readme(root)
        if not (folder / "README.md").is_file()
    ]
    bibliography = root / "docs" / "bibliography.bib"
    keys = set(KEY.findall(bibliography.read_text(encoding="utf-8"))) if bibliography.is_file() else set()
    for path, name in files(root):
        if path.suffix not in SOURCES | {".md", ".txt", ".toml"}:
            continue
        text = path.read_text(encoding="utf-8")
        lines = text.splitlines()
        if path.suffix in SOURCES:
            if len(lines) > LONGEST:
                faults.append(f"{name}: {len(lines)} lines, more than {LONGEST}; split it by idea")
            for number, line in enumerate(lines, 1):
                if UNFINISHED.search(line):
                    faults.append(f"{name}:{number}: marks unfinished work: {line.strip()}")
        for number, line in enumerate(lines, 1):
            if line != line.rstrip() and path.suffix != ".md":
                faults.append(f"{name}:{number}: ends in white space")
        if path.suffix == ".md":
            for target in LINK.findall(text):
                if "://" not in target and not (path.parent / target).exists():
                    faults.append(f"{name}: link to {target}, which does not exist")
            for key in CITATION.findall(text):
                if key not in keys:
                    faults.append(f"{name}: cites {key}, which docs/bibliography.bib does not hold")
    return faults


# One fault of each kind.
PLANTED = {
    "micro/cells/a.hpp": "int x; // TO" "DO\n",
    "micro/cells/b.hpp": "\n" * 501,
    "micro/cells/c.cpp": "int y; \n",
    "docs/page.md": "[a](nowhere.md) and [@Nobody1900]\n",
    "docs/bibliography.bib": "@article{Somebody2000,\n}\n",
}
EXPECTED = [
    "micro: has no README.md",
    "micro/cells: has no README.md",
    "marks unfinished work",
    "501 lines",
    "ends in white space",
    "link to nowhere.md",
    "cites Nobody1900",
]

if __name__ == "__main__":
    main(check, PLANTED, EXPECTED)
