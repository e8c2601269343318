"""What the lint scripts share: the command line and the test of the check itself."""

import pathlib
import sys
import tempfile


def main(check, planted, expected):
    """Runs as: SCRIPT ROOT, the check; or SCRIPT --self-test: every planted fault must be found.

    check(root) returns a list of faults; planted maps names of files of a made-up tree to their
    text; expected lists fragments of the faults that must be found there.
    """
    if sys.argv[1:] == ["--self-test"]:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in planted.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            found = check(folder)
        problems = [f"self-test: not found: {e}" for e in expected if not any(e in f for f in found)]
    else:
        problems = check(sys.argv[1])
    for problem in problems:
        print(problem, file=sys.stderr)
    sys.exit(1 if problems else 0)
