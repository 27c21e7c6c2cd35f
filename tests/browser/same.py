#!/usr/bin/env python3
"""Says whether the core in a browser's machine finds the frequencies that the program finds.

    same.py BROWSER.json MODES.json
"""

import json
import sys

# Twice what either was asked for.
NEAR = 2e-6

browser, modes = (json.load(open(name)) for name in sys.argv[1:])
if "error" in browser:
    sys.exit(f"the core in a browser's machine: {browser['error']}")
for here, there in zip(browser["frequency_hz"], modes["modes"], strict=True):
    there = there["frequency_hz"]
    if abs(here - there) > NEAR * there:
        sys.exit(f"the core finds {here} Hz in a browser's machine, the program {there} Hz")
speed = browser["hit"]["exit_speed_m_s"]
print(f"{len(modes['modes'])} frequencies alike, a hit at {browser['hit']['x_m']} m: {speed:.2f} m/s")
