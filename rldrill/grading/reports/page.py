"""The report on a class as one HTML file: how the points are spread, how each part went, which mistakes were made."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from html import escape
from statistics import median

from rldrill.grading.report import MISSING, NOT_GRADED, NOTHING, MarkedPart, Report
from rldrill.grading.reports.said import one_line

_BARS = 10
_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #1c2733; }
table { border-collapse: collapse; width: 100%; margin: 0.6rem 0 2rem; }
th, td { text-align: left; padding: 0.25rem 0.6rem; border-bottom: 1px solid #d9e0e7; vertical-align: top; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
svg { width: 100%; height: auto; } svg text { font: 11px system-ui, sans-serif; fill: #44525f; }
.right { fill: #2f7d5b; } .partly { fill: #d9a13b; } .wrong { fill: #c2554d; } .missing { fill: #c9d1d9; }
.bar { fill: #3f6ea8; } td.bar { width: 20%; }
"""


def written(report: Report, feedback: str) -> str:
    """The page; it loads nothing from anywhere. Names are in it, and keys only where they are asked for."""
    title = report.title or "Answers"
    score, students = report.score, report.students
    shares = [student.score.share for student in students]
    middle = float(100 * median(shares)) if shares else 0.0
    passed = sum(map(report.passed, students))
    points = f"{float(score.points):g} of {score.of} points"
    absent = sum(student.remark == NOTHING for student in students)
    head = (
        f"{len(students)} student{'' if len(students) == 1 else 's'}, {points}, median {middle:.3g} %, {passed} passed"
    )
    head += f", {absent} {NOTHING}" if absent else ""
    body = [f"<h1>{_text(title)}</h1>", f"<p>{head}.</p>"]
    body += ["<h2>Points</h2>", _histogram([float(share) for share in shares])]
    body += ["<h2>Parts</h2>", _parts(report, feedback)]
    if mistakes := _mistakes(report.parts):
        body += ["<h2>Mistakes</h2>", _counted(mistakes)]
    columns = ("Student", "Number", "Version", "Points", "%", *(("Scaled",) if report.scale else ()), "Remark")
    body += ["<h2>Students</h2>", _table(columns, _totals(report))]
    if said := [refusal.says for refusal in report.refused] + [each for s in students for each in s.extra]:
        body += ["<h2>Not graded</h2>", "<ul>", *(f"<li>{_text(each)}</li>" for each in said), "</ul>"]
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">"
        f"<title>{_text(title)}</title><style>{_STYLE}</style></head><body>\n" + "\n".join(body) + "\n</body></html>\n"
    )


def _histogram(shares: Sequence[float]) -> str:
    """How many students earned how much, in tenths."""
    counts = Counter(min(_BARS - 1, int(share * _BARS)) for share in shares)
    most = max(counts.values(), default=1)
    bars = []
    for bar in range(_BARS):
        height = 120 * counts[bar] / most
        x = 10 + 58 * bar
        bars.append(
            f'<rect class="bar" x="{x}" y="{140 - height:.1f}" width="50" height="{height:.1f}"/>'
            f'<text x="{x + 25}" y="{135 - height:.1f}" text-anchor="middle">{counts[bar] or ""}</text>'
            f'<text x="{x + 25}" y="156" text-anchor="middle">{10 * bar}–{10 * bar + 10} %</text>'
        )
    return f'<svg viewBox="0 0 600 165" role="img" aria-label="Students by share of the points">{"".join(bars)}</svg>'


def _parts(report: Report, feedback: str) -> str:
    """For every part of the exam how many were right, partly right, wrong, and missing."""
    found: dict[str, list[MarkedPart]] = defaultdict(list)
    for part in report.parts:
        found[part.name].append(part)
    rows = []
    for index, (name, parts) in enumerate(found.items()):
        y = 24 * index
        counts = Counter(map(_fate, parts))
        x, bars = 190.0, ""
        for fate in ("right", "partly", "wrong", "missing"):
            width = 330 * counts[fate] / len(parts)
            tip = f"{counts[fate]} of {len(parts)} {fate}"
            place = f'x="{x:.1f}" y="{y + 2}" width="{width:.1f}" height="16"'
            bars += f'<rect class="{fate}" {place}><title>{tip}</title></rect>'
            x += width
        rows.append(
            f'<text x="0" y="{y + 14}">{escape(one_line(name)[:60])}</text>{bars}'
            f'<text x="530" y="{y + 14}">{100 * counts["right"] / len(parts):.0f} % right</text>'
        )
    picture = (
        f'<svg viewBox="0 0 600 {24 * len(found) + 4}" role="img" aria-label="Right, partly right, wrong and missing">'
        f"{''.join(rows)}</svg>"
    )
    if feedback != "key":
        return picture
    keys = dict.fromkeys((part.problem, part.part, part.judged.key) for part in report.parts)
    return picture + _table(("Problem", "Part", "Key"), keys)


def _fate(part: MarkedPart) -> str:
    if part.judged.accepted:
        return "right"
    return "missing" if part.judged.verdict in (MISSING, NOT_GRADED) else "partly" if part.score.points else "wrong"


def _mistakes(parts: Iterable[MarkedPart]) -> list[tuple[str, str, int]]:
    """Which mistakes were made in which part, and how often; the commonest first."""
    counts = Counter((part.name, part.judged.mistake) for part in parts if part.judged.mistake)
    return [(name, mistake, count) for (name, mistake), count in counts.most_common(60)]


def _counted(mistakes: Sequence[tuple[str, str, int]]) -> str:
    """The mistakes, each with a bar as long as there are students who made it."""
    most = max(count for *_, count in mistakes)
    rows = "".join(
        f'<tr><td>{_text(name)}</td><td>{_text(mistake)}</td><td class="n">{count}</td>'
        f'<td class="bar"><svg viewBox="0 0 100 10" role="img" aria-label="{count}">'
        f'<rect class="bar" width="{100 * count / most:.1f}" height="10"/></svg></td></tr>'
        for name, mistake, count in mistakes
    )
    return f'<table><tr><th>Part</th><th>What it looks like</th><th class="n">Students</th><th></th></tr>{rows}</table>'


def _totals(report: Report) -> Iterable[tuple[str, ...]]:
    for student in report.students:
        score = student.score
        points = f"{float(score.points):g} of {score.of}"
        scaled = report.scaled(student)
        more = () if scaled is None else (f"{float(scaled.points):.6g} of {scaled.of}",)
        share = score.percent()
        yield (student.student, student.number, student.version, points, share, *more, student.remark)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    numbers = {"Students", "Points", "%", "Scaled"}
    kind = ['class="n"' if name in numbers else "" for name in head]
    lines = [[f"<td {k}>{_text(cell)}</td>" for k, cell in zip(kind, row, strict=True)] for row in rows]
    top = "".join(f"<th {k}>{name}</th>" for k, name in zip(kind, head, strict=True))
    body = "".join(f"<tr>{''.join(line)}</tr>" for line in lines)
    return f"<table><tr>{top}</tr>{body}</table>"


def _text(text: str) -> str:
    return escape(one_line(text))
