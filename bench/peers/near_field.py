"""Writes fixtures/peers/near-field-jeffrey-onishi.csv: resistance of two equal spheres by its expansion near contact.

    python near_field.py

At the gap xi (in radii; for equal spheres the xi of Jeffrey & Onishi is the gap) each scalar is
c_inv / xi + c_log ln(1/xi) + constant + c_xilog xi ln(1/xi), with the rows lambda = 1 of
fixtures/unequal_near_contact.csv. For equal spheres the scales of Jeffrey & Onishi, 3 pi (a1 + a2),
pi (a1 + a2)^2 and pi (a1 + a2)^3, are 6 pi a, 4 pi a^2 and 8 pi a^3, those of the submissions, and the signs are the
same, Y11B < 0 < Y12B. Python's standard library is enough.
"""

import csv
import math
import pathlib

from convert import JEFFREY, write

FIXTURES = pathlib.Path(__file__).resolve().parents[2] / "fixtures"
GAPS = ("0.001", "0.002", "0.005", "0.01", "0.02", "0.05", "0.1", "0.2", "0.5")

HEADER = {
    "model": "near contact, Jeffrey & Onishi",
    "citation": JEFFREY,
    "call": (
        "c_inv / gap + c_log ln(1/gap) + constant + c_xilog gap ln(1/gap), equal spheres; constants by extrapolated "
        "multipole collocation"
    ),
}


def main():
    with (FIXTURES / "unequal_near_contact.csv").open(newline="", encoding="utf-8") as file:
        scalars = [row for row in csv.DictReader(file) if float(row["lambda"]) == 1.0]
    lines = []
    for gap in GAPS:
        xi = float(gap)
        terms = {"c_inv": 1.0 / xi, "c_log": -math.log(xi), "constant": 1.0, "c_xilog": -xi * math.log(xi)}
        for row in scalars:
            value = math.fsum(float(row[name]) * term for name, term in terms.items())
            lines.append((gap, row["name"], repr(value)))
    write("near-field-jeffrey-onishi", HEADER, lines)


if __name__ == "__main__":
    main()
