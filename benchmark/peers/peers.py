#!/usr/bin/env python3
"""Problems of ours in jounce and in other programs, in one run: time and accuracy side by side.

  peers.py run [--build FOLDER] [--out FOLDER] [--core N] [WORD ...]
        all rows, into results.csv of the folder; or those whose problem.model.program.method contains one of the words,
        which then take the place of the same rows there
  peers.py update RESULTS.csv PAGE.md
        writes the tables of a page between its lines <!-- table: PROBLEM --> and <!-- end -->

`./dev bench --peers` builds what is needed and calls this.
"""
import argparse
import os
import sys
import time

import report
from measure import Bench, Case, measure
from problems import PROBLEMS


def is_named(problem, row, words):
    name = ".".join((problem["name"], row["model"], row["program"], row["method"]))
    return not words or any(word in name for word in words)


def chosen(problem, words, known):
    """Rows that are named; and of jounce, on the same models, those that were never measured, as peers are compared with them."""
    named = [row for row in problem["rows"] if is_named(problem, row, words)]
    models = {row["model"] for row in named}
    return [row for row in problem["rows"] if row in named or row["program"] == "jounce" and row["model"] in models and
            report.key_of({"problem": problem["name"], **row}) not in known]


def run(options):
    bench = Bench(options.build, options.out, options.core)
    if bench.path("jounce") is None:
        sys.exit(f"{options.build} has no peer_own: build the target jounce_peers with -DJN_PEERS=ON")
    path, start = os.path.join(options.out, "results.csv"), time.monotonic()
    known = report.known_rows(path) if options.words else {}
    for problem in PROBLEMS:
        cases = {}
        for row in chosen(problem, options.words, known):
            name = row["model"]
            if name not in cases:
                cases[name] = Case(bench, problem, name)
            found = {"problem": problem["name"], "date": time.strftime("%Y-%m-%d"), **measure(cases[name], row)}
            known[report.key_of(found)] = found
            print(report.line(found), flush=True)
            report.write(path, report.in_order(known, PROBLEMS))
    results = report.in_order(known, PROBLEMS)
    report.print_ratios(results)
    print(f"{time.monotonic() - start:.0f} s; {len(results)} rows are in {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    one = verbs.add_parser("run")
    one.add_argument("--build", default="build/release")
    one.add_argument("--out", default="out/benchmark/peers")
    one.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    one.add_argument("words", nargs="*")
    two = verbs.add_parser("update")
    two.add_argument("results")
    two.add_argument("page")
    options = parser.parse_args()
    if options.verb == "run":
        run(options)
    else:
        report.update(options.results, options.page)


main()
