"""Prints docs/claims.md from the claims.csv of every study: claims_page.py RESULTS STUDY..., RESULTS = build/studies."""
import csv
import pathlib
import sys

VERDICTS = ("reproduced", "not reproduced", "not decidable", "follows from the input")
results, studies = pathlib.Path(sys.argv[1]), sys.argv[2:]


def cell(text):
    return text.replace("|", "\\|")


print("""# Claims

What the source says ([sand2010]), what came out here, and how that was decided. `make claims` writes this page from the
`claims.csv` of the studies that have been run. Verdicts: *reproduced*; *not reproduced*; *not decidable* with what was run;
*follows from the input*, where what the source reports is imposed by the scene, so that nothing was found out.
""")
tables = {}
for study in studies:
    path = results / study / "claims.csv"
    if path.exists():
        with open(path, newline="", encoding="utf-8") as file:
            tables[study] = list(csv.DictReader(file))
print("| study | size | " + " | ".join(VERDICTS) + " |\n" + "|---" * (2 + len(VERDICTS)) + "|")
sizes = {study: path.read_text().split()[0] for study in tables if (path := results / study / ".made" / "claims.settings").exists()}
for study in studies:
    if study not in tables:
        print(f"| {study} | not run |" + " |" * len(VERDICTS))
        continue
    counts = [sum(row["verdict"] == verdict for row in tables[study]) for verdict in VERDICTS]
    print(f"| [{study}](#{study}) | {sizes.get(study, '')} | " + " | ".join(str(n) if n else "" for n in counts) + " |")
for study, rows in tables.items():
    print(f"\n## {study}\n\n`make study-{study}{' SIZE=full' if sizes.get(study) == 'full' else ''}`\n")
    print("| § | claim | the source | ours | decided by | verdict |\n|---|---|---|---|---|---|")
    for row in rows:
        print("| " + " | ".join(cell(row[c]) for c in ("section", "claim", "source", "ours", "decided_by")) + f" | **{row['verdict']}** |")
