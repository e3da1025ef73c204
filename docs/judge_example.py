"""Two spheres that feel each other's far field. Answers questions, or prints a CSV file with --csv."""
import json
import sys

HEADER = {"model": "far field", "version": "1", "citation": "J. R. Blake, J. Fluid Mech. 46 (1971) 199"}
GAPS = [0.005, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 38.0, 100.0]

def pair(gap):
    r = gap + 2
    return {"x11a": 1, "x12a": 1.5 / r, "y11a": 1, "y12a": 0.75 / r, "y11b": 0, "y12b": -0.5 / r**2,
            "x11c": 1, "x12c": 1 / r**3, "y11c": 1, "y12c": -0.5 / r**3,
            "UX1_1": 2 / 3, "UX2_1": 2 / 3 / r**3, "UY1_1": 2 / 3, "UY2_1": -1 / 3 / r**3, "OY1_1": 0, "OY2_1": 0,
            "UX1_2": 0, "UX2_2": -1 / r**2, "UY1_2": 0, "UY2_2": 0, "OY1_2": 0, "OY2_2": 1.5 / r**3}

if "--csv" in sys.argv:
    print("".join(f'#! {key} = "{text}"\n' for key, text in HEADER.items()) + "gap,name,value")
    print("\n".join(f"{gap},{name},{value}" for gap in GAPS for name, value in pair(gap).items()))
else:
    for line in sys.stdin:
        gap = json.loads(line).get("gap")
        answer = {"header": {**HEADER, "range": [1e-3, 1e4]}} if gap is None else {"gap": gap, "values": pair(gap)}
        print(json.dumps(answer), flush=True)
