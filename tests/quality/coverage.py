"""Adds up the lines of src/ that the tests ran, from what `cov show` prints.

A line counts if the compiler gave it a counter and it stands before its file's tests. Prints the
share by folder, then every file's lines that were not run if asked to (`--missed`).
"""

import re
import sys
from collections import defaultdict
from pathlib import Path

LINE = re.compile(r" *(\d+)\| *(\d*)\|")


def lines(text):
    """Path, number and count of every line with a counter."""
    path, tests = None, False
    for line in text:
        found = LINE.match(line)
        if found is None:
            name = line.strip()
            if name.endswith(".rs"):
                path, tests = Path(name), False
            continue
        tests = tests or line[found.end() :].startswith("#[cfg(test)]")
        if found[2] and not tests:
            yield path, int(found[1]), int(found[2])


def ranges(numbers):
    """3, 4, 5, 9 as 3-5, 9."""
    runs = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ", ".join(f"{a}-{b}" if b > a else str(a) for a, b in runs)


def main():
    top = Path.cwd()
    run, all_lines, missed = defaultdict(int), defaultdict(int), defaultdict(list)
    with open(sys.argv[1], encoding="utf-8") as text:
        for path, number, count in lines(text):
            if path is None or not path.is_relative_to(top):
                continue
            path = path.relative_to(top)
            if path.parts[0] not in ("src", "crates"):
                continue
            folder = f"{path.parts[0]}/{path.parts[1]}/" if len(path.parts) > 2 else "src/*.rs"
            for key in (folder, "all"):
                all_lines[key] += 1
                run[key] += count > 0
            if count == 0:
                missed[path].append(number)
    for key in sorted(all_lines, key=lambda key: (key == "all", key)):
        share = 100 * run[key] / all_lines[key]
        print(f"{key:<14} {run[key]:>6} of {all_lines[key]:>6} lines  {share:6.2f} %")
    if "--missed" in sys.argv:
        for path in sorted(missed, key=lambda path: -len(missed[path])):
            print(f"{path}: {ranges(missed[path])}")


if __name__ == "__main__":
    main()
