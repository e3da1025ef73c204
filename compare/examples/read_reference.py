"""Reads a load and its error from the package of reference numbers, and checks the files' checksums."""

import csv
import hashlib
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")

for resource in json.loads((folder / "datapackage.json").read_text())["resources"]:
    digest = hashlib.sha256((folder / resource["path"]).read_bytes()).hexdigest()
    if resource["hash"] != "sha256:" + digest:
        sys.exit(f"{resource['path']} is not the file that the package describes")

with open(folder / "loads.csv", newline="") as file:
    loads = {
        (float(row["ratio"]), float(row["gap"]), row["name"]): (float(row["value"]), float(row["error_estimate"]))
        for row in csv.DictReader(file)
    }

value, error = loads[1.0, 0.1, "X11A"]
print(f"X11A of equal spheres at a gap of 0.1 is {value} within {error}")
