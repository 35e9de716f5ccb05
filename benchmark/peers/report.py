"""Rows of results: judged against each other, printed, written and read as CSV, and as tables of a page."""
import csv
import math
import os
import re
import subprocess
import time

from problems import EXPLICIT

WRONG = 0.1  # error relative to the largest displacement from which on an answer is called wrong
COLUMNS = ["problem", "model", "program", "method", "dt", "label", "span", "runs", "seconds", "slowest", "per_second", "steps",
           "newton", "iterations", "factorizations", "error", "probe", "energy", "energy_share", "model_difference", "verdict",
           "ratio", "against", "kind_ratio", "kind_against", "date", "note"]
JUDGED = ("ratio", "against", "kind_ratio", "kind_against")
PACKAGES = ["calculix-ccx", "libsundials-dev", "petsc-dev", "libbullet-dev"]
BLOCK = re.compile(r"(<!-- table: (\S+) -->\n).*?(<!-- end -->)", re.S)


def key_of(row):
    return tuple(row[name] or "" for name in ("problem", "model", "program", "method", "dt", "label"))


def known_rows(path):
    """Those of an earlier run, by key."""
    if not os.path.isfile(path):
        return {}
    numbers = ("per_second", "error", "probe", "energy", "energy_share", "model_difference", "seconds", "slowest")
    rows = [{name: float(value) if name in numbers else value for name, value in row.items()
             if value != "" and name not in JUDGED or name in ("dt", "label", "method")} for row in read(path)[1]]
    return {key_of(row): row for row in rows}


def in_order(known, problems):
    """As the problems list them, judged."""
    keys = [key_of({"problem": problem["name"], **row}) for problem in problems for row in problem["rows"]]
    rows = [known[key] for key in keys if key in known]
    return [row for problem in problems for row in judge([r for r in rows if r["problem"] == problem["name"]])]


def title(row):
    words = [row["method"], row["dt"], row["label"] and f"({row['label']})"]
    return " ".join(word for word in words if word)


def fastest(rows, row, is_explicit=None):
    """Of jounce on the same model, at least as accurate, of that kind."""
    better = [r for r in rows if r["program"] == "jounce" and r["model"] == row["model"] and "error" in r and
              r["error"] <= row["error"] * 1.01 and is_explicit in (None, r["method"] in EXPLICIT)]
    return min(better, key=lambda r: r["per_second"], default=None)


def judge(rows):
    """Verdicts, and for each peer the ratio to the fastest row of jounce on the same model that is at least as accurate: of
    all, and of those that are explicit or implicit as the peer is."""
    for row in rows:
        if "error" in row:
            row["verdict"] = "wrong" if not row["error"] < WRONG else "ok"
    for row in rows:
        if row["program"] == "jounce" or "error" not in row or not math.isfinite(row["error"]):
            continue
        best, kin = fastest(rows, row), fastest(rows, row, row["method"] in EXPLICIT)
        if best:
            row["ratio"], row["against"] = row["per_second"] / best["per_second"], title(best)
        if kin:
            row["kind_ratio"], row["kind_against"] = row["per_second"] / kin["per_second"], title(kin)
    return rows


def short(value, digits=3):
    if value in ("", None):
        return ""
    value = float(value)
    return "nan" if math.isnan(value) else f"{value:.{digits}g}"


def line(row):
    if "error" not in row:
        return f"{row['problem']:7}{row['model']:12}{row['program']:9} {title(row):45} {row['verdict']} {row.get('note', '')}"
    return (f"{row['problem']:7}{row['model']:12}{row['program']:9} {title(row):45} {short(row['per_second']):>8} s/s"
            f"   error {short(row['error'], 2):>8}   energy {short(row['energy_share'], 2):>8}")


def ratio_of(row, name, against):
    return f"{row[name]:7.2f} x {row[against]:33}" if name in row else f"{'none is as accurate':43}"


def print_ratios(rows):
    print("\nTime of the peer over that of the fastest row of jounce on the same model that is at least as accurate: of all, and of"
          " its kind,\nexplicit or implicit")
    for row in rows:
        if "error" not in row or row["program"] == "jounce":
            continue
        mark = "WRONG" if row["verdict"] == "wrong" else ""
        print(f"{row['problem']:7}{row['model']:12}{row['program']:9} {title(row):45}"
              f" {ratio_of(row, 'ratio', 'against')} {ratio_of(row, 'kind_ratio', 'kind_against')} {mark}")


def version_of(package):
    done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else "not installed"


def host():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [text.split(":", 1)[1].strip() for text in file if text.startswith("model name")]
    yield f"processor: {names[0] if names else 'unknown'}, {os.cpu_count()} cores, one thread, held to one core"
    yield "clock: processor time; least of three runs where one takes less than 3 s"
    yield "peers: " + ", ".join(f"{package} {version_of(package)}" for package in PACKAGES)
    yield "date: " + time.strftime("%Y-%m-%d")


def write(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {text}\n" for text in host())
        out = csv.DictWriter(file, COLUMNS, extrasaction="ignore", restval="", lineterminator="\n")
        out.writeheader()
        for row in rows:
            out.writerow({name: f"{value:.5g}" if isinstance(value, float) else value for name, value in row.items()})


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        lines = file.readlines()
    comments = [text[2:].strip() for text in lines if text.startswith("# ")]
    return comments, list(csv.DictReader(text for text in lines if not text.startswith("#")))


def cells(row):
    if not row["error"]:
        return [row["model"], row["program"], title(row), row["verdict"], "", "", "", "", row["note"]]
    ratios = ["" if row["program"] == "jounce" else
              f"{float(row[name]):.2g} x {row[against]}" if row[name] else "none is as accurate"
              for name, against in (("ratio", "against"), ("kind_ratio", "kind_against"))]
    wrong = "**wrong** " if row["verdict"] == "wrong" else ""
    differs = f"; model differs by {short(row['model_difference'], 2)}" if row["model_difference"] else ""
    return [row["model"], row["program"], title(row), short(row["per_second"]), row["newton"].split(".")[0],
            wrong + short(row["error"], 2) + differs, short(row["energy_share"], 2).replace("nan", ""), *ratios]


def table(comments, rows, name):
    if name == "host":
        return "".join(f"- {text}\n" for text in comments)
    head = ["model", "program", "method, step", "s/s", "Newton", "error", "energy", "over jounce's best", "of its kind"]
    lines = [head, ["---"] * len(head), *[cells(row) for row in rows if row["problem"] == name]]
    return "".join("| " + " | ".join(words) + " |\n" for words in lines)


def update(results, page):
    comments, rows = read(results)
    with open(page, encoding="utf-8") as file:
        text = file.read()
    text = BLOCK.sub(lambda found: found[1] + table(comments, rows, found[2]) + found[3], text)
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)
