#!/usr/bin/env python3
"""Write THIRD-PARTY.md: every package in the program and in the Python package, its licence, and the licences' texts.

    licences/third_party.py            write the file
    licences/third_party.py --check    fail if the file is not what would be written, or if a
                                       licence is not among those that deny.toml allows

Everything comes from `cargo metadata` and from the packages that cargo has fetched: for Linux,
macOS and Windows, without what only builds and tests need.
"""

import json
import re
import subprocess
import sys
import tomllib
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGETS = [
    "x86_64-unknown-linux-gnu",
    "aarch64-unknown-linux-gnu",
    "x86_64-apple-darwin",
    "aarch64-apple-darwin",
    "x86_64-pc-windows-msvc",
    "aarch64-pc-windows-msvc",
]
NAMES = re.compile(r"^(un)?licen[sc]e|^copying|^notice|licen[sc]e\.(txt|md)$", re.I)
# Fonts that the program does not draw with are not in it: the linker leaves them out.
FONT_TEXTS = {"epaint_default_fonts": ["fonts/UFL.txt"]}


def metadata(target):
    """What cargo knows about one target; from the network only what was not fetched before."""
    asked = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", target]
    for more in (["--offline"], []):
        found = subprocess.run(asked + more, cwd=ROOT, capture_output=True, text=True)
        if found.returncode == 0:
            return json.loads(found.stdout)
    sys.exit(f"error: {found.stderr}")


def packages():
    """Every package that a build of the program or of the Python package holds, by name and version."""
    held = {}
    for target in TARGETS:
        known = metadata(target)
        by_id = {package["id"]: package for package in known["packages"]}
        nodes = {node["id"]: node for node in known["resolve"]["nodes"]}
        own = set(known["workspace_members"])
        left, seen = list(own), set()
        while left:
            node = left.pop()
            if node in seen:
                continue
            seen.add(node)
            for dependency in nodes[node]["deps"]:
                if any(kind["kind"] is None for kind in dependency["dep_kinds"]):
                    left.append(dependency["pkg"])
        for node in seen - own:
            package = by_id[node]
            held[package["name"], package["version"]] = package
    return [held[key] for key in sorted(held)]


def texts(package):
    """The licence texts of a package; where several may be chosen from, not Apache's long one."""
    folder = Path(package["manifest_path"]).parent
    files = [path for path in sorted(folder.iterdir()) if path.is_file() and NAMES.search(path.name)]
    if " OR " in (package["license"] or ""):
        shorter = [path for path in files if "apache" not in path.name.lower()]
        files = [path for path in shorter if "mit" in path.name.lower()] or shorter or files
    files += [folder / name for name in FONT_TEXTS.get(package["name"], [])]
    return [path.read_text(encoding="utf-8", errors="replace").strip() for path in files]


def written():
    """The whole document."""
    held = packages()
    lines = [
        "# Third-party software",
        "",
        "The program `sweetspot` and its Python package contain these packages.",
        "`licences/third_party.py` wrote this file from what cargo fetched; the licences' texts",
        "follow the table. The pictures are drawn with the font Ubuntu Light, under the Ubuntu Font",
        "Licence 1.0, which is among them.",
        "",
        "The packages named symphonia are under the Mozilla Public Licence 2.0 and unchanged. Their source is at",
        "the addresses in the table, and on crates.io under these names and versions.",
        "",
        "| package | licence | where from |",
        "|---|---|---|",
    ]
    by_text = defaultdict(list)
    shown = {}
    for package in held:
        name = f"{package['name']} {package['version']}"
        source = package["repository"] or f"https://crates.io/crates/{package['name']}"
        lines.append(f"| {name} | {package['license'] or 'see its text'} | {source} |")
        for text in texts(package):
            # One text however it is broken into lines.
            key = " ".join(text.split())
            shown.setdefault(key, text)
            by_text[key].append(name)
    for key, names in sorted(by_text.items(), key=lambda item: item[1]):
        lines += ["", "## " + ", ".join(names), "", "```text"]
        lines += [line.rstrip() for line in shown[key].replace("```", "'''").splitlines()]
        lines += ["```"]
    return "\n".join(lines) + "\n", held


def unallowed(held):
    """Packages none of whose licences deny.toml allows; each part of an AND must be allowed."""
    licenses = tomllib.loads((ROOT / "deny.toml").read_text())["licenses"]
    more = {one["crate"]: one["allow"] for one in licenses["exceptions"]}

    def fits(package):
        allowed = {*licenses["allow"], *more.get(package["name"], [])}
        expression = package["license"] or "none"
        expression = expression.replace("/", " OR ").replace("(", " ( ").replace(")", " ) ")
        python = []
        for word in re.sub(r"\s+WITH\s+", "_WITH_", expression).split():
            plain = word.replace("_WITH_", " WITH ")
            python.append(word.lower() if word in ("AND", "OR") else word if word in "()" else str(plain in allowed))
        # Words, brackets, True and False only.
        return eval(" ".join(python))  # noqa: S307

    return [f"{p['name']} {p['version']}: {p['license']}" for p in held if not fits(p)]


def main():
    document, held = written()
    wrong = unallowed(held)
    if wrong:
        sys.exit("error: a licence that deny.toml does not allow:\n  " + "\n  ".join(wrong))
    path = ROOT / "THIRD-PARTY.md"
    if sys.argv[1:] != ["--check"]:
        path.write_text(document, encoding="utf-8")
        print(f"{len(held)} packages, {len(document)} characters")
    elif not path.is_file() or path.read_text(encoding="utf-8") != document:
        sys.exit("error: THIRD-PARTY.md is not up to date: run licences/third_party.py")


if __name__ == "__main__":
    main()
