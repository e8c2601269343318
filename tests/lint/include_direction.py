"""Checks that dependencies point one way.

Reads every #include of the sources and fails on: a reversed edge between micro, macro and coupling;
an edge that the layers below do not allow; two folders that include each other; a project header
that does not exist; an OpenFOAM header outside the two folders that may see OpenFOAM.

Run as: include_direction.py ROOT            (the check)
        include_direction.py --self-test     (the check must find faults planted in a made-up tree)
"""

import pathlib
import re

from lint_script import main

TOP = ("micro", "macro", "coupling")
SUFFIXES = {".hpp", ".cpp"}
OPENFOAM_FOLDERS = ("macro/openfoam", "coupling/plugin")

# Top-level folders that a top-level folder may include.
ALLOWED = {"micro": {"micro"}, "macro": {"macro"}, "coupling": {"micro", "macro", "coupling"}}

# Models of the micro scale that must not see each other.
SEPARATE = ("micro/mps", "micro/ensemble", "micro/suspension")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def module(path):
    """The folder that counts as one module; a header beside the folders is a module of its own."""
    parts = path.split("/")
    return "/".join(parts[:2]) if len(parts) > 2 else path.rsplit(".", 1)[0]


def check(root):
    """Returns the list of faults under root."""
    root = pathlib.Path(root)
    faults = []
    edges = {}
    for top in TOP:
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in SUFFIXES:
                continue
            name = file.relative_to(root).as_posix()
            for kind, header in INCLUDE.findall(file.read_text(encoding="utf-8")):
                if header.endswith(".H") and not name.startswith(OPENFOAM_FOLDERS):
                    faults.append(f"{name}: OpenFOAM header {header} outside {' and '.join(OPENFOAM_FOLDERS)}")
                target = header.split("/")[0]
                if target not in TOP:
                    if kind == '"' and not header.endswith(".H"):
                        faults.append(f"{name}: includes {header}, which is not written from the repository root")
                    continue
                if not (root / header).is_file():
                    faults.append(f"{name}: includes {header}, which does not exist")
                if target not in ALLOWED[top]:
                    faults.append(f"{name}: {top} must not include {target} ({header})")
                source_module, target_module = module(name), module(header)
                if source_module != target_module:
                    if source_module in SEPARATE and target_module in SEPARATE:
                        faults.append(f"{name}: {source_module} must not see {target_module}")
                    edges.setdefault((source_module, target_module), name)
    for (one, other), name in sorted(edges.items()):
        if one < other and (other, one) in edges:
            faults.append(f"{one} and {other} include each other: {name} and {edges[(other, one)]}")
    return faults


# One fault of each kind.
PLANTED = {
    "micro/cells/a.hpp": '#include "macro/flow_field.hpp"\n',
    "macro/flow_field.hpp": '#include "coupling/x/y.hpp"\n#include <fvMesh.H>\n',
    "coupling/x/y.hpp": '#include "coupling/z/w.hpp"\n#include "missing.hpp"\n',
    "coupling/z/w.hpp": '#include "coupling/x/y.hpp"\n#include "coupling/z/none.hpp"\n',
    "micro/mps/m.hpp": '#include "micro/ensemble/e.hpp"\n',
    "micro/ensemble/e.hpp": "\n",
}
EXPECTED = [
    "micro must not include macro",
    "macro must not include coupling",
    "OpenFOAM header fvMesh.H",
    "include each other",
    "not written from the repository root",
    "which does not exist",
    "micro/mps must not see micro/ensemble",
]

if __name__ == "__main__":
    main(check, PLANTED, EXPECTED)
