"""An exam in LaTeX's ``exam`` class, to be edited by hand and compiled with any engine."""

from rldrill.exam.exam import Exam, Version
from rldrill.exercise import Exercise
from rldrill.export.asked import Wrong, answer, listed, typeset
from rldrill.export.words import page_words
from rldrill.print.solved import with_mathematics
from rldrill.print.words import Words, words, written_time
from rldrill.problems.parts import Choice, Part, YesNo
from rldrill.render.latex import latex_block, latex_document
from rldrill.render.mathematics.latex import latex_plain, latex_text, latex_typed
from rldrill.solutions.effort import minutes_of, whole

_PREAMBLE = r"""\documentclass[addpoints,%(paper)s,11pt]{exam}
\usepackage{iftex}
\ifPDFTeX
  \usepackage[T1]{fontenc}
  \usepackage[utf8]{inputenc}
\else
  \usepackage{fontspec}
\fi
\IfFileExists{lmodern.sty}{\usepackage{lmodern}}{}
\usepackage{amsmath,amssymb,tikz,graphicx}
%% What is wider than the line is made smaller; what is tall stands on the line, where a page sees how tall it is.
\newsavebox{\fittedbox}
\newcommand{\fitted}[1]{\par\noindent\sbox{\fittedbox}{#1}%%
  \ifdim\wd\fittedbox>\linewidth\sbox{\fittedbox}{\resizebox{\linewidth}{!}{\usebox{\fittedbox}}}\fi
  \raisebox{\depth}{\usebox{\fittedbox}}\par}
%% A page ends rather before a problem or a part than behind its first lines, and not before a list.
\newcommand{\start}[1]{\par\vskip 0pt plus 8\baselineskip\penalty-#1\vskip 0pt plus -8\baselineskip}
\makeatletter\@beginparpenalty=10000\makeatother
\renewcommand{\arraystretch}{1.25}
\setlength{\parskip}{4pt plus 2pt}
\pagestyle{headandfoot}
\firstpageheader{}{}{}
\runningheader{%(title)s}{}{%(code)s}
\footer{}{\thepage\ / \numpages}{}
\pointpoints{%(point)s}{%(points)s}
\hqword{%(problem)s:}\hpword{%(worth)s:}\hsword{%(reached)s:}\htword{%(total)s}
\renewcommand{\solutiontitle}{\raggedright\textbf{%(working)s:}\par\noindent}
%(answers)s
\begin{document}
\raggedright
"""


def latex_exam(exam: Exam, version: Version, *, practice: bool) -> str:
    """A version; its solutions are in the file, unless the exam goes without, and printed only for practice."""
    head, told = exam.head, words(exam.head.language)
    code = f"{told.version} {version.code}" if len(exam.versions) > 1 else ""
    preamble = _PREAMBLE % {
        "paper": {"a4": "a4paper", "letter": "letterpaper"}[exam.layout.paper],
        "title": latex_plain(head.title),
        "code": code,
        "point": told.point,
        "points": told.points,
        "problem": told.problem,
        "worth": told.points.capitalize(),
        "reached": told.reached,
        "total": told.total,
        "working": page_words(head.language).working,
        "answers": r"\printanswers" if practice else "% \\printanswers % prints the solutions",
    }
    name, number = r"\makebox[6cm]{\hrulefill}", r"\makebox[4cm]{\hrulefill}"
    if version.person is not None:
        name, number = latex_plain(version.person.name), latex_plain(version.person.number)
    who = rf"{told.name}: {name}\hfill {told.number}: {number}"
    time = written_time(told, head.duration, version.minutes)
    place = " · ".join(filter(None, (head.course, head.date, code)))
    lines = [f"{{\\Large\\bfseries {latex_plain(head.title)}\\par}}", latex_plain(place), who]
    lines += [latex_plain(f"{told.rule} {time}"), latex_plain(head.instructions)]
    front = "\n\n".join(line for line in lines if line)
    with_solutions = exam.layout.solutions != "none"
    problems = "\n".join(_problem(exercise, told, with_solutions=with_solutions) for exercise in version.exercises)
    return (
        f"{preamble}{front}\n\n\\begin{{center}}\\fitted{{\\gradetable[h][questions]}}\\end{{center}}\n\n"
        f"\\begin{{questions}}\n{problems}\\end{{questions}}\n\\end{{document}}\n"
    )


def _problem(exercise: Exercise, told: Words, *, with_solutions: bool) -> str:
    title = latex_text(exercise.problem.family.title)
    each = (_part(exercise, part, told, with_solutions=with_solutions) for part in exercise.parts)
    parts = "\n\\start{100}\n".join(each)
    question = latex_document(exercise.question())
    return f"\\start{{200}}\n\\question \\textbf{{{title}}}\n{question}\\begin{{parts}}\n{parts}\\end{{parts}}\n"


def _part(exercise: Exercise, part: Part, told: Words, *, with_solutions: bool) -> str:
    options = ""
    if isinstance(part.kind, Choice):
        choices = "\n".join(rf"\choice ({letter}) {latex_text(text)}" for letter, text in part.kind.options.items())
        options = f"\\begin{{checkboxes}}\n{choices}\n\\end{{checkboxes}}\n"
    elif isinstance(part.kind, YesNo):
        options = f"\\begin{{oneparcheckboxes}}\n\\choice {told.yes} \\choice {told.no}\n\\end{{oneparcheckboxes}}\n"
    asked = f"\\part[{part.points}] {latex_text(part.ask)}\n{options}"
    space = "" if options else f"{max(2, whole(minutes_of(exercise.solution, part.label)))}cm"
    if not with_solutions:
        return f"{asked}\\vspace{{{space}}}\n" if space else asked
    body = latex_document((answer(exercise, part, told), *exercise.working(part.label)))
    wrong = _mistakes(exercise, part, told.mistakes)
    return f"{asked}\\begin{{solution}}{f'[{space}]' if space else ''}\n{body}{wrong}\\end{{solution}}\n"


def _mistakes(exercise: Exercise, part: Part, title: str) -> str:
    """Typical wrong answers, what is said of them, and the formula as it was read."""
    lines = "".join(
        f"\\item {_typed(part, wrong)}: {latex_text(with_mathematics(wrong.says))}"
        f"{'' if wrong.read is None else latex_block(wrong.read)}\n"
        for wrong in listed(exercise, part)
    )
    if not lines:
        return ""
    return f"\n\\emph{{{latex_plain(title)}}}\n\\begin{{itemize}}\\raggedright\n{lines}\\end{{itemize}}\n"


def _typed(part: Part, wrong: Wrong) -> str:
    """A wrong answer, typeset; of a choice its letter."""
    if isinstance(part.kind, Choice):
        return f"({wrong.cells[0]})"
    return r" \quad ".join(f"${latex_typed(line)}$" for line in typeset(part, wrong))
